"""`RowEncoder`: rows as the cycle leaves them, to the columns of a ROWS chunk.

The work is done by kernels on some thousand values at a time. A kernel keeps the GIL: a cycle thread that wakes up
in the meantime waits for the end of one call, not of a block. The checksum of each part that is yielded is taken
before the next one is made, which lets go of the GIL.
"""

from collections.abc import Iterator
from itertools import chain
from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.record._rows import CONSTANT, DELTA, DELTAS, HEAD, RAW, column_sizes

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Bytes = NDArray[np.uint8]
Buffer = bytes | memoryview

EXACT: Final = 2.0**50
"""Integers up to here survive times and divided by a resolution; larger values are kept as they are."""

BATCH: Final = 1 << 14
"""Values for one call of a kernel: some ten microseconds."""

LIMITS: Final = np.array([np.iinfo(dtype).max for dtype in DELTAS[:-1]], dtype=np.int64)
"""Greatest magnitude of a difference of each kind but the last."""


@kernel
def mark_changes(bits: Integers, start: int, stop: int, changed: Integers) -> None:
    """Mark the columns whose rows `start` to `stop` (exclusive) have other bits than row 0; 0 is unmarked."""
    for row in range(start, stop):
        for column in range(bits.shape[1]):
            changed[column] |= bits[row, column] ^ bits[0, column]


@kernel
def transpose(values: Floats, chosen: NDArray[np.intp], columns: Floats) -> None:
    """Copy the chosen columns of `values` into the rows of `columns`."""
    for begin in range(0, chosen.shape[0], 8):  # eight values share a cache line
        end = min(begin + 8, chosen.shape[0])
        for row in range(values.shape[0]):
            for k in range(begin, end):
                columns[k, row] = values[row, chosen[k]]


@kernel
def quantise_columns(
    values: Floats, chosen: NDArray[np.intp], resolution: Floats, columns: Floats, steps: Integers, kinds: Bytes
) -> None:
    """Round the chosen columns of `values` to multiples of their resolutions, and find out how each is kept.

    A value that cannot be rounded stays as it is, and with one of these the column is RAW. Minus zero becomes zero.

    Args:
        values: shape (ticks, signals).
        chosen: numbers of columns; nothing else is touched.
        resolution: shape (signals,), positive where chosen.
        columns: shape (len(chosen), ticks), receives the rounded values.
        steps: the same shape, receives the multiples; 0 where there is none.
        kinds: shape (signals,), receives the kind.
    """
    for k in range(chosen.shape[0]):
        unit = resolution[chosen[k]]
        whole = True
        widest = 0
        for row in range(values.shape[0]):
            value = values[row, chosen[k]]
            multiple = np.rint(value / unit)
            rounded = multiple * unit + 0.0
            fits = abs(multiple) <= EXACT and abs(rounded) < np.inf
            columns[k, row] = rounded if fits else value
            steps[k, row] = int(multiple) if fits else 0
            whole = whole and fits
            widest = max(widest, abs(steps[k, row] - steps[k, max(row - 1, 0)]))
        kind = DELTA
        while kind - DELTA < LIMITS.shape[0] and widest > LIMITS[kind - DELTA]:
            kind += 1
        kinds[chosen[k]] = RAW if not whole else CONSTANT if widest == 0 else kind


@kernel
def pack_differences(steps: Integers, width: int, packed: Bytes) -> None:
    """Write the differences along the rows of `steps` one after the other, little-endian, `width` bytes each."""
    place = 0
    for k in range(steps.shape[0]):
        for row in range(1, steps.shape[1]):
            difference = steps[k, row] - steps[k, row - 1]
            for byte in range(width):
                packed[place + byte] = (difference >> (8 * byte)) & 0xFF
            place += width


class RowEncoder:
    """Encodes blocks of the same signals.

    Args:
        resolution: shape (signals,); 0 keeps every bit.
    """

    def __init__(self, resolution: Floats) -> None:
        self._resolution = resolution
        self._lossy = np.flatnonzero(resolution > 0.0)
        # Every kernel these signals need is compiled before the first cycle.
        step = np.where(resolution > 0.0, resolution, 1.0)
        list(self.encode(0, np.array([np.zeros(len(step)), step]))[1])

    def encode(self, first: int, values: Floats) -> tuple[int, Iterator[Buffer]]:
        """Return the payload of a ROWS chunk: its size in bytes, and its parts one after the other.

        Args:
            first: tick of the first row.
            values: shape (ticks, signals), C-contiguous, at least one tick; left as it is, and needed until the
                last part has been taken.
        """
        ticks, signals = values.shape
        kinds = np.where(_changed(values), RAW, CONSTANT).astype(np.uint8)
        rounded, steps = self._quantised(values, kinds)
        begin = values[0].copy()
        begin[self._lossy] = rounded[:, 0]
        head = (HEAD.pack(first, ticks, signals), kinds.tobytes(), begin[kinds == CONSTANT].tobytes())
        size = HEAD.size + signals + int((column_sizes(ticks)[kinds]).sum())
        return size, chain(head, self._raw(values, rounded, kinds), self._deltas(steps, kinds))

    def _quantised(self, values: Floats, kinds: Bytes) -> tuple[Floats, Integers]:
        """Return the columns with a resolution, rounded, and as multiples of it; note their kinds."""
        shape = len(self._lossy), len(values)
        rounded, steps = np.empty(shape), np.empty(shape, np.int64)
        with np.errstate(all="ignore"):  # values that are not finite, in the kernels' plain mode
            for part in _batches(len(self._lossy), len(values)):
                chosen = self._lossy[part]
                quantise_columns(values, chosen, self._resolution, rounded[part], steps[part], kinds)
        for k in np.flatnonzero(kinds[self._lossy] == RAW):
            bits = rounded[k].view(np.int64)
            if (bits == bits[0]).all():
                kinds[self._lossy[k]] = CONSTANT
        return rounded, steps

    def _raw(self, values: Floats, rounded: Floats, kinds: Bytes) -> Iterator[Buffer]:
        raw = np.flatnonzero(kinds == RAW)
        for part in _batches(len(raw), len(values)):
            columns = np.empty((len(raw[part]), len(values)))
            transpose(values, raw[part], columns)
            for k in np.flatnonzero(self._resolution[raw[part]] > 0.0):
                columns[k] = rounded[np.searchsorted(self._lossy, raw[part][k])]
            yield columns.data.cast("B")

    def _deltas(self, steps: Integers, kinds: Bytes) -> Iterator[Buffer]:
        ticks = steps.shape[1]
        for kind, dtype in enumerate(DELTAS, DELTA):
            chosen = np.flatnonzero(kinds[self._lossy] == kind)
            yield steps[chosen, 0].tobytes()
            for part in _batches(len(chosen), ticks):
                columns = steps[chosen[part]]
                packed = np.empty(len(columns) * (ticks - 1) * dtype.itemsize, np.uint8)
                pack_differences(columns, dtype.itemsize, packed)
                yield packed.data


def _changed(values: Floats) -> Integers:
    """Return a number for each column that is not 0 if its bits are not all the same."""
    ticks, signals = values.shape
    changed = np.zeros(signals, np.int64)
    rows = max(1, BATCH // max(1, signals))
    for start in range(1, ticks, rows):
        mark_changes(values.view(np.int64), start, min(start + rows, ticks), changed)
    return changed


def _batches(columns: int, ticks: int) -> Iterator[slice]:
    """Yield spans of columns of so many values that a kernel stays short."""
    most = max(1, BATCH // ticks)
    for start in range(0, columns, most):
        yield slice(start, min(start + most, columns))


def quantise(values: Floats, resolution: float) -> Floats:
    """Return a signal rounded as in recording; doing it twice changes nothing.

    Args:
        values: shape (ticks,).
        resolution: positive.
    """
    columns, steps = np.empty((1, len(values))), np.empty((1, len(values)), np.int64)
    rounded: Floats = columns[0]
    with np.errstate(all="ignore"):
        quantise_columns(
            values[:, None], np.zeros(1, np.intp), np.array([resolution]), columns, steps, np.zeros(1, np.uint8)
        )
    return rounded
