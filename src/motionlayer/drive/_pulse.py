"""The zero pulse of an encoder: once per turn, latched by the drive when it is asked to.

One kernel for the drives of all kinds: what it looks at is the drive position that they reported in this tick.
"""

import math
from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.store import Q, Store

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

ACTUAL_P: Final = Q.ACTUAL_P
SHIFT: Final = Q.SHIFT
INDEX_ARMED: Final = Q.INDEX_ARMED
INDEX_LATCH: Final = Q.INDEX_LATCH


class ZeroPulse(NamedTuple):
    """Where the zero pulses of an encoder are, as drive positions.

    Attributes:
        offset: of one of them, u.
        period: from one to the next, u, > 0.
    """

    offset: float
    period: float


@kernel
def passed_pulse(old: float, new: float, offset: float, period: float) -> float:
    """Return the first pulse on the way from one drive position to another; NaN without one."""
    before, after = math.floor((old - offset) / period), math.floor((new - offset) / period)
    if before == after:
        return math.nan
    return offset + period * (before + 1.0 if after > before else before)


@kernel
def latch(table: Floats, columns: Integers, offsets: Floats, periods: Floats, last: Floats, changed: Integers) -> int:
    """Latch what passed since the last tick where it is asked for; return how many columns changed."""
    count = 0
    for k in range(columns.shape[0]):
        i = columns[k]
        here = table[ACTUAL_P, i] - table[SHIFT, i]
        if table[INDEX_ARMED, i] != 0.0:
            pulse = passed_pulse(last[k], here, offsets[k], periods[k])
            if not math.isnan(pulse):
                table[INDEX_ARMED, i] = 0.0
                table[INDEX_LATCH, i] = pulse
                changed[count] = i
                count += 1
        last[k] = here
    return count


class ZeroPulses:
    """The zero pulses of all encoders that have one.

    Args:
        store: actual values are read, and latches written here.
        pulses: per column.
    """

    def __init__(self, store: Store, pulses: Mapping[int, ZeroPulse]) -> None:
        self._store = store
        self._columns = np.array(list(pulses), dtype=np.int64)
        self._offsets: Floats = np.array([pulse.offset for pulse in pulses.values()])
        self._periods: Floats = np.array([pulse.period for pulse in pulses.values()])
        self._last: Floats = store.table[Q.ACTUAL_P, self._columns] - store.table[Q.SHIFT, self._columns]
        self._changed = np.zeros(len(pulses), dtype=np.int64)

    def inputs(self, _tick: int) -> None:
        """Latch the pulses of this tick; the drives have reported."""
        count = latch(self._store.table, self._columns, self._offsets, self._periods, self._last, self._changed)
        if count:
            self._store.status_changed.extend(self._changed[:count].tolist())
