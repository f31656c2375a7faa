"""`Commands`: what a connection does for each ADS command (ads 2): from the data of a request to that of its answer."""

import struct
from collections.abc import Callable
from typing import Final, NamedTuple

from motionlayer.connect.ads import _numbers as numbers
from motionlayer.connect.ads import _sums as sums
from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._frame import Address
from motionlayer.connect.ads._group import Order
from motionlayer.connect.ads._router import Router
from motionlayer.connect.ads._service import Later, Outcome, Service, Write
from motionlayer.connect.ads._sum_reads import SumReads

_U32: Final = struct.Struct("<I")
_STATE: Final = struct.Struct("<IHH")
_RESULT: Final = struct.Struct("<II")
_ADDRESS: Final = struct.Struct("<3I")
_BOTH: Final = struct.Struct("<4I")
_CONTROL: Final = struct.Struct("<HHI")
_NOTHING: Final = _U32.pack(Code.NO_ERROR)

Body = bytes | Later[bytes]
"""What follows the header of an answer."""


class Lane(NamedTuple):
    """Who asks whom on a connection.

    Attributes:
        client: who asks.
        service: who is asked.
        served: its address.
        back: addresses of an answer, as they are sent.
    """

    client: Client
    service: Service
    served: Address
    back: bytes


class Commands:
    """The commands of one connection.

    Args:
        router: what all connections share.
        send: takes a packet of notifications.

    Attributes:
        waiting: requests that wait for the run.
        by_number: what is done for each command; gets the data behind the header.
    """

    def __init__(self, router: Router, send: Callable[[bytes], None]) -> None:
        self._router = router
        self._send = send
        self._reads = SumReads(router.image)
        self.waiting = 0
        self.by_number: dict[int, Callable[[Lane, bytes], Body]] = {
            numbers.DEVICE_INFO: lambda lane, _data: _NOTHING + lane.service.device_info(),
            numbers.READ: self._read,
            numbers.WRITE: self._write,
            numbers.STATE: lambda lane, _data: _STATE.pack(Code.NO_ERROR, *lane.service.state()),
            numbers.CONTROL: self._control,
            numbers.ADD_NOTIFICATION: self._add_notification,
            numbers.DELETE_NOTIFICATION: self._delete_notification,
            numbers.READ_WRITE: self._read_write,
        }

    def refused(self, lane: Lane, command: int, error: AdsError) -> bytes:
        """Return the answer to a request that is refused."""
        lane.client.refused(error)
        empty = _RESULT.size if command in (numbers.READ, numbers.READ_WRITE) else _U32.size
        return _U32.pack(error.code).ljust(empty, b"\0")

    def _ask(self, client: Client, write: Write, finish: Callable[[Outcome], bytes]) -> Later[bytes]:
        """Let the run do something, and make the answer out of the outcome."""
        self._require_patience(client)
        later: Later[bytes] = Later()
        told = self._router.outbox.post([write], client.name)
        told.then(lambda outcomes: later.settle(finish(outcomes[0])))
        return later

    def _require_patience(self, client: Client) -> None:
        if self.waiting >= client.limits.waiting:
            raise AdsError(Code.MAILBOX_FULL, f"{client}: {self.waiting} requests wait for the run")

    def _read(self, lane: Lane, data: bytes) -> Body:
        group, offset, length = _unpack(_ADDRESS, data)
        value = lane.service.read(lane.client, group, offset, length)
        return _RESULT.pack(Code.NO_ERROR, len(value)) + value

    def _write(self, lane: Lane, data: bytes) -> Body:
        group, offset, length = _unpack(_ADDRESS, data)
        value = data[_ADDRESS.size :]
        if length != len(value):
            raise AdsError(Code.INVALID_SIZE, f"{len(value)} bytes to write, the request says {length}")
        write = lane.service.write(lane.client, group, offset, value)
        return _NOTHING if write is None else self._ask(lane.client, write, lambda outcome: _U32.pack(outcome.code))

    def _control(self, lane: Lane, data: bytes) -> Body:
        lane.client.require_writing()
        state, device_state, length = _unpack(_CONTROL, data)
        write = lane.service.control(state, device_state, data[_CONTROL.size :][:length])
        return _NOTHING if write is None else self._ask(lane.client, write, lambda outcome: _U32.pack(outcome.code))

    def _read_write(self, lane: Lane, data: bytes) -> Body:
        group, offset, length, written = _unpack(_BOTH, data)
        value = data[_BOTH.size :]
        if written != len(value):
            raise AdsError(Code.INVALID_SIZE, f"{len(value)} bytes to write, the request says {written}")
        if group in numbers.SUMS:
            return self._sum(lane, group, offset, value)
        result = lane.service.read_write(lane.client, group, offset, length, value)
        if isinstance(result, Write):
            return self._ask(
                lane.client, result, lambda outcome: _RESULT.pack(outcome.code, len(outcome.data)) + outcome.data
            )
        return _RESULT.pack(Code.NO_ERROR, len(result)) + result

    def _sum(self, lane: Lane, group: int, count: int, data: bytes) -> Body:
        answer = self._sum_answer(lane, group, count, data)
        if not isinstance(answer, Later):
            return _RESULT.pack(Code.NO_ERROR, len(answer)) + answer
        later: Later[bytes] = Later()
        answer.then(lambda whole: later.settle(_RESULT.pack(Code.NO_ERROR, len(whole)) + whole))
        return later

    def _sum_answer(self, lane: Lane, group: int, count: int, data: bytes) -> Body:
        if group in (numbers.SUM_WRITE, numbers.SUM_READ_WRITE):
            self._require_patience(lane.client)
            ask = sums.write if group == numbers.SUM_WRITE else sums.read_write
            with self._router.image.together():
                return ask(lane.service, lane.client, self._router.outbox, count, data)
        if group == numbers.SUM_ADD_NOTIFICATIONS:
            return self._add_notifications(lane, count, data)
        if group == numbers.SUM_DELETE_NOTIFICATIONS:
            return self._delete_notifications(lane.client, count, data)
        return self._reads.read(lane.service, lane.client, group, count, data)

    def _add_notification(self, lane: Lane, data: bytes) -> Body:
        return _RESULT.pack(Code.NO_ERROR, self._watch(lane, data))

    def _watch(self, lane: Lane, data: bytes) -> int:
        order = Order.parse(data)
        watched = lane.service.watch(lane.client, order.group, order.offset, order.length)
        return self._router.notifications.add(lane.client, lane.served, order, watched, self._send)

    def _delete_notification(self, lane: Lane, data: bytes) -> Body:
        (handle,) = _unpack(_U32, data)
        self._router.notifications.delete(lane.client, handle)
        return _NOTHING

    def _add_notifications(self, lane: Lane, count: int, data: bytes) -> bytes:
        parts = sums.pieces(data, count, 40)
        return b"".join(_told(lane.client, lambda part=part: self._watch(lane, part)) for part in parts)  # type: ignore[misc]

    def _delete_notifications(self, client: Client, count: int, data: bytes) -> bytes:
        def delete(part: bytes) -> int:
            self._router.notifications.delete(client, _U32.unpack(part)[0])
            return 0

        parts = sums.pieces(data, count, 4)
        return b"".join(_told(client, lambda part=part: delete(part))[:4] for part in parts)  # type: ignore[misc]


def _unpack(shape: struct.Struct, data: bytes) -> tuple[int, ...]:
    if len(data) < shape.size:
        raise AdsError(Code.INVALID_SIZE, f"{len(data)} bytes, at least {shape.size} are needed")
    return shape.unpack_from(data)


def _told(client: Client, ask: Callable[[], int]) -> bytes:
    try:
        return _RESULT.pack(Code.NO_ERROR, ask())
    except AdsError as error:
        client.refused(error)
        return _RESULT.pack(error.code, 0)
