"""One cycle of all servo drives of a machine; the theory is in `_servo`.

Each pass goes over all drives and touches few rows, which is what the processor's prefetcher likes; status, power and
communication are looked at in the rare drive that has something to decide.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.drive._layout import Par, State
from motionlayer.drive._motor_kernels import measure, move
from motionlayer.drive._switch import changed_at, is_on
from motionlayer.store import Q, Status

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# Kernels see plain integers.
SET_P: Final = Q.SET_P
SET_V: Final = Q.SET_V
ACTUAL_P: Final = Q.ACTUAL_P
SHIFT: Final = Q.SHIFT
ENABLE: Final = Q.ENABLE
READY: Final = Q.READY
HOME_INPUT: Final = Q.HOME_INPUT
HOME_LATCH: Final = Q.HOME_LATCH
LAG: Final = Q.LAG
STATUS: Final = Q.STATUS
DRIVE_RESET: Final = Q.DRIVE_RESET

INVALID: Final = Status.INVALID
LOST: Final = Status.LOST

EDGE: Final = Par.EDGE
SIDE: Final = Par.SIDE
PREPARE: Final = Par.PREPARE
PATIENCE: Final = Par.PATIENCE
WIDTH: Final = Par.WIDTH

V: Final = State.V
REPORTED: Final = State.REPORTED
POWER: Final = State.POWER
ASKED: Final = State.ASKED
WAITED: Final = State.WAITED
SILENT: Final = State.SILENT
ERRORS: Final = State.ERRORS
FAILS_UNTIL: Final = State.FAILS_UNTIL
DISABLED_UNTIL: Final = State.DISABLED_UNTIL
SILENT_UNTIL: Final = State.SILENT_UNTIL
DELAYED_P: Final = State.DELAYED_P
DELAYED_V: Final = State.DELAYED_V


@kernel
def listen(par: Floats, state: Floats, table: Floats, k: int, i: int, tick: int) -> bool:
    """Take over what the control asks of a drive; tell whether there is communication."""
    if tick < state[SILENT_UNTIL, k]:
        state[SILENT, k] += 1.0
        if state[SILENT, k] > par[PATIENCE, k]:
            state[ERRORS, k] = float(int(state[ERRORS, k]) | LOST)
        return False
    state[SILENT, k] = 0.0
    state[ASKED, k] = table[ENABLE, i]
    if table[DRIVE_RESET, i] != 0.0 and tick >= state[FAILS_UNTIL, k]:
        table[DRIVE_RESET, i] = 0.0
        state[ERRORS, k] = 0.0
    return True


@kernel
def switch_power(par: Floats, state: Floats, k: int, tick: int) -> bool:
    """Decide on the power of a drive; tell whether it comes on now. It waits until the motor rests."""
    if state[ASKED, k] == 0.0 or state[ERRORS, k] != 0.0 or tick < state[DISABLED_UNTIL, k]:
        state[POWER, k] = 0.0
        state[WAITED, k] = 0.0
    elif state[POWER, k] == 0.0 and state[V, k] == 0.0:
        state[WAITED, k] += 1.0
        if state[WAITED, k] > par[PREPARE, k]:
            state[POWER, k] = 1.0
            return True
    return False


@kernel
def attend(
    par: Floats, state: Floats, table: Floats, ring_p: Floats, ring_v: Floats, k: int, i: int, tick: int, dt: float
) -> bool:
    """Look at communication, errors and power of one drive; tell whether the control sees a change."""
    slots = ring_p.shape[0]
    now, last = tick % slots, (tick - 1) % slots
    heard = listen(par, state, table, k, i, tick)
    if not heard:
        ring_p[now, k] = ring_p[last, k] + dt * ring_v[last, k]
        ring_v[now, k] = ring_v[last, k]
    if switch_power(par, state, k, tick):
        for slot in range(slots):  # the control adopts this position in the same tick
            ring_p[slot, k] = state[REPORTED, k]
            ring_v[slot, k] = 0.0
    errors = int(state[ERRORS, k])
    status = float(errors if heard else errors & LOST | INVALID)
    changed = bool(status != table[STATUS, i])
    table[STATUS, i] = status
    if heard and table[READY, i] != state[POWER, k]:
        table[READY, i] = state[POWER, k]
        changed = True
    return changed


@kernel
def exchange(
    table: Floats,
    columns: Integers,
    par: Floats,
    state: Floats,
    ring_p: Floats,
    ring_v: Floats,
    tick: int,
    dt: float,
    wanting: Integers,
    changed: Integers,
) -> int:
    """Take setpoints in, decide on power, write what the control sees; see `cycle`."""
    now = tick % ring_p.shape[0]
    new_p, new_v = ring_p[now], ring_v[now]
    set_p, set_v, shift, enable, ready = table[SET_P], table[SET_V], table[SHIFT], table[ENABLE], table[READY]
    reset, status = table[DRIVE_RESET], table[STATUS]
    power, errors = state[POWER], state[ERRORS]
    open_until, silent_until = state[DISABLED_UNTIL], state[SILENT_UNTIL]
    for k in range(columns.shape[0]):
        i = columns[k]
        new_p[k] = set_p[i] - shift[i]
        new_v[k] = set_v[i]
        quiet = enable[i] == power[k] and ready[i] == power[k] and errors[k] == 0.0 and status[i] == 0.0
        wanting[k] = not (quiet and reset[i] == 0.0 and tick >= open_until[k] and tick >= silent_until[k])
    count = 0
    for k in range(columns.shape[0]):
        if wanting[k] != 0 and attend(par, state, table, ring_p, ring_v, k, columns[k], tick, dt):
            changed[count] = columns[k]
            count += 1
    return count


@kernel
def delay(state: Floats, delays: Integers, ring_p: Floats, ring_v: Floats, tick: int) -> None:
    """Fetch the setpoints that have come through the dead times."""
    slots = ring_p.shape[0]
    now = tick % slots
    delayed_p, delayed_v = state[DELAYED_P], state[DELAYED_V]
    for k in range(delays.shape[0]):
        slot = now - delays[k]
        slot = slot + slots if slot < 0 else slot
        delayed_p[k] = ring_p[slot, k]
        delayed_v[k] = ring_v[slot, k]


@kernel
def report(table: Floats, columns: Integers, par: Floats, state: Floats, changed: Integers, count: int) -> int:
    """Write positions, lags and switches, stale without communication; return how many columns changed."""
    actual, lag, shift, status = table[ACTUAL_P], table[LAG], table[SHIFT], table[STATUS]
    reported, delayed, edge, side, width = state[REPORTED], state[DELAYED_P], par[EDGE], par[SIDE], par[WIDTH]
    home_input = table[HOME_INPUT]
    for k in range(columns.shape[0]):
        i = columns[k]
        if int(status[i]) & INVALID != 0:
            continue
        actual[i] = reported[k] + shift[i]
        lag[i] = delayed[k] - reported[k]
        d = side[k] * (reported[k] - edge[k])
        on = is_on(d, width[k])
        if on != home_input[i]:
            home_input[i] = on
            table[HOME_LATCH, i] = edge[k] + side[k] * changed_at(d, width[k], side[k] * state[V, k])
            changed[count] = i
            count += 1
    return count


@kernel
def cycle(
    table: Floats,
    columns: Integers,
    par: Floats,
    state: Floats,
    delays: Integers,
    keys: Integers,
    ring_p: Floats,
    ring_v: Floats,
    tick: int,
    dt: float,
    wanting: Integers,
    changed: Integers,
) -> int:
    """Take all drives from tick - 1 to `tick`; write the columns that changed, some of them twice; return how many.

    The rings hold the setpoints of the last ticks, in drive positions, at slot tick modulo their length.
    """
    move(par, state, tick, dt)
    measure(par, state, keys, tick)
    count = exchange(table, columns, par, state, ring_p, ring_v, tick, dt, wanting, changed)
    delay(state, delays, ring_p, ring_v, tick)
    return report(table, columns, par, state, changed, count)
