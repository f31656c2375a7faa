"""`Remote`: a device at the other end of a connection; it is asked, and what it sends unasked is kept."""

import itertools
import socket
import struct
from typing import Final

from motionlayer.connect.ads._frame import (
    REQUEST,
    RESPONSE,
    Address,
    Carrier,
    FrameError,
    Packet,
    Splitter,
    framed,
    net_id,
)
from motionlayer.connect.ads._meanings import MEANINGS
from motionlayer.connect.ads._numbers import NOTIFICATION
from motionlayer.connect.ads._watch_errors import Absent, Lost, RefusedError, WatchError, readable

PATIENCE: Final = 5.0
"""Seconds to wait for a connection or an answer."""


class Remote:
    """A device at the other end of a connection.

    Args:
        host: address of the device.
        port: TCP port.
        target: NetId of the device.
        ads_port: AMS port of the device.

    Raises:
        Absent: nobody answers there.
    """

    def __init__(self, host: str, port: int, target: str, ads_port: int) -> None:
        try:
            self._socket = socket.create_connection((host, port), PATIENCE)
        except OSError as error:
            raise Absent(f"{host}:{port}: {error.strerror or error}; is a run with --ads there?") from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._target = Address(net_id(target), ads_port)
        # Who watches twice from one computer is told apart by the port of the connection.
        self._source = Address(net_id("127.0.0.1.1.2"), self._socket.getsockname()[1])
        self._splitter = Splitter()
        self._packets: list[Packet] = []
        self._numbers = itertools.count(1)

    def close(self) -> None:
        """End the connection."""
        self._socket.close()

    def ask(self, command: int, data: bytes, what: str) -> bytes:
        """Return what a request is answered with, behind the result.

        Args:
            command: number of the ADS command.
            data: of the request.
            what: is asked for, for messages.

        Raises:
            RefusedError: the device refuses.
            Lost: it is gone, or does not answer.
            WatchError: what comes means nothing.
        """
        self._socket.settimeout(PATIENCE)
        number = next(self._numbers)
        packet = Packet(self._target, self._source, command, REQUEST, 0, number, data)
        try:
            self._socket.sendall(framed(packet.pack()))
        except OSError as error:
            raise Lost(f"the connection is lost: {error.strerror or error}") from error
        while True:
            for at, answer in enumerate(self._packets):
                if answer.flags & RESPONSE and answer.invoke_id == number:
                    del self._packets[at]
                    return _accepted(answer, what)
            if not self._receive(PATIENCE):
                raise Lost(f"{what}: no answer within {PATIENCE:g} s")

    def notifications(self, timeout: float | None) -> list[bytes]:
        """Return the data of the notifications that have come; none if nothing comes in time.

        Args:
            timeout: seconds to wait for something; without end where left out.

        Raises:
            Lost: the device is gone.
            WatchError: what comes means nothing.
        """
        if not any(packet.command == NOTIFICATION for packet in self._packets):
            self._receive(timeout)
        packets, self._packets = self._packets, []
        return [packet.data for packet in packets if packet.command == NOTIFICATION]

    def _receive(self, timeout: float | None) -> bool:
        """Take what comes; tell whether something has."""
        self._socket.settimeout(timeout)
        try:
            data = self._socket.recv(65_536)
        except TimeoutError:
            return False
        except OSError as error:
            raise Lost(f"the connection is lost: {error.strerror or error}") from error
        if not data:
            raise Lost("the device has ended the connection")
        try:
            frames = [frame for frame in self._splitter.feed(data) if frame.command == Carrier.PACKET]
        except FrameError as error:
            raise WatchError(f"what answers there is no ADS device: {error}") from error
        self._packets += [packet for packet in (Packet.parse(frame.data) for frame in frames) if packet is not None]
        return True


def _accepted(answer: Packet, what: str) -> bytes:
    """Return the data behind the result of an answer.

    Raises:
        RefusedError: it says that something was refused.
        WatchError: it says nothing.
    """
    with readable(what):
        code = answer.error or struct.unpack_from("<I", answer.data)[0]
    if code:
        text = MEANINGS[code].text if code in MEANINGS else "error"
        raise RefusedError(f"{what}: {text} (0x{code:X})", code)
    return answer.data[4:]
