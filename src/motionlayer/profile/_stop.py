"""Where the fastest stop ends, in closed form: for planning, followers, couplings and override.

In the direction s in which velocity has to be gained, w = s·v and b = s·a. An acceleration b < 0 is first brought to
zero. What remains is one ramp from (w <= 0, b) to (0, 0) under the deceleration limit D, (2) of the package: a rise
to the peak, a hold, a fall. The acceleration limit plays no part: a stop gains velocity only where |v| falls.
"""

import math

from motionlayer._kernel import kernel


@kernel
def stop_displacement(v: float, a: float, dec: float, jerk: float) -> float:
    """Return S(v, a): how far the fastest stop from (v, a) still travels, with its sign."""
    reached = v + 0.5 * a * abs(a) / jerk
    s = 1.0 if reached < 0.0 or (reached == 0.0 and a >= 0.0) else -1.0
    w, b = s * v, s * a
    way = 0.0
    if b < 0.0:
        t = -b / jerk
        way = t * (w + t * b / 3.0)
        w = s * reached
        b = 0.0
    if b > dec:
        peak = dec
        t = (b - peak) / jerk
        way += t * (w + t * (0.5 * b - t * (jerk / 6.0)))
    else:
        peak = max(min(math.sqrt(max(0.5 * b * b - jerk * w, 0.0)), dec), b)
        t = (peak - b) / jerk
        way += t * (w + t * (0.5 * b + t * (jerk / 6.0)))
    fall = peak / jerk
    last = -0.5 * peak * fall  # the velocity at which the fall begins
    if peak == dec:
        first = w + 0.5 * t * (b + peak)
        hold = max(last - first, 0.0) / peak
        way += 0.5 * hold * (first + last)
    return float(s * (way + last * fall / 3.0))


@kernel
def stop_position(p: float, v: float, a: float, dec: float, jerk: float) -> float:
    """Return where the fastest stop from (p, v, a) comes to rest."""
    return p + stop_displacement(v, a, dec, jerk)
