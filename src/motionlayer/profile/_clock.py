"""What the clock of a profile no longer resolves after a long cruise: a ramp in whole steps of it (decision 10)."""

import math
from typing import Final

from motionlayer._kernel import kernel
from motionlayer.profile._kernels import Floats, begin, to_velocity
from motionlayer.profile._tolerances import TOLERANCES

CLOCK: Final = TOLERANCES.clock
STEP: Final = 2.3e-16
"""More than one step of a clock, relative."""

COARSE: Final = 1e-11
"""Blur of the clock, relative to a phase, from which a ramp after a cruise is planned on its steps."""


@kernel
def is_coarse(time: float, v: float, u: float, acc: float, dec: float, jerk: float) -> bool:
    """Tell whether the clock resolves too little of a ramp from cruising at v to u, and the ramp is one alone."""
    if v < 0.0 < u or u < 0.0 < v:
        return False
    limit = dec if abs(u) < abs(v) else acc
    return bool(CLOCK * time > COARSE * min(math.sqrt(abs(v - u) / jerk), limit / jerk))


@kernel
def ramp_on_clock(out: Floats, scratch: Floats, k: int, u: float, acc: float, dec: float, jerk: float) -> int:
    """Plan from the cruise in `out[k]` to u in whole steps of a clock that has become coarse beside its phases.

    Every phase is stretched to the next steps, and acceleration and jerk lowered as much: it stays exact, and under
    its limits, at any time. It costs some 5e-16 of the time.
    """
    v, t = out[k, 2], out[k, 0]
    begin(scratch, v, 0.0)
    last = to_velocity(scratch, u, acc, dec, jerk) - 1
    if last < 2:  # nothing to do; or a phase underflows: the end is missed, and the check says so
        out[k, 4] = 0.0
        return 1
    for i in range(last):
        t += (scratch[i + 1, 0] - scratch[i, 0]) + STEP * t
        out[k + i + 1, 0] = t
    rise = out[k + 1, 0] - out[k, 0]
    fall = out[k + last, 0] - out[k + last - 1, 0]
    peak = (u - v) / (out[k + last, 0] - out[k, 0] - 0.5 * (rise + fall))
    out[k, 4] = min(max(peak / rise, -jerk), jerk)  # rounding
    for i in range(1, last):  # a hold, if there is one, and the fall
        duration = out[k + i, 0] - out[k + i - 1, 0]
        a, j = out[k + i - 1, 3], out[k + i - 1, 4]
        out[k + i, 1] = out[k + i - 1, 1] + duration * (out[k + i - 1, 2] + duration * (0.5 * a + duration * (j / 6.0)))
        out[k + i, 2] = out[k + i - 1, 2] + duration * (a + 0.5 * duration * j)
        out[k + i, 3] = peak
        out[k + i, 4] = 0.0
    out[k + last - 1, 4] = min(max(-peak / fall, -jerk), jerk)
    out[k + last, 2] = u
    out[k + last, 3] = 0.0
    out[k + last, 4] = 0.0
    return last + 1
