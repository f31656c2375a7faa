"""`History`: the last publications, as far as somebody watches them.

`Published` shows the newest publication. Who must miss none, though the system lets it run only now and then, finds
those since its last look here: a ring of places, each as large as what is published. Of a publication only those grains
are kept that the reader watches, which it marks in a mask; so the writer pays for what is watched, and memory that
nobody watches is never touched.

    writer of publication n                        reader of publication n
    count of place n mod depth = 0                 count of the place = n? else it was not kept, or is gone
    copy the watched grains; note tick, version    copy the watched grains; tick, version
    count of the place = n                         count of the place = n? else it was overtaken

A publication is kept before it is finished, so one that can be seen is there. The version is that of the mask by which
it was kept: what the reader began to watch at version v is in publications from version v on. Nobody waits for anybody,
and the block may be memory shared with another process.
"""

from collections.abc import Iterable
from typing import Final

GRAIN: Final = 512
"""Bytes that are kept or left out together."""

_VERSION: Final = 0
_FIRST: Final = 1
_COUNT, _TICK, _KEPT, _FIELDS = 0, 1, 2, 3  # of a place
_ALIGNMENT: Final = 4096


def _aligned(size: int) -> int:
    return -(-size // _ALIGNMENT) * _ALIGNMENT


class History:
    """A ring of publications, for one writer and one reader.

    Args:
        block: of `History.size_of` bytes, zeros.
        size: bytes of a publication.
        depth: publications that are kept.

    Attributes:
        depth: publications that are kept.
    """

    def __init__(self, block: memoryview, size: int, depth: int) -> None:
        self.depth = depth
        self._size = size
        mask = (_FIRST + _FIELDS * depth) * 8
        places, stride = _aligned(mask + -(-size // GRAIN)), _aligned(size)
        self._header = block[:mask].cast("q")
        self._mask = block[mask : mask - (-size // GRAIN)]
        self._places = [block[at : at + size] for at in range(places, places + depth * stride, stride)]
        self._version = 0
        self._runs: list[slice] = []

    @staticmethod
    def size_of(size: int, depth: int) -> int:
        """Return the size of a block for publications of `size` bytes."""
        return _aligned((_FIRST + _FIELDS * depth) * 8 - (-size // GRAIN)) + depth * _aligned(size)

    def keep(self, count: int, tick: int, image: memoryview) -> None:
        """Keep what is watched of a publication, for the writer; before it is finished.

        Args:
            count: its number, from 1.
            tick: of the run.
            image: its bytes.
        """
        header = self._header
        version = header[_VERSION]
        if version != self._version:
            self._version, self._runs = version, self._marked()
        if not self._runs:
            return
        number = count % self.depth
        at, place = _FIRST + _FIELDS * number, self._places[number]
        header[at] = 0
        for run in self._runs:
            place[run] = image[run]
        header[at + _TICK], header[at + _KEPT] = tick, version
        header[at] = count

    def mark(self, grains: Iterable[int], *, watched: bool) -> None:
        """Keep grains of the publications to come, or no more, for the reader; `version` says from when on."""
        for grain in grains:
            self._mask[grain] = watched
        self._header[_VERSION] += 1
        self._runs = self._marked()

    @property
    def version(self) -> int:
        """Of the mask; what is watched now is in all publications that were kept by this version or a later one."""
        return self._header[_VERSION]

    def tick(self, count: int) -> int | None:
        """Return the tick of a publication; None where it was not kept, or is gone."""
        at = _FIRST + _FIELDS * (count % self.depth)
        return self._header[at + _TICK] if self._header[at] == count else None

    def read(self, count: int, image: memoryview) -> int | None:
        """Copy what is watched of a publication to its place in an image, for the reader.

        Returns:
            The version by which it was kept; None where it was not kept, or is gone, and the copy means nothing.
        """
        header, number = self._header, count % self.depth
        at, place = _FIRST + _FIELDS * number, self._places[number]
        if header[at] != count:
            return None
        for run in self._runs:
            image[run] = place[run]
        version = header[at + _KEPT]
        return version if header[at] == count else None

    def _marked(self) -> list[slice]:
        """Return the watched bytes in as few pieces as they have."""
        runs, mask, end = [], bytes(self._mask), 0
        while (start := mask.find(1, end)) >= 0:
            end = mask.find(0, start)
            end = len(mask) if end < 0 else end
            runs.append(slice(start * GRAIN, min(end * GRAIN, self._size)))
        return runs

    def release(self) -> None:
        """Give the block back; afterwards nothing can be read or written."""
        for view in (self._header, self._mask, *self._places):
            view.release()
