"""`Watcher`: a small ADS client that shows live values of a device.

It knows no more than that: resolve symbols, subscribe, receive. Anything else is the business of real clients.
"""

import itertools
import socket
import struct
from collections.abc import Iterator, Sequence
from types import TracebackType
from typing import Final, NamedTuple, Self

from motionlayer.connect.ads._codes import Code
from motionlayer.connect.ads._frame import REQUEST, RESPONSE, Address, Carrier, Packet, Splitter, framed, net_id
from motionlayer.connect.ads._leaves import Leaf, SymbolEntry, TypeEntry, Value, leaves, symbol_of, type_of
from motionlayer.connect.ads._notify import NOTIFICATION

ADD_NOTIFICATION: Final = 6
READ_WRITE: Final = 9
SYMBOL_BY_NAME: Final = 0xF009
TYPE_BY_NAME: Final = 0xF011
ON_CHANGE: Final = 4
EPOCH: Final = 116_444_736_000_000_000
"""FILETIME of 1970-01-01."""

_NAMES: Final = {int(code): code.name.lower().replace("_", " ") for code in Code}

PATIENCE: Final = 5.0
"""Seconds to wait for a connection or an answer."""


class WatchError(Exception):
    """A device cannot be reached, or has refused something."""


class Sample(NamedTuple):
    """A value that has come.

    Attributes:
        time: of the tick, s since 1970.
        leaf: whose value it is.
        value: the value.
    """

    time: float
    leaf: Leaf
    value: Value


class Watcher:
    """A client of one device, to be used as a context.

    Args:
        host: address of the device.
        port: TCP port.
        target: NetId of the device.
        ads_port: AMS port of the device.

    Raises:
        WatchError: nobody answers there.
    """

    def __init__(self, host: str, port: int, target: str = "127.0.0.1.1.1", ads_port: int = 851) -> None:
        try:
            self._socket = socket.create_connection((host, port), PATIENCE)
        except OSError as error:
            raise WatchError(f"{host}:{port}: {error.strerror or error}; is a run with --ads there?") from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._target = Address(net_id(target), ads_port)
        # Who watches twice from one computer is told apart by the port of the connection.
        self._source = Address(net_id("127.0.0.1.1.2"), self._socket.getsockname()[1])
        self._splitter = Splitter()
        self._packets: list[Packet] = []
        self._numbers = itertools.count(1)
        self._types: dict[str, TypeEntry] = {}
        self._watched: dict[int, Leaf] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._socket.close()

    def watch(self, name: str, cycle: float) -> Sequence[Leaf]:
        """Receive the values of a symbol from now on, whenever they change.

        Args:
            name: any symbol, or a part of one; structures and arrays are watched value by value.
            cycle: how often they are looked at, s.

        Returns:
            The elementary values.

        Raises:
            WatchError: the device refuses.
        """
        found = list(leaves(self._symbol(name), self._type))
        for leaf in found:
            order = struct.pack("<6I16x", leaf.group, leaf.offset, leaf.size, ON_CHANGE, 0, round(cycle * 1e7))
            answer = self._ask(ADD_NOTIFICATION, order, leaf.name)
            self._watched[struct.unpack_from("<I", answer)[0]] = leaf
        return found

    def samples(self, timeout: float | None) -> Iterator[Sample]:
        """Yield what has come; nothing if nothing comes in time.

        Args:
            timeout: seconds to wait for something; without end where left out.

        Raises:
            WatchError: the device is gone.
        """
        if not any(packet.command == NOTIFICATION for packet in self._packets):
            self._receive(timeout)
        packets, self._packets = self._packets, []
        for packet in packets:
            if packet.command == NOTIFICATION:
                yield from self._stream(packet.data)

    def _symbol(self, name: str) -> SymbolEntry:
        return symbol_of(self._by_name(SYMBOL_BY_NAME, name))

    def _type(self, name: str) -> TypeEntry:
        if name not in self._types:
            self._types[name] = type_of(self._by_name(TYPE_BY_NAME, name))
        return self._types[name]

    def _by_name(self, group: int, name: str) -> bytes:
        text = name.encode("cp1252", errors="replace") + b"\0"
        answer = self._ask(READ_WRITE, struct.pack("<4I", group, 0, 0xFFFF_FFFF, len(text)) + text, name)
        return answer[4:]

    def _ask(self, command: int, data: bytes, what: str) -> bytes:
        """Return what a request is answered with, behind the result."""
        number = next(self._numbers)
        packet = Packet(self._target, self._source, command, REQUEST, 0, number, data)
        self._socket.sendall(framed(packet.pack()))
        while True:
            for at, answer in enumerate(self._packets):
                if answer.flags & RESPONSE and answer.invoke_id == number:
                    del self._packets[at]
                    return _accepted(answer, what)
            if not self._receive(PATIENCE):
                raise WatchError(f"{what}: no answer within {PATIENCE:g} s")

    def _receive(self, timeout: float | None) -> bool:
        """Take what comes; tell whether something has."""
        self._socket.settimeout(timeout)
        try:
            data = self._socket.recv(65_536)
        except TimeoutError:
            return False
        except OSError as error:
            raise WatchError(f"the connection is lost: {error.strerror}") from error
        if not data:
            raise WatchError("the device has ended the connection")
        frames = (frame for frame in self._splitter.feed(data) if frame.command == Carrier.PACKET)
        self._packets += [packet for packet in (Packet.parse(frame.data) for frame in frames) if packet is not None]
        return True

    def _stream(self, data: bytes) -> Iterator[Sample]:
        _, stamps = struct.unpack_from("<II", data)
        at = 8
        for _ in range(stamps):
            time, samples = struct.unpack_from("<QI", data, at)
            at += 12
            for _ in range(samples):
                handle, size = struct.unpack_from("<II", data, at)
                leaf = self._watched.get(handle)
                if leaf is not None:
                    yield Sample((time - EPOCH) * 1e-7, leaf, leaf.value(data[at + 8 : at + 8 + size]))
                at += 8 + size


def _accepted(answer: Packet, what: str) -> bytes:
    """Return the data behind the result of an answer.

    Raises:
        WatchError: it says that something was refused.
    """
    code = answer.error or struct.unpack_from("<I", answer.data)[0]
    if code:
        raise WatchError(f"{what}: {_NAMES.get(code, 'error')} (0x{code:X})")
    return answer.data[4:]
