"""The monitors of all axes in one pass; the rules are those of function-blocks 3.7."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.store import Q

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

SET_V: Final = Q.SET_V
ACTUAL_P: Final = Q.ACTUAL_P
MIN_P: Final = Q.MIN_P
MAX_P: Final = Q.MAX_P
STATE: Final = Q.STATE
READY: Final = Q.READY
LAG: Final = Q.LAG
TARGET: Final = Q.TARGET
WINDOWS: Final = Q.WINDOWS

# Rows of the parameters: limits in u, times in ticks; infinite where a monitor is off.
LAG_LIMIT: Final = 0
LAG_TICKS: Final = 1
RANGE_WINDOW: Final = 2
TARGET_WINDOW: Final = 3
TARGET_TICKS: Final = 4
ALARM_TICKS: Final = 5
MARGIN: Final = 6
PARAMETERS: Final = 7

# Rows of the states.
LAGGING: Final = 0
"""Ticks for which the lag has been above its limit."""
INSIDE: Final = 1
"""Ticks for which the actual position has been inside the target window."""
WAITING: Final = 2
"""Ticks since the setpoint arrived, if somebody waits for the window; else -1."""
FLAGS: Final = 3
"""Bits `IN_RANGE`, `IN_TARGET`, `BELOW`, `ABOVE`."""
STATES: Final = 4

# Bits of flags, and of what happened.
IN_RANGE: Final = 1
IN_TARGET: Final = 2
BELOW: Final = 4
ABOVE: Final = 8
LAG_ERROR: Final = 16
ALARM: Final = 32
ARRIVED: Final = 64

STOPPING: Final = 4.0
HOMING: Final = 5.0


@kernel
def watch_lag(par: Floats, state: Floats, k: int, lag: float, ready: float) -> int:
    """Return LAG_ERROR in the tick in which the lag has been above its limit for longer than the filter time."""
    if ready == 0.0 or not abs(lag) > par[LAG_LIMIT, k]:
        state[LAGGING, k] = 0.0
        return 0
    state[LAGGING, k] += 1.0
    return LAG_ERROR if state[LAGGING, k] == par[LAG_TICKS, k] + 1.0 else 0


@kernel
def watch_windows(par: Floats, state: Floats, k: int, deviation: float) -> int:
    """Return IN_RANGE and IN_TARGET as they are; a NaN is outside."""
    state[INSIDE, k] = state[INSIDE, k] + 1.0 if deviation <= par[TARGET_WINDOW, k] else 0.0
    flags = IN_RANGE if deviation <= par[RANGE_WINDOW, k] else 0
    return flags | IN_TARGET if state[INSIDE, k] > par[TARGET_TICKS, k] else flags


@kernel
def watch_arrival(par: Floats, state: Floats, k: int, arrived: bool) -> int:
    """Return ARRIVED or ALARM where somebody waits for the window."""
    if state[WAITING, k] < 0.0:
        return 0
    if arrived:
        state[WAITING, k] = -1.0
        return ARRIVED
    state[WAITING, k] += 1.0
    if state[WAITING, k] > par[ALARM_TICKS, k]:
        state[WAITING, k] = -1.0
        return ALARM
    return 0


@kernel
def look(table: Floats, columns: Integers, par: Floats, state: Floats, done: Integers, events: Integers) -> int:
    """Look at all monitored axes; write index and bits of those to which something happened, return their number."""
    actual, target, lag, ready = table[ACTUAL_P], table[TARGET], table[LAG], table[READY]
    axis_state, speed, low, high = table[STATE], table[SET_V], table[MIN_P], table[MAX_P]
    count = 0
    for k in range(columns.shape[0]):
        i = columns[k]
        bits = watch_lag(par, state, k, lag[i], ready[i])
        flags = watch_windows(par, state, k, abs(actual[i] - target[i]))
        table[WINDOWS, i] = float(flags)
        if actual[i] < low[i] - par[MARGIN, k]:
            flags |= BELOW
        elif actual[i] > high[i] + par[MARGIN, k]:
            flags |= ABOVE
        fresh = flags & ~int(state[FLAGS, k]) & (BELOW | ABOVE)
        if fresh != 0 and axis_state[i] >= STOPPING and axis_state[i] != HOMING and speed[i] != 0.0:
            bits |= fresh
        state[FLAGS, k] = float(flags)
        bits |= watch_arrival(par, state, k, done[k] == 0 or flags & done[k] != 0)
        if bits != 0:
            events[count, 0] = k
            events[count, 1] = bits
            count += 1
    return count
