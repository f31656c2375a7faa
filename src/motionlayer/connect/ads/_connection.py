"""`Connection`: one stream of AMS/TCP, from bytes to answers (ads 1 and 2). It does no input or output of its own.

A packet is answered at once, or when the run has done what was asked: then the answer is sent later, and others may
overtake it. What is malformed is answered with the error the protocol has for it; only a frame that cannot be read at
all ends the connection.
"""

import struct
from collections.abc import Callable
from typing import Final

from motionlayer.connect.ads import _sums as sums
from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._frame import NO_RETURN, RESPONSE, Address, Carrier, Frame, Packet, Splitter, framed
from motionlayer.connect.ads._notify import Order
from motionlayer.connect.ads._router import Router
from motionlayer.connect.ads._service import Later, Outcome, Service, Write

DEVICE_INFO: Final = 1
READ: Final = 2
WRITE: Final = 3
STATE: Final = 4
CONTROL: Final = 5
ADD_NOTIFICATION: Final = 6
DELETE_NOTIFICATION: Final = 7
READ_WRITE: Final = 9

_U16: Final = struct.Struct("<H")
_U32: Final = struct.Struct("<I")
_STATE: Final = struct.Struct("<IHH")
_RESULT: Final = struct.Struct("<II")
_ADDRESS: Final = struct.Struct("<3I")
_BOTH: Final = struct.Struct("<4I")
_CONTROL: Final = struct.Struct("<HHI")
_NOTHING: Final = struct.pack("<I", Code.NO_ERROR)

PORTION: Final = 64 * 1024
"""Bytes of answers that are sent together."""

Body = bytes | Later[bytes]
"""What follows the header of an answer."""


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
        self._framed = framed if split else bytes
        self._splitter = Splitter()
        self._clients: dict[Address, Client] = {}
        self._ports: set[int] = set()
        self._waiting = 0
        self._complete, self._looked = 0, -1
        self.closing = False
        """The stream is to be closed when everything has been sent."""
        self.broken = False
        """Nothing can be sent any more; what has come is not answered."""
        self._commands: dict[int, Callable[[Service, Client, Packet], Body]] = {
            DEVICE_INFO: lambda service, _client, _packet: _NOTHING + service.device_info(),
            READ: self._read,
            WRITE: self._write,
            STATE: lambda service, _client, _packet: _STATE.pack(0, *service.state()),
            CONTROL: self._control,
            ADD_NOTIFICATION: self._add_notification,
            DELETE_NOTIFICATION: self._delete_notification,
            READ_WRITE: self._read_write,
        }

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
        return not self._waiting and not any(one.handles or one.notifications for one in self._clients.values())

    def stuck(self) -> bool:
        """Tell whether nothing has been completed since the last call, though a frame has begun or none ever came."""
        waits = self._splitter.pending or not self._complete
        before, self._looked = self._looked, self._complete
        return waits and before == self._complete

    def closed(self) -> None:
        """Release everything that was held for this stream."""
        self.broken = True
        for client in self._clients.values():
            self._router.forget(client)
        self._clients.clear()
        for port in self._ports:
            self._router.release_port(port)
        self._ports.clear()

    def packet(self, raw: bytes) -> bytes:
        """Return the answer to an AMS packet as it is sent; empty where there is none, or none yet."""
        packet = Packet.parse(raw)
        if packet is None:
            head = Packet.head(raw)
            return b"" if head is None or head.flags & RESPONSE else self._answer(head, b"", Code.INVALID_AMS_LENGTH)
        if packet.flags & RESPONSE:
            return b""
        client, error = self._client(packet)
        command = self._commands.get(packet.command)
        if client is None or command is None:
            return self._answer(packet, b"", error or Code.UNKNOWN_COMMAND)
        try:
            body = command(self._router.services[packet.target.port], client, packet)
        except AdsError as refused:
            self._router.told(client, refused)
            empty = _RESULT.size if packet.command in (READ, READ_WRITE) else _U32.size
            body = _U32.pack(refused.code).ljust(empty, b"\0")
        if isinstance(body, Later):
            self._waiting += 1
            body.then(lambda data: self._late(packet, data))
            return b""
        return self._answer(packet, body)

    def _answer(self, packet: Packet, data: bytes, error: int = 0) -> bytes:
        if packet.flags & NO_RETURN:
            return b""
        return self._framed(packet.answer(data, error).pack())

    def _late(self, packet: Packet, data: bytes) -> None:
        self._waiting -= 1
        answer = self._answer(packet, data)
        if answer and not self.broken:
            self._send(answer)

    def _client(self, packet: Packet) -> tuple[Client | None, int]:
        """Return who sends a packet, or None and the AMS error why it is not answered."""
        error = self._router.error_of(packet)
        if error:
            return None, error
        client = self._clients.get(packet.source)
        if client is None:
            if len(self._clients) >= self._router.limits.addresses:
                return None, Code.NO_MEMORY
            client = self._router.admit(packet.source, self._host)
            if client is None:
                return None, Code.TARGET_MACHINE_NOT_FOUND
            self._clients[packet.source] = client
        return client, 0

    def _ask(self, client: Client, write: Write, finish: Callable[[Outcome], bytes]) -> Later[bytes]:
        """Let the run do something, and make the answer out of the outcome."""
        self._require_patience(client)
        later: Later[bytes] = Later()
        told = self._router.outbox.post([write], str(client))
        told.then(lambda outcomes: later.settle(finish(outcomes[0])))
        return later

    def _require_patience(self, client: Client) -> None:
        if self._waiting >= client.limits.waiting:
            raise AdsError(Code.MAILBOX_FULL, f"{client}: {self._waiting} requests wait for the run")

    def _read(self, service: Service, client: Client, packet: Packet) -> Body:
        group, offset, length = _unpack(_ADDRESS, packet.data)
        data = service.read(client, group, offset, length)
        return _RESULT.pack(Code.NO_ERROR, len(data)) + data

    def _write(self, service: Service, client: Client, packet: Packet) -> Body:
        group, offset, length = _unpack(_ADDRESS, packet.data)
        data = packet.data[_ADDRESS.size :]
        if length != len(data):
            raise AdsError(Code.INVALID_SIZE, f"{len(data)} bytes to write, the request says {length}")
        write = service.write(client, group, offset, data)
        return _NOTHING if write is None else self._ask(client, write, lambda outcome: _U32.pack(outcome.code))

    def _control(self, service: Service, client: Client, packet: Packet) -> Body:
        client.require_writing()
        state, device_state, length = _unpack(_CONTROL, packet.data)
        write = service.control(state, device_state, packet.data[_CONTROL.size :][:length])
        return _NOTHING if write is None else self._ask(client, write, lambda outcome: _U32.pack(outcome.code))

    def _read_write(self, service: Service, client: Client, packet: Packet) -> Body:
        group, offset, length, written = _unpack(_BOTH, packet.data)
        data = packet.data[_BOTH.size :]
        if written != len(data):
            raise AdsError(Code.INVALID_SIZE, f"{len(data)} bytes to write, the request says {written}")
        if group in sums.GROUPS:
            return self._sum(service, client, packet, group, offset, data)
        result = service.read_write(client, group, offset, length, data)
        if isinstance(result, Write):
            return self._ask(
                client, result, lambda outcome: _RESULT.pack(outcome.code, len(outcome.data)) + outcome.data
            )
        return _RESULT.pack(Code.NO_ERROR, len(result)) + result

    def _sum(self, service: Service, client: Client, packet: Packet, group: int, count: int, data: bytes) -> Body:
        outbox = self._router.outbox
        if group in (sums.WRITE, sums.READ_WRITE):
            self._require_patience(client)
            ask = sums.write if group == sums.WRITE else sums.read_write
            answer = ask(service, client, outbox, count, data)
        elif group == sums.ADD_NOTIFICATIONS:
            answer = self._add_notifications(service, client, packet, count, data)
        elif group == sums.DELETE_NOTIFICATIONS:
            answer = self._delete_notifications(client, count, data)
        else:
            answer = sums.read(service, client, group, count, data)
        if not isinstance(answer, Later):
            return _RESULT.pack(Code.NO_ERROR, len(answer)) + answer
        later: Later[bytes] = Later()
        answer.then(lambda data: later.settle(_RESULT.pack(Code.NO_ERROR, len(data)) + data))
        return later

    def _add_notification(self, service: Service, client: Client, packet: Packet) -> Body:
        return _RESULT.pack(Code.NO_ERROR, self._watch(service, client, packet, packet.data))

    def _watch(self, service: Service, client: Client, packet: Packet, data: bytes) -> int:
        order = Order.parse(data)
        watched = service.watch(client, order.group, order.offset, order.length)
        return self._router.notifications.add(
            client, packet.target, order, watched, lambda raw: self._send(self._framed(raw))
        )

    def _delete_notification(self, _service: Service, client: Client, packet: Packet) -> Body:
        (handle,) = _unpack(_U32, packet.data)
        self._router.notifications.delete(client, handle)
        return _NOTHING

    def _add_notifications(self, service: Service, client: Client, packet: Packet, count: int, data: bytes) -> bytes:
        parts = sums.pieces(data, count, 40)
        return b"".join(_told(lambda part=part: self._watch(service, client, packet, part)) for part in parts)  # type: ignore[misc]

    def _delete_notifications(self, client: Client, count: int, data: bytes) -> bytes:
        def delete(part: bytes) -> int:
            self._router.notifications.delete(client, _U32.unpack(part)[0])
            return 0

        return b"".join(_told(lambda part=part: delete(part))[:4] for part in sums.pieces(data, count, 4))  # type: ignore[misc]

    def _carrier(self, frame: Frame) -> bytes:
        """Answer what a client asks of the router it believes to talk to (ads 1.2)."""
        if frame.command == Carrier.PORT_CONNECT:
            wanted = _U16.unpack_from(frame.data)[0] if len(frame.data) >= _U16.size else 0
            many = len(self._ports) >= self._router.limits.addresses
            port = None if many else self._router.take_port(wanted)
            if port is None:
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


def _unpack(shape: struct.Struct, data: bytes) -> tuple[int, ...]:
    if len(data) < shape.size:
        raise AdsError(Code.INVALID_SIZE, f"{len(data)} bytes, at least {shape.size} are needed")
    return shape.unpack_from(data)


def _told(ask: Callable[[], int]) -> bytes:
    try:
        return _RESULT.pack(Code.NO_ERROR, ask())
    except AdsError as error:
        return _RESULT.pack(error.code, 0)
