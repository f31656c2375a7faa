"""`SumReads`: sum commands that read (ads 6); all parts of one are of the same tick.

Clients ask for the same sum again and again. Where all its parts lie in the image, what is asked for is worked out
once: the codes of the answer, and where its bytes are. Any other sum is read part by part, out of a copy of the image.
"""

import itertools
import struct
from collections.abc import Sequence
from typing import Final, NamedTuple

from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._numbers import SUM_READ, SUM_READ_EX_2
from motionlayer.connect.ads._service import Image, Service
from motionlayer.connect.ads._sums import MAX_ANSWER, Room, requests

KNOWN: Final = 64
LONGEST: Final = 32 * 1024
ALL: Final = 128 * 1024
"""Sums of a connection that are known at a time, bytes of one, and of all, at most: what is known of a sum takes some
ten times the memory of its bytes."""

WIDEST: Final = 64 * 1024
"""Bytes from the first part to the last, at most, of a sum that is read in one piece."""

_ADDRESS: Final = struct.Struct("<3I")


class _Known(NamedTuple):
    """A sum that has been worked out.

    Attributes:
        age: of the handles of the service; others may mean the same number since then.
        head: what the answer begins with.
        start: first byte in the image.
        length: up to the last.
        cuts: the parts in there; empty where they make up all of it, in order.
    """

    age: int
    head: bytes
    start: int
    length: int
    cuts: tuple[slice, ...]


class SumReads:
    """Sums that one connection reads.

    Args:
        image: what is read.
    """

    def __init__(self, image: Image) -> None:
        self._image = image
        self._known: dict[tuple[Service, int, int, bytes], _Known] = {}
        self._size = 0

    def read(self, service: Service, client: Client, group: int, count: int, data: bytes) -> bytes:
        """Answer F080, F083 and F084; a request that fails occupies its bytes all the same, except in F084.

        Args:
            service: who is asked.
            client: who asks.
            group: which of the three.
            count: of parts; 0 in F080: as many as there are, and the values alone are the answer.
            data: group, offset and length of each.

        Raises:
            AdsError: too many parts (0x70B), or the answer would be too long (0x705).
        """
        known = self._known.get((service, group, count, data))
        if known is None or known.age != service.age:
            known = self._work_out(service, group, count, data)
            if known is None:
                with self._image.together():
                    return _part_by_part(service, client, group, count, data)
        whole = self._image.read(known.start, known.length)
        if not known.cuts:
            return known.head + whole
        return known.head + b"".join([whole[cut] for cut in known.cuts])

    def _work_out(self, service: Service, group: int, count: int, data: bytes) -> _Known | None:
        """Work a sum out and keep that; None where it has to be read part by part."""
        if not data or len(data) > LONGEST:
            return None
        spans = [service.locate(*part) for part in _parts(group, count, data)]
        found = [span for span in spans if span is not None]
        if len(found) < len(spans) or not found:
            return None
        start, stop = min(at for at, _ in found), max(at + size for at, size in found)
        if stop - start > WIDEST or sum(size for _, size in found) > MAX_ANSWER:  # parts may overlap
            return None
        cuts = tuple(slice(at - start, at + size - start) for at, size in found)
        joined = all(one.stop == two.start for one, two in itertools.pairwise(cuts))
        head = b"" if _bare(group, count) else _codes(group, [0] * len(cuts), [size for _, size in found])
        if len(self._known) >= KNOWN or self._size + len(data) > ALL:
            self._known.clear()
            self._size = 0
        self._size += len(data)
        known = _Known(service.age, head, start, stop - start, () if joined else cuts)
        self._known[service, group, count, data] = known
        return known


def _bare(group: int, count: int) -> bool:
    """Tell whether the values alone are the answer."""
    return group == SUM_READ and count == 0


def _parts(group: int, count: int, data: bytes) -> list[tuple[int, ...]]:
    return list(requests(_ADDRESS, len(data) // _ADDRESS.size if _bare(group, count) else count, data))


def _codes(group: int, codes: Sequence[int], lengths: Sequence[int]) -> bytes:
    """Return what stands before the values."""
    if group == SUM_READ:
        return struct.pack(f"<{len(codes)}I", *codes)
    both = [number for result in zip(codes, lengths, strict=True) for number in result]
    return struct.pack(f"<{len(both)}I", *both)


def _part_by_part(service: Service, client: Client, group: int, count: int, data: bytes) -> bytes:
    parts = _parts(group, count, data)
    padded, room = group != SUM_READ_EX_2, Room()
    if padded:
        room.take(sum(length for _, _, length in parts))
    codes, values = [], []
    for part in parts:
        code, value = _one(service, client, part)
        codes.append(code)
        values.append(value)
        if not padded:
            room.take(len(value))
    head = b"" if _bare(group, count) else _codes(group, codes, [len(value) for value in values])
    if padded:
        values = [value.ljust(part[2], b"\0") for value, part in zip(values, parts, strict=True)]
    return b"".join([head, *values])


def _one(service: Service, client: Client, part: tuple[int, ...]) -> tuple[int, bytes]:
    """Return code and bytes of a value."""
    group, offset, length = part
    try:
        return Code.NO_ERROR, service.read(client, group, offset, length)
    except AdsError as error:
        client.refused(error)
        return error.code, b""
