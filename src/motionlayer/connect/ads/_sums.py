"""Sum commands that write or ask: many requests in one (ads 6).

The outer result is 0 even where single ones fail. The writes of one sum are asked of the run together, so it applies
them in one tick; until their outcomes are there the answer waits.
"""

import struct
from collections.abc import Callable, Iterator
from typing import Final

from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._numbers import SUMS
from motionlayer.connect.ads._service import Later, Outbox, Outcome, Service, Write

MAX_REQUESTS: Final = 10_000
MAX_ANSWER: Final = 4 * 1024 * 1024 - 64
"""Requests in a sum, and bytes of its answer, at most: what is asked for is what is filled, so a client could ask for
any amount of memory."""

_ADDRESS: Final = struct.Struct("<3I")
_BOTH: Final = struct.Struct("<4I")
_U32: Final = struct.Struct("<I")
_RESULT: Final = struct.Struct("<II")

Answer = bytes | Later[bytes]


def requests(shape: struct.Struct, count: int, data: bytes) -> Iterator[tuple[int, ...]]:
    """Return the requests of a sum, taken apart.

    Raises:
        AdsError: there are too many (0x70B), or too few bytes (0x705).
    """
    if count > MAX_REQUESTS:
        raise AdsError(Code.INVALID_PARAMETER, f"{count} requests in a sum, at most {MAX_REQUESTS}")
    if len(data) < count * shape.size:
        raise AdsError(Code.INVALID_SIZE, f"{len(data)} bytes for {count} requests of {shape.size}")
    return shape.iter_unpack(data[: count * shape.size])


class Room:
    """Bytes that are left in an answer."""

    def __init__(self) -> None:
        self._left = MAX_ANSWER

    def take(self, size: int) -> None:
        """Take bytes, or refuse the sum.

        Raises:
            AdsError: there are not so many left.
        """
        self._left -= size
        if self._left < 0:
            raise AdsError(Code.INVALID_SIZE, f"an answer of more than {MAX_ANSWER} bytes")


class _Batch:
    """Outcomes of the requests of a sum, some of which the run will tell."""

    def __init__(self, client: Client, finish: Callable[[list[Outcome]], bytes]) -> None:
        self._client = client
        self._finish = finish
        self._room = Room()
        self._outcomes: list[Outcome | None] = []
        self._writes: list[Write] = []

    def add(self, ask: Callable[[], bytes | Write | None]) -> None:
        """Add what one request is answered with, or what the run is asked for."""
        try:
            result = ask()
        except AdsError as error:
            self._client.refused(error)
            self._outcomes.append(Outcome(error.code))
            return
        if isinstance(result, Write):
            self._writes.append(result)
            self._outcomes.append(None)
        else:
            self._room.take(len(result or b""))
            self._outcomes.append(Outcome(Code.NO_ERROR, result or b""))

    def answer(self, outbox: Outbox) -> Answer:
        """Return the answer; it comes later where the run has been asked for something, all of it together."""
        if not self._writes:
            return self._complete([])
        later: Later[bytes] = Later()
        outbox.post(self._writes, self._client.name).then(lambda told: later.settle(self._complete(told)))
        return later

    def _complete(self, told: list[Outcome]) -> bytes:
        rest = iter(told)
        return self._finish([next(rest) if outcome is None else outcome for outcome in self._outcomes])


def write(service: Service, client: Client, outbox: Outbox, count: int, data: bytes) -> Answer:
    """Answer F081."""
    asked = list(requests(_ADDRESS, count, data))
    batch = _Batch(client, lambda outcomes: b"".join(_U32.pack(one.code) for one in outcomes))
    at = count * _ADDRESS.size
    if sum(request[2] for request in asked) != len(data) - at:
        raise AdsError(Code.INVALID_SIZE, f"{len(data) - at} bytes to write, not what the requests say")
    for group, offset, length in asked:
        part = data[at : at + length]
        at += length
        batch.add(lambda group=group, offset=offset, part=part: service.write(client, group, offset, part))  # type: ignore[misc]
    return batch.answer(outbox)


def read_write(service: Service, client: Client, outbox: Outbox, count: int, data: bytes) -> Answer:
    """Answer F082."""
    asked = list(requests(_BOTH, count, data))
    at = count * _BOTH.size
    if sum(request[3] for request in asked) != len(data) - at:
        raise AdsError(Code.INVALID_SIZE, f"{len(data) - at} bytes to write, not what the requests say")
    batch = _Batch(client, _results)
    for group, offset, length, written in asked:
        part = data[at : at + written]
        at += written

        def ask(group: int = group, offset: int = offset, length: int = length, part: bytes = part) -> bytes | Write:
            if group in SUMS:
                raise AdsError(Code.INVALID_GROUP, "a sum in a sum")
            return service.read_write(client, group, offset, length, part)

        batch.add(ask)
    return batch.answer(outbox)


def _results(outcomes: list[Outcome]) -> bytes:
    heads = b"".join(_RESULT.pack(one.code, len(one.data)) for one in outcomes)
    return heads + b"".join(one.data for one in outcomes)


def pieces(data: bytes, count: int, size: int) -> list[bytes]:
    """Return `count` pieces of `size` bytes.

    Raises:
        AdsError: there are too many, or too few bytes.
    """
    return [raw[0] for raw in requests(struct.Struct(f"{size}s"), count, data)]  # type: ignore[misc]
