"""`Connection`: one stream of AMS/TCP, from bytes to answers (ads 1). It does no input or output of its own.

A packet is answered at once, or when the run has done what was asked: then the answer is sent later, and others may
overtake it. What is malformed is answered with the error the protocol has for it; only a frame that cannot be read at
all ends the connection.
"""

import struct
from collections.abc import Callable
from typing import TYPE_CHECKING, Final

from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._commands import Commands, Lane
from motionlayer.connect.ads._frame import (
    ANSWER,
    HEAD,
    NO_RETURN,
    RESPONSE,
    TCP,
    Address,
    Carrier,
    Frame,
    Splitter,
    framed,
)
from motionlayer.connect.ads._router import Router
from motionlayer.connect.ads._service import Later

if TYPE_CHECKING:
    from motionlayer.connect.ads._client import Client

_U16: Final = struct.Struct("<H")
_BACK: Final = struct.Struct("<8s8s")

PORTION: Final = 64 * 1024
"""Bytes of answers that are sent together."""


class Connection:
    """What a server does with one stream.

    Args:
        router: what all connections share.
        host: where the stream comes from.
        send: takes bytes for the stream.
        split: False for a carrier that keeps packets apart and adds no header of its own.
    """

    def __init__(self, router: Router, host: str, send: Callable[[bytes], None], *, split: bool = True) -> None:
        self._router = router
        self._host = host
        self._send = send
        self._from = 0 if split else TCP.size
        self._splitter = Splitter()
        self._clients: dict[Address, Client] = {}
        self._lanes: dict[bytes, Lane] = {}
        self._ports: set[int] = set()
        self._commands = Commands(router, lambda packet: send(framed(packet) if split else packet))
        self._complete, self._begun = 0, -1
        self.closing = False
        """The stream is to be closed when everything has been sent."""
        self.broken = False
        """Nothing can be sent any more; what has come is not answered."""

    def receive(self, data: bytes) -> None:
        """Take bytes of the stream, and send what they are answered with.

        Raises:
            FrameError: they mean nothing; close the stream.
        """
        answers: list[bytes] = []
        size = 0
        for frame in self._splitter.feed(data):
            self._complete += 1
            answer = self.packet(frame.data) if frame.command == Carrier.PACKET else self._carrier(frame)
            answers.append(answer)
            size += len(answer)
            if size > PORTION:  # what is not taken ends the connection before it fills the memory
                self._send(b"".join(answers))
                answers.clear()
                size = 0
            if self.closing or self.broken:
                break
        if size:
            self._send(b"".join(answers))

    @property
    def idle(self) -> bool:
        """Nothing is held for this stream, and nobody waits for an answer."""
        return not self._commands.waiting and not any(
            one.handles or one.notifications for one in self._clients.values()
        )

    def stuck(self) -> bool:
        """Tell whether a frame that had begun at the last call has not come to its end."""
        before, self._begun = self._begun, self._complete if self._splitter.pending else -1
        return before == self._begun >= 0

    def closed(self) -> None:
        """Release everything that was held for this stream."""
        self.broken = True
        for client in self._clients.values():
            self._router.forget(client)
        self._clients.clear()
        self._lanes.clear()
        for port in self._ports:
            self._router.release_port(port)
        self._ports.clear()

    def packet(self, raw: bytes) -> bytes:
        """Return the answer to an AMS packet as it is sent; empty where there is none, or none yet."""
        if len(raw) < HEAD.size or (head := HEAD.unpack_from(raw))[2] & RESPONSE:
            return b""
        addresses, command, flags, length, _, number = head
        lane, error = self._lanes.get(addresses), Code.NO_ERROR
        if length != len(raw) - HEAD.size:
            lane, error = None, Code.INVALID_AMS_LENGTH
        elif lane is None:
            lane, error = self._new_lane(addresses)
        act = self._commands.by_number.get(command)
        if lane is None or act is None:
            return self._answer(_back(addresses), command, flags, number, b"", error or Code.UNKNOWN_COMMAND)
        try:
            body = act(lane, raw[HEAD.size :])
        except AdsError as refused:
            body = self._commands.refused(lane, command, refused)
        if isinstance(body, Later):
            self._commands.waiting += 1
            body.then(lambda data: self._late(lane.back, command, flags, number, data))
            return b""
        return self._answer(lane.back, command, flags, number, body)

    def _answer(self, back: bytes, command: int, flags: int, number: int, body: bytes, error: int = 0) -> bytes:
        if flags & NO_RETURN:
            return b""
        size = len(body)
        answer = ANSWER.pack(0, HEAD.size + size, back, command, flags | RESPONSE, size, error, number) + body
        return answer[self._from :]

    def _late(self, back: bytes, command: int, flags: int, number: int, body: bytes) -> None:
        self._commands.waiting -= 1
        answer = self._answer(back, command, flags, number, body)
        if answer and not self.broken:
            self._send(answer)

    def _new_lane(self, addresses: bytes) -> tuple[Lane | None, Code]:
        """Return who asks whom by these addresses, or the AMS error why they are not answered."""
        served = Address(addresses[:6], int.from_bytes(addresses[6:8], "little"))
        error = self._router.error_of(served)
        if error:
            return None, error
        source = Address(addresses[8:14], int.from_bytes(addresses[14:16], "little"))
        client = self._clients.get(source)
        if client is None:
            if len(self._clients) >= self._router.limits.addresses:
                self._router.tell(f"{source} at {self._host}", "too many addresses on one connection")
                return None, Code.NO_MEMORY
            client = self._router.admit(source, self._host)
            if client is None:
                return None, Code.TARGET_MACHINE_NOT_FOUND
            self._clients[source] = client
        lane = Lane(client, self._router.services[served.port], served, _back(addresses))
        self._lanes[addresses] = lane
        return lane, Code.NO_ERROR

    def _carrier(self, frame: Frame) -> bytes:
        """Answer what a client asks of the router it believes to talk to (ads 1.2)."""
        if frame.command == Carrier.PORT_CONNECT:
            wanted = _U16.unpack_from(frame.data)[0] if len(frame.data) >= _U16.size else 0
            many = len(self._ports) >= self._router.limits.addresses
            port = None if many else self._router.take_port(wanted)
            if port is None:
                self._router.tell(self._host, f"AMS port {wanted} is taken, or too many are; it is disconnected")
                self.closing = True
                return b""
            self._ports.add(port)
            return framed(self._router.net_id + _U16.pack(port), frame.command)
        if frame.command == Carrier.LOCAL_NET_ID:
            return framed(self._router.net_id, frame.command)
        if frame.command == Carrier.PORT_CLOSE:
            self.closing = True
            return framed(b"", frame.command)
        return b""


def _back(addresses: bytes) -> bytes:
    """Return the addresses of a request as those of its answer."""
    target, source = _BACK.unpack(addresses)
    return _BACK.pack(source, target)
