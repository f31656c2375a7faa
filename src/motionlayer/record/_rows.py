"""Blocks of rows as bytes: columns grouped by how they are kept, each group by whole-array operations.

Kinds: 0 one value, 1 float64 as it is, 2-5 integers times the resolution: the first as int64, then
differences as int8, int16, int32 or int64, the smallest that holds them.
"""

import struct
from typing import Final

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

HEAD: Final = struct.Struct("<qII")
CONSTANT: Final = 0
RAW: Final = 1
DELTA: Final = 2
DELTAS: Final = tuple(np.dtype(code) for code in ("<i1", "<i2", "<i4", "<i8"))
DELTA_LIMITS: Final = tuple(np.iinfo(dtype).max for dtype in DELTAS[:-1])
EXACT: Final = 2.0**50
"""Integers up to here survive times and divided by a resolution; larger values are kept as they are."""


def quantise(values: Floats, resolution: Floats | float) -> Floats:
    """Return values rounded to integers times a resolution; 0 and what cannot be rounded stay as they are.

    Doing it twice changes nothing. Minus zero becomes zero.
    """
    with np.errstate(all="ignore"):  # a resolution of 0 and values that are not finite fall out below
        steps = np.rint(values / resolution)
        rounded = steps * resolution + 0.0
        fits = (np.abs(steps) <= EXACT) & np.isfinite(rounded) & (np.asarray(resolution) > 0.0)
    return np.where(fits, rounded, values)


def encode_rows(first: int, block: Floats, resolution: Floats) -> bytes:
    """Return the payload of a ROWS chunk.

    Args:
        first: tick of the first row.
        block: shape (ticks, signals), at least one tick.
        resolution: shape (signals,), 0 keeps every bit.
    """
    columns = np.array(block.T, order="C")  # a copy even where the transpose is contiguous: the caller's block stays
    lossy = resolution > 0.0
    if lossy.any():
        columns[lossy] = quantise(columns[lossy], resolution[lossy, None])
    bits = columns.view(np.int64)
    constant = (bits == bits[:, :1]).all(axis=1)
    kinds = np.where(constant, CONSTANT, RAW).astype(np.uint8)
    steps = _steps(columns, resolution, kinds, np.flatnonzero(lossy & ~constant))
    groups = [columns[kinds == CONSTANT, 0].tobytes(), columns[kinds == RAW].tobytes()]
    for kind, dtype in enumerate(DELTAS, DELTA):
        chosen = [steps[column] for column in np.flatnonzero(kinds == kind).tolist()]
        groups += [column[:1].tobytes() for column in chosen]
        groups += [np.diff(column).astype(dtype).tobytes() for column in chosen]
    return b"".join((HEAD.pack(first, len(block), len(columns)), kinds.tobytes(), *groups))


def _steps(
    columns: Floats, resolution: Floats, kinds: NDArray[np.uint8], lossy: NDArray[np.intp]
) -> dict[int, Integers]:
    """Return the columns that can be kept as integers, and note in `kinds` how wide their differences are."""
    steps = {}
    for column in lossy.tolist():
        with np.errstate(all="ignore"):
            integers = np.rint(columns[column] / resolution[column])
            kept = np.array_equal(integers * resolution[column] + 0.0, columns[column])
        if not kept or not (np.abs(integers) <= EXACT).all():  # nan, inf, or beyond what integers can say
            continue
        steps[column] = integers.astype(np.int64)
        widest = int(np.abs(np.diff(steps[column])).max())
        kinds[column] = DELTA + sum(widest > limit for limit in DELTA_LIMITS)
    return steps


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
        deltas = [8 + (self.ticks - 1) * dtype.itemsize for dtype in DELTAS]
        sizes = np.array([8, 8 * self.ticks, *deltas])
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
