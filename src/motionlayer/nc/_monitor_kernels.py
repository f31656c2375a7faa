"""The monitors of all axes in one pass; the rules are those of function-blocks 3.7."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.nc._axis_ref import StateDWord
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
SHIFT: Final = Q.SHIFT
JOB_FLAGS: Final = Q.FLAGS
WINDOWS: Final = Q.WINDOWS

HAS_JOB: Final = int(StateDWord.HasJob)

# Rows of the parameters: limits in u, times in ticks; infinite where a monitor is off.
LAG_LIMIT: Final = 0
LAG_TICKS: Final = 1
RANGE_WINDOW: Final = 2
TARGET_WINDOW: Final = 3
TARGET_TICKS: Final = 4
ALARM_TICKS: Final = 5
MARGIN: Final = 6
RATE_LIMIT: Final = 7
"""Largest velocity lag, as the change of the lag in a cycle."""
RATE_TICKS: Final = 8
MOTION_WINDOW: Final = 9
"""Way in a cycle that counts as motion."""
MOTION_TICKS: Final = 10
PARAMETERS: Final = 11

# Rows of the states.
LAGGING: Final = 0
"""Ticks for which the lag has been above its limit."""
INSIDE: Final = 1
"""Ticks for which the actual position has been inside the target window."""
WAITING: Final = 2
"""Ticks since the setpoint arrived, if somebody waits for the window; else -1."""
FLAGS: Final = 3
"""Bits `IN_RANGE`, `IN_TARGET`, `BELOW`, `ABOVE`."""
LAST_LAG: Final = 4
"""Position lag of the tick before."""
RATE: Final = 5
"""What it has changed by since."""
RUSHING: Final = 6
"""Ticks for which the velocity lag has been above its limit."""
LAST_P: Final = 7
"""Drive position of the tick before."""
STILL: Final = 8
"""Ticks for which the axis has not moved though it should."""
STATES: Final = 9

# Bits of flags, and of what happened.
IN_RANGE: Final = 1
IN_TARGET: Final = 2
BELOW: Final = 4
ABOVE: Final = 8
LAG_ERROR: Final = 16
ALARM: Final = 32
ARRIVED: Final = 64
RATE_ERROR: Final = 128
MOTION_ERROR: Final = 256

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
def watch_rate(par: Floats, state: Floats, k: int, lag: float, ready: float) -> int:
    """Return RATE_ERROR in the tick in which the velocity lag has been above its limit for longer than the filter time.

    The velocity lag is the change of the position lag: set velocity, a dead time ago, less actual velocity, both as
    means over the cycle. So it is exactly 0 where the position lag is.
    """
    rate = lag - state[LAST_LAG, k]
    state[LAST_LAG, k] = lag
    state[RATE, k] = rate
    if ready == 0.0 or not abs(rate) > par[RATE_LIMIT, k]:
        state[RUSHING, k] = 0.0
        return 0
    state[RUSHING, k] += 1.0
    return RATE_ERROR if state[RUSHING, k] == par[RATE_TICKS, k] + 1.0 else 0


@kernel
def watch_motion(par: Floats, state: Floats, k: int, place: float, wanted: bool) -> int:
    """Return MOTION_ERROR where the drive position has not moved for the time of the monitor, though it should."""
    way = abs(place - state[LAST_P, k])
    state[LAST_P, k] = place
    if not wanted or way > par[MOTION_WINDOW, k]:
        state[STILL, k] = 0.0
        return 0
    state[STILL, k] += 1.0
    return MOTION_ERROR if state[STILL, k] == par[MOTION_TICKS, k] else 0


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
def beyond(par: Floats, k: int, actual: float, low: float, high: float) -> int:
    """Return BELOW or ABOVE where the actual position is outside the software limits by more than the margin."""
    if actual < low - par[MARGIN, k]:
        return BELOW
    return ABOVE if actual > high + par[MARGIN, k] else 0


@kernel
def look(table: Floats, columns: Integers, par: Floats, state: Floats, done: Integers, events: Integers) -> int:
    """Look at all monitored axes; write index and bits of those to which something happened, return their number."""
    actual, target, lag, ready = table[ACTUAL_P], table[TARGET], table[LAG], table[READY]
    axis_state, speed, low, high = table[STATE], table[SET_V], table[MIN_P], table[MAX_P]
    shift, jobs = table[SHIFT], table[JOB_FLAGS]
    count = 0
    for k in range(columns.shape[0]):
        i = columns[k]
        wanted = speed[i] != 0.0 and ready[i] != 0.0 and int(jobs[i]) & HAS_JOB != 0
        bits = watch_lag(par, state, k, lag[i], ready[i]) | watch_rate(par, state, k, lag[i], ready[i])
        bits |= watch_motion(par, state, k, actual[i] - shift[i], wanted)
        flags = watch_windows(par, state, k, abs(actual[i] - target[i]))
        table[WINDOWS, i] = float(flags)
        flags |= beyond(par, k, actual[i], low[i], high[i])
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
