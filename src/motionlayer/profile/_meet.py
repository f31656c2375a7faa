"""Kernels that meet a point: equation (4) of `motionlayer.profile`, solved.

The point is at `goal` at time 0 and moves at w for ever; it is met with the velocity u and acceleration 0. Three
questions are this one: rest at a position is w = u = 0, synchronising is w = u, passing a position is w = 0.
"""

import math
from typing import Final

from motionlayer._kernel import kernel
from motionlayer.profile._clock import is_coarse, ramp_on_clock
from motionlayer.profile._kernels import Floats, begin, extent, push, to_velocity
from motionlayer.profile._stop import stop_displacement

OUT_OF_REACH: Final = -9
"""Returned instead of a number of pieces: the moving target runs away."""

MAX_STEPS: Final = 120
"""Most steps of the bracketing. Bisection alone would need 64 for a float64; it usually takes 6 to 15."""

ROUNDING: Final = 1e-15
"""Miss of the goal, relative to it or to the way until rest, that the fastest way may have. Making up for it would take
pieces whose times are as short as the square root of rounding."""

SHORT: Final = 1e-11
"""What a plan may be off the goal before it makes up for it, as a share of its extent: a tenth of what a joint may
miss."""

GOLDEN: Final = 0.6180339887498949
VALLEY: Final = 1e-8
"""Width, relative, at which the search of a valley ends: a float64 shows no smaller one."""

HALVINGS: Final = 1100
"""Most halvings of a bracket: a float64 between 0 and its largest value needs 1075."""


@kernel
def gain(scratch: Floats, v: float, a: float, w: float, u: float, acc: float, dec: float, jerk: float) -> float:
    """Return how far the fastest way from (v, a) to the velocity u gains on a point that moves at w."""
    if w == 0.0 and u == 0.0:
        return stop_displacement(v, a, dec, jerk)
    begin(scratch, v, a)
    last = to_velocity(scratch, u, acc, dec, jerk) - 1
    return float(scratch[last, 1] - w * scratch[last, 0])


@kernel
def left_after(
    out: Floats, scratch: Floats, k: int, s: float, w: float, u: float, acc: float, dec: float, jerk: float
) -> float:
    """Return the left side of (4), from the start of the plan, when its piece k is left after s seconds."""
    a, j = out[k, 3], out[k, 4]
    v = out[k, 2] + s * (a + s * (0.5 * j))
    p = out[k, 1] + s * (out[k, 2] + s * (0.5 * a + s * (j / 6.0)))
    return float(p - w * (out[k, 0] + s) + gain(scratch, v, a + s * j, w, u, acc, dec, jerk))


@kernel
def leave_at(
    out: Floats, scratch: Floats, k: int, duration: float, goal: float, w: float, u: float,
    acc: float, dec: float, jerk: float,
) -> float:  # fmt: skip
    """Solve (4) for the time inside piece k by Chandrupatla's method.

    Between 0 and `duration` the left side passes `goal`. Inverse quadratic steps where they are safe, bisection
    elsewhere (Chandrupatla, Advances in Engineering Software 28, 1997). Of two neighbouring times the better one is the
    answer; where the plan goes on at u from its end, the one that ends short of the goal (see `completed`).
    """
    x1, x2, x3 = duration, 0.0, 0.0
    f1 = left_after(out, scratch, k, duration, w, u, acc, dec, jerk) - goal
    f2 = left_after(out, scratch, k, 0.0, w, u, acc, dec, jerk) - goal
    if f1 == 0.0:
        return duration
    f3 = f2
    part = 0.5
    for _ in range(MAX_STEPS):
        x = x1 + part * (x2 - x1)
        f = left_after(out, scratch, k, x, w, u, acc, dec, jerk) - goal
        if (f > 0.0) == (f1 > 0.0):
            x3, f3 = x1, f1
        else:
            x3, f3 = x2, f2
            x2, f2 = x1, f1
        x1, f1 = x, f
        width = abs(x2 - x1)
        if f1 == 0.0 or width <= 4.5e-16 * max(abs(x1), abs(x2)):
            break
        xi = (x1 - x2) / (x3 - x2)
        part = 0.5
        if f3 == f2:
            continue
        phi = (f1 - f2) / (f3 - f2)
        if f3 != f1 and phi * phi < xi and (1.0 - phi) * (1.0 - phi) < 1.0 - xi:
            part = (f1 / (f2 - f1)) * (f3 / (f2 - f3)) + ((x3 - x1) / (x2 - x1)) * (f1 / (f3 - f1)) * (f2 / (f3 - f2))
            least = min(2.2e-16 * abs(x1) / width, 0.5)
            part = min(max(part, least), 1.0 - least)
    if w == 0.0 and u != 0.0 and f1 != 0.0:
        return float(x1 if f1 * u < 0.0 else x2)
    return float(x1 if abs(f1) < abs(f2) else x2)


@kernel
def valley(
    out: Floats, scratch: Floats, s: float, goal: float, w: float, u: float, acc: float, dec: float, jerk: float
) -> float:
    """Return a time inside piece 0 at which the left side of (4) has come by the goal in direction s; 0 without one.

    Who comes from the wrong side towards u, and is to back off, may do so by gaining velocity a little later: the left
    side has a valley while the acceleration is brought to zero, and the piece ends behind it. By golden section.
    """
    low, high = 0.0, out[1, 0]
    one, two = high - GOLDEN * high, GOLDEN * high
    f1 = s * (left_after(out, scratch, 0, one, w, u, acc, dec, jerk) - goal)
    f2 = s * (left_after(out, scratch, 0, two, w, u, acc, dec, jerk) - goal)
    while max(f1, f2) < 0.0:
        if not high - low > VALLEY * high:
            return 0.0
        if f1 > f2:
            high, two, f2 = two, one, f1
            one = high - GOLDEN * (high - low)
            f1 = s * (left_after(out, scratch, 0, one, w, u, acc, dec, jerk) - goal)
        else:
            low, one, f1 = one, two, f2
            two = low + GOLDEN * (high - low)
            f2 = s * (left_after(out, scratch, 0, two, w, u, acc, dec, jerk) - goal)
    return float(one if f1 >= 0.0 else two)


@kernel
def completed(out: Floats, count: int, goal: float, u: float) -> int:
    """Let a plan ride on at u for what it is short of the goal.

    Near a velocity u that is hardly another than its own, the axis is for a moment only on its way to u. The rounding
    of a velocity is a large share of that moment then, and no time of leaving makes up for it.
    """
    short = goal - out[count - 1, 1]
    if not short * u > 0.0 or abs(short) <= SHORT * abs(goal):
        return count
    low, high = extent(out, count)  # who comes back to where it began has gone farther than to the goal
    if abs(short) <= SHORT * (high - low):
        return count
    count = push(out, count - 1, 0.0, short / u)
    out[count, 4] = 0.0
    return count + 1


@kernel
def direct_way(out: Floats, goal: float, way: float, w: float, u: float, acc: float, dec: float, jerk: float) -> int:
    """Take the fastest way from the state in `out[0]` to u if it ends at the goal; 0 where it does not.

    Args:
        out: gets the pieces.
        goal: where the point is at time 0.
        way: what the fastest way gains on it.
        w: velocity of the point.
        u: velocity at the end.
        acc: acceleration limit.
        dec: deceleration limit.
        jerk: jerk limit.
    """
    v, a = out[0, 2], out[0, 3]
    size = max(abs(goal), abs(stop_displacement(v, a, dec, jerk)))  # who turns may come back to where it began
    if not (goal == way or abs(goal - way) < ROUNDING * size):  # a NaN is at no goal
        return 0
    count = to_velocity(out, u, acc, dec, jerk)
    low, high = extent(out, count)
    if u == 0.0 or abs(goal - way) <= SHORT * (high - low):
        return count
    if w == 0.0 and (goal - way) * u > 0.0:
        return completed(out, count, goal, u)
    begin(out, v, a)
    return 0


@kernel
def by_way_of(
    out: Floats, scratch: Floats, s: float, cruise: float, goal: float, w: float, u: float,
    acc: float, dec: float, jerk: float,
) -> int:  # fmt: skip
    """Plan from the state in `out[0]` (with p = 0) by way of the velocity `cruise` to the point; see the module.

    Direction s tells on which side of `gain` the goal lies; s·cruise >= s·w. Returns the number of pieces, or
    OUT_OF_REACH where the cruise does not come nearer.
    """
    last = to_velocity(out, cruise, acc, dec, jerk) - 1
    nearer = cruise - w
    early = 0.0
    if w != u and s * u < 0.0 < s * out[0, 2] and s * out[0, 3] < 0.0 < last:
        early = valley(out, scratch, s, goal, w, u, acc, dec, jerk)
    duration = 0.0
    k = 0
    while k < last:
        duration = early if early > 0.0 else out[k + 1, 0] - out[k, 0]
        if s * (left_after(out, scratch, k, duration, w, u, acc, dec, jerk) - goal) >= 0.0:
            break
        k += 1
    if k < last:
        time = leave_at(out, scratch, k, duration, goal, w, u, acc, dec, jerk)
    elif s * nearer > 0.0:  # left in the cruise, where (4) is linear
        time = (goal - left_after(out, scratch, last, 0.0, w, u, acc, dec, jerk)) / nearer
    else:
        return OUT_OF_REACH
    cruised = k == last
    k = push(out, k, out[k, 4], time)
    if cruised and is_coarse(out[k, 0], cruise, u, acc, dec, jerk):
        return k + ramp_on_clock(out, scratch, k, u, acc, dec, jerk)
    out_tail = out[k:]
    count = k + to_velocity(out_tail, u, acc, dec, jerk)
    return completed(out, count, goal, u) if w == 0.0 and u != 0.0 else count


@kernel
def to_point(
    out: Floats, scratch: Floats, goal: float, w: float, u: float, time: float,
    v: float, a: float, vel: float, acc: float, dec: float, jerk: float,
) -> int:  # fmt: skip
    """Plan from (0, v, a) to the point, there as late as possible but not after `time`; infinite: as early as possible.

    A finite time is for w = u. The slower the velocity by way of which, the later: as it nears u, the time grows beyond
    all bounds. It is bisected down to neighbouring floats; the earlier of the two is taken.
    """
    begin(out, v, a)
    direct = gain(scratch, v, a, w, u, acc, dec, jerk)
    count = direct_way(out, goal, direct, w, u, acc, dec, jerk)
    if count > 0:
        return count
    s = 1.0 if goal > direct else -1.0
    fast, slow = s * vel, u
    count = by_way_of(out, scratch, s, fast, goal, w, u, acc, dec, jerk)
    if count < 0 or time == math.inf or out[count - 1, 0] > time:
        return count
    for _ in range(HALVINGS):
        middle = slow + 0.5 * (fast - slow)
        if middle in (slow, fast):
            break
        begin(out, v, a)
        count = by_way_of(out, scratch, s, middle, goal, w, u, acc, dec, jerk)
        if count > 0 and out[count - 1, 0] <= time:
            fast = middle
        else:
            slow = middle
    begin(out, v, a)
    return by_way_of(out, scratch, s, fast, goal, w, u, acc, dec, jerk)
