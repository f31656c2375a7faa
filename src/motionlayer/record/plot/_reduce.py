"""Fewer points that draw the same curve.

A curve keeps those of its rows whose polyline passes every row left out within a tolerance: a smooth move needs
a few, a ramp or a rest two, and no peak is lost by more than the tolerance. One pass does it: from the last kept
row, every row narrows the cone of slopes that stay close enough to it; the next kept row is the last one that lay
inside the cone before the cone closed. A curve that is noise cannot be drawn like that in few points; it keeps
the least and the greatest value of every bucket of rows.
"""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

FINEST: Final = 2.0**-11
"""Tolerance of a curve as a share of its range: an eighth of a pixel in the tallest panel."""

COARSEST: Final = 2.0**-9


class Reduced(NamedTuple):
    """Rows kept of each curve; the share of its range within which they draw it; curves that are thinned."""

    rows: list[Indices]
    tolerance: float
    thinned: int


@kernel
def _reach(time: Floats, values: Floats, tolerance: Floats, anchor: int, low: Floats, high: Floats) -> int:
    """Return the last row to which a straight line from `anchor` passes all rows between closely enough."""
    low[:] = -np.inf
    high[:] = np.inf
    reached = anchor + 1
    for row in range(anchor + 1, time.shape[0]):
        span = time[row] - time[anchor]
        inside = True
        still = True
        for k in range(values.shape[0]):
            if not (abs(values[k, row]) < np.inf and abs(values[k, anchor]) < np.inf):
                inside = still = False  # no line leads across a value that is not finite
                continue
            rise = values[k, row] - values[k, anchor]
            inside = inside and low[k] * span <= rise <= high[k] * span
            low[k] = max(low[k], (rise - tolerance[k]) / span)
            high[k] = min(high[k], (rise + tolerance[k]) / span)
            still = still and low[k] <= high[k]
        if inside:
            reached = row
        if not still:
            break
    return reached


@kernel
def _follow(time: Floats, values: Floats, tolerance: Floats, kept: NDArray[np.int64]) -> int:
    """Write the rows that are kept, return how many."""
    low = np.empty(values.shape[0])
    high = np.empty(values.shape[0])
    kept[0] = 0
    count = 1
    while kept[count - 1] < time.shape[0] - 1:
        kept[count] = _reach(time, values, tolerance, kept[count - 1], low, high)
        count += 1
    return count


def follow(time: Floats, columns: Sequence[Floats], tolerance: Sequence[float]) -> Indices:
    """Return the rows whose polyline over time passes every row of each column within its tolerance.

    Args:
        time: shape (n,), n > 0, ascending.
        columns: each of shape (n,); the rows are common to all.
        tolerance: of each column, in its unit.
    """
    kept = np.empty(len(time), np.int64)
    count = _follow(np.ascontiguousarray(time), np.array(columns), np.array(tolerance, np.float64), kept)
    return kept[:count].astype(np.intp)


def reduce(time: Floats, columns: Sequence[Floats], points: int, stretch: Indices) -> Reduced:
    """Choose rows for curves under one tolerance, relative to the range of each, as fine as `points` allow.

    Args:
        time: shape (n,), n > 0, ascending.
        columns: each of shape (n,).
        points: that all curves together may have.
        stretch: rows to keep in every curve, if they take less than a third of the points.
    """
    share = points // max(len(columns), 1)
    whole = stretch if 3 * len(stretch) <= share else stretch[:0]
    tolerance = FINEST
    while True:
        rows = [np.union1d(follow(time, [column], [tolerance * extent(column)]), whole) for column in columns]
        if sum(map(len, rows)) <= points:
            return Reduced(rows, tolerance, 0)
        if tolerance >= COARSEST:
            break
        tolerance *= 2.0
    chosen = [
        kept if len(kept) <= share else _thin_around(c, share, stretch) for kept, c in zip(rows, columns, strict=True)
    ]
    return Reduced(chosen, tolerance, sum(len(kept) > share for kept in rows))


def extent(values: Floats) -> float:
    """Return the range of the finite values, 0 if there are none."""
    finite = values[np.isfinite(values)]
    return float(np.ptp(finite)) if len(finite) else 0.0


def _thin_around(values: Floats, points: int, stretch: Indices) -> Indices:
    """Thin with half of the points in the stretch, which is what is seen first."""
    if not len(stretch):
        return thin(values, points)
    return np.union1d(thin(values, points // 2), stretch[thin(values[stretch], points // 2 - 4)])


def thin(values: Floats, points: int) -> Indices:
    """Return about `points` ascending rows: the ends, the least and greatest value of every bucket."""
    count = len(values)
    if count <= points:
        return np.arange(count)
    width = -(-count // max(points // 2, 1))
    padded = np.append(values, np.full(-count % width, values[-1])).reshape(-1, width)
    starts = np.arange(len(padded)) * width
    found = [starts + padded.argmin(axis=1), starts + padded.argmax(axis=1), [0, count - 1]]
    return np.unique(np.minimum(np.concatenate(found), count - 1))


def steps(values: Floats, points: int) -> Indices:
    """Return rows at which a stepwise signal changes, and its ends; thinned if there are too many."""
    changes = np.flatnonzero(values[1:] != values[:-1]) + 1
    if len(changes) > points:
        return thin(values, points)
    return np.unique(np.concatenate([[0], changes, [len(values) - 1]])).astype(np.intp)
