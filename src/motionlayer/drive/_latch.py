"""What the drive latches for a homing: the reference behind the cam, when it is asked to.

Four signals, looked at by one kernel for the drives of all kinds; it knows the drive positions that they reported in
this tick and the one before, x and x':

- the zero pulse, once per `period`, and the overflow of the encoder's count, once per `turn`. Both have been passed
  where floor((x - offset) / period) has changed; the place is the multiple in between.
- an edge of the latch input, which is on where low <= x <= high. Hardware catches the edge itself, wherever in the
  cycle it was, and also where the input was on for less than a cycle.
- the same edge, caught by the program of the drive: it reads its input once per cycle. The place is where the drive
  then is, up to a cycle behind the edge, and an input that was on for less than a cycle is missed.
"""

import math
from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.store import Latch, Q, Store

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# Kernels see plain integers.
ACTUAL_P: Final = Q.ACTUAL_P
SHIFT: Final = Q.SHIFT
LATCH_ASKED: Final = Q.LATCH_ASKED
LATCH_P: Final = Q.LATCH_P

ZERO_PULSE: Final = Latch.ZERO_PULSE
OVERFLOW: Final = Latch.OVERFLOW
RISING: Final = Latch.RISING
FALLING: Final = Latch.FALLING
SOFT_RISING: Final = Latch.SOFT_RISING


class LatchSignals(NamedTuple):
    """What a drive can latch, as drive positions; what is infinite is not there.

    Attributes:
        pulse: of one zero pulse, u.
        period: from one zero pulse to the next, u, > 0.
        turn: from one overflow of the encoder's count to the next, u, > 0; one is at 0.
        low: least position at which the latch input is on, u.
        high: greatest, u.
    """

    pulse: float = 0.0
    period: float = math.inf
    turn: float = math.inf
    low: float = math.inf
    high: float = math.inf


@kernel
def passed_multiple(old: float, new: float, offset: float, period: float) -> float:
    """Return the first offset + k period on the way from one drive position to another; NaN without one."""
    before, after = math.floor((old - offset) / period), math.floor((new - offset) / period)
    if before == after:
        return math.nan
    return offset + period * (before + 1.0 if after > before else before)


@kernel
def passed_edge(old: float, new: float, low: float, high: float, rising: bool) -> float:
    """Return the edge of one kind on the way of an input that is on from low to high; NaN without one."""
    edge = low if rising == (new > old) else high
    before, after = (old, new) if new > old else (-old, -new)
    place = edge if new > old else -edge
    passed = before < place <= after if rising else before <= place < after
    return edge if passed else math.nan


@kernel
def seen_edge(old: float, new: float, low: float, high: float, rising: bool) -> float:
    """Return the new position where the input, read once per cycle, has an edge of one kind; NaN without one."""
    before, after = low <= old <= high, low <= new <= high
    return new if before != after and after == rising else math.nan


@kernel
def latched(asked: float, old: float, new: float, signals: Floats) -> float:
    """Return the place of what is asked for, if it has come on the way; NaN if not.

    Args:
        asked: one of `Latch`.
        old: drive position of the tick before.
        new: drive position.
        signals: fields of `LatchSignals`.
    """
    pulse, period, turn, low, high = signals
    if asked == ZERO_PULSE:
        return passed_multiple(old, new, pulse, period)
    if asked == OVERFLOW:
        return passed_multiple(old, new, 0.0, turn)
    if asked in (RISING, FALLING):
        return passed_edge(old, new, low, high, asked == RISING)
    return seen_edge(old, new, low, high, asked == SOFT_RISING)


@kernel
def latch(table: Floats, columns: Integers, signals: Floats, last: Floats, changed: Integers) -> int:
    """Latch what came since the last tick where it is asked for; return how many columns changed."""
    count = 0
    for k in range(columns.shape[0]):
        i = columns[k]
        here = table[ACTUAL_P, i] - table[SHIFT, i]
        if table[LATCH_ASKED, i] != 0.0:
            place = latched(table[LATCH_ASKED, i], last[k], here, signals[k])
            if not math.isnan(place):
                table[LATCH_ASKED, i] = 0.0
                table[LATCH_P, i] = place
                changed[count] = i
                count += 1
        last[k] = here
    return count


class Latches:
    """The latches of all drives that have something to latch.

    Args:
        store: actual values are read, and latches written here.
        signals: per column.
    """

    def __init__(self, store: Store, signals: Mapping[int, LatchSignals]) -> None:
        self._store = store
        self._columns = np.array(list(signals), dtype=np.int64)
        self._signals: Floats = np.array(list(signals.values()))
        self._last: Floats = store.table[Q.ACTUAL_P, self._columns] - store.table[Q.SHIFT, self._columns]
        self._changed = np.zeros(len(signals), dtype=np.int64)

    def inputs(self, _tick: int) -> None:
        """Latch what came in this tick; the drives have reported."""
        count = latch(self._store.table, self._columns, self._signals, self._last, self._changed)
        if count:
            self._store.status_changed.extend(self._changed[:count].tolist())
