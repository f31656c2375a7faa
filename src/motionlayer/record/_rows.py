"""Blocks of rows as bytes: columns grouped by how they are kept.

Kinds: 0 one value, 1 float64 as it is, 2-5 integers times the resolution: the first as int64, then
differences as int8, int16, int32 or int64, the smallest that holds them.
"""

import struct
from typing import Final

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

HEAD: Final = struct.Struct("<qII")
CONSTANT: Final = 0
RAW: Final = 1
DELTA: Final = 2
DELTAS: Final = tuple(np.dtype(code) for code in ("<i1", "<i2", "<i4", "<i8"))


def column_sizes(ticks: int) -> NDArray[np.int64]:
    """Return how many bytes a column of each kind takes."""
    deltas = [8 + (ticks - 1) * dtype.itemsize for dtype in DELTAS]
    return np.array([8, 8 * ticks, *deltas], dtype=np.int64)


class RowBlock:
    """A ROWS chunk that was read; a column is decoded when it is asked for.

    Attributes:
        first: tick of the first row.
        ticks: number of rows.

    Raises:
        ValueError, struct.error, IndexError: the payload is none, or not one of `signals` columns.
    """

    __slots__ = ("_kinds", "_payload", "_starts", "first", "ticks")

    def __init__(self, payload: memoryview, signals: int) -> None:
        self.first, self.ticks, columns = HEAD.unpack_from(payload)
        self._payload = payload
        self._kinds = np.frombuffer(payload, np.uint8, columns, HEAD.size)
        if columns != signals or not self.ticks:
            raise ValueError(f"{columns} columns of {self.ticks} rows; {signals} columns are expected")
        sizes = column_sizes(self.ticks)
        counts = np.bincount(self._kinds, minlength=len(sizes))
        ends = HEAD.size + columns + np.cumsum(counts * sizes)
        if ends[-1] != len(payload):
            raise ValueError(f"{len(payload)} bytes; {ends[-1]} are expected")
        self._starts = ends - counts * sizes

    def column(self, number: int, resolution: float) -> Floats:
        """Return column `number`, shape (ticks,); may be a view of the file's bytes."""
        kind = int(self._kinds[number])
        rank = int(np.count_nonzero(self._kinds[:number] == kind))
        start = int(self._starts[kind])
        if kind == CONSTANT:
            return np.full(self.ticks, np.frombuffer(self._payload, "<f8", 1, start + 8 * rank)[0])
        if kind == RAW:
            return np.frombuffer(self._payload, "<f8", self.ticks, start + 8 * rank * self.ticks)
        dtype = DELTAS[kind - DELTA]
        group = int(np.count_nonzero(self._kinds == kind))
        offset = start + 8 * group + rank * (self.ticks - 1) * dtype.itemsize
        steps = np.empty(self.ticks, dtype=np.int64)
        steps[0] = np.frombuffer(self._payload, "<i8", 1, start + 8 * rank)[0]
        steps[1:] = np.frombuffer(self._payload, dtype, self.ticks - 1, offset)
        return np.cumsum(steps) * resolution + 0.0
