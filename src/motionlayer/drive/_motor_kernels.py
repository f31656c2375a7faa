"""Motors, loads and encoders of all servo drives over one cycle; the theory is in `_servo`."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.drive._layout import Par, State
from motionlayer.drive._noise import noise
from motionlayer.store import Status

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

ENCODER_ERROR: Final = Status.ENCODER_ERROR

GAIN: Final = Par.GAIN
FORWARD: Final = Par.FORWARD
RISE: Final = Par.RISE
GLIDE: Final = Par.GLIDE
MOST: Final = Par.MOST
BRAKE: Final = Par.BRAKE
PLAY: Final = Par.PLAY
STEP: Final = Par.STEP
NOISE: Final = Par.NOISE
LEAP: Final = Par.LEAP

X: Final = State.X
V: Final = State.V
LOAD: Final = State.LOAD
OFFSET: Final = State.OFFSET
REPORTED: Final = State.REPORTED
POWER: Final = State.POWER
ERRORS: Final = State.ERRORS
BLOCKED_UNTIL: Final = State.BLOCKED_UNTIL
DELAYED_P: Final = State.DELAYED_P
DELAYED_V: Final = State.DELAYED_V


@kernel
def move(par: Floats, state: Floats, tick: int, dt: float) -> None:
    """Move all motors and loads over the cycle that ends at `tick`; with power they follow, without they brake."""
    gain, forward, rise, glide = par[GAIN], par[FORWARD], par[RISE], par[GLIDE]
    most, deceleration, play = par[MOST], par[BRAKE], par[PLAY]
    xs, vs, loads, set_p, set_v = state[X], state[V], state[LOAD], state[DELAYED_P], state[DELAYED_V]
    offset, power, until = state[OFFSET], state[POWER], state[BLOCKED_UNTIL]
    for k in range(xs.shape[0]):
        x, v = xs[k], vs[k]
        if power[k] != 0.0:
            wanted = gain[k] * (set_p[k] - x - offset[k]) + forward[k] * set_v[k]
            change = (wanted - v) * rise[k]
            way = wanted * dt + (v - wanted) * glide[k]
            limit = most[k]
        else:
            change = -v
            way = 0.5 * v * abs(v) / deceleration[k]  # to rest inside the cycle
            limit = deceleration[k] * dt
        if abs(change) > limit:
            change = limit if change > 0.0 else -limit
            way = (v + 0.5 * change) * dt
        if tick < until[k]:
            change, way = -v, 0.0
        x += way
        xs[k] = x
        vs[k] = v + change
        load, slack = loads[k], play[k]
        if load < x - slack:
            load = x - slack
        elif load > x + slack:
            load = x + slack
        loads[k] = load


@kernel
def measure(par: Floats, state: Floats, keys: Integers, tick: int) -> None:
    """Read all encoders; one that leaps is in error."""
    sigma, step, leap, key, other = par[NOISE], par[STEP], par[LEAP], keys[0], keys[1]
    loads, offset, reported, errors = state[LOAD], state[OFFSET], state[REPORTED], state[ERRORS]
    for k in range(loads.shape[0]):
        shown = loads[k] + offset[k]
        if sigma[k] != 0.0:
            shown += sigma[k] * noise(key[k], other[k], tick)
        if step[k] != 0.0:
            shown = np.floor(shown / step[k] + 0.5) * step[k]
        if abs(shown - reported[k]) > leap[k]:
            errors[k] = float(int(errors[k]) | ENCODER_ERROR)
        reported[k] = shown
