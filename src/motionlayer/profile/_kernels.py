"""The planner's kernels. Theory and equation numbers: the docstring of `motionlayer.profile`.

A plan under construction is an array `out` of pieces (time, p, v, a, jerk). `out[count]` always holds the state at
which the next piece begins; its jerk is not known yet. Direction s turns everything into "gain velocity".
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.profile._stop import stop_displacement
from motionlayer.profile._tolerances import TOLERANCES

Floats = NDArray[np.float64]

OUT_OF_REACH: Final = -9
"""Returned instead of a number of pieces: the moving target runs away."""

CLOCK: Final = TOLERANCES.clock
STEP: Final = 2.3e-16
"""More than one step of a clock, relative."""

COARSE: Final = 1e-11
"""Blur of the clock, relative to a phase, from which a stop after a cruise is planned on its steps."""

MAX_STEPS: Final = 120
"""Most steps of the bracketing. Bisection alone would need 64 for a float64; it usually takes 6 to 15."""


@kernel
def push(out: Floats, count: int, jerk: float, duration: float) -> int:
    """Close the open piece with this jerk and duration; one too short to move the clock is left out."""
    t, p, v, a = out[count, 0], out[count, 1], out[count, 2], out[count, 3]
    end = t + duration
    if not end > t:
        return count
    out[count, 4] = jerk
    out[count + 1, 0] = end
    out[count + 1, 1] = p + duration * (v + duration * (0.5 * a + duration * (jerk / 6.0)))
    out[count + 1, 2] = v + duration * (a + duration * (0.5 * jerk))
    out[count + 1, 3] = a + duration * jerk
    return count + 1


@kernel
def ramp(out: Floats, count: int, s: float, w_end: float, x: float, limit: float, jerk: float) -> int:
    """Go to velocity s·w_end with acceleration s·x: rise, hold, fall under an acceleration limit.

    Needs s·a >= 0 at the start. A start above the limit falls to it first.
    """
    w, b = s * out[count, 2], s * out[count, 3]
    top = max(limit, x)
    peak = top
    if b > top:
        count = push(out, count, -s * jerk, (b - top) / jerk)
        gained = (b * b - top * top) / (2.0 * jerk)
    else:
        square = jerk * (w_end - w) + 0.5 * (b * b + x * x)  # (2)
        if square < top * top:
            peak = max(math.sqrt(max(square, 0.0)), b, x)
        count = push(out, count, s * jerk, (peak - b) / jerk)
        gained = (peak * peak - b * b) / (2.0 * jerk)
    out[count, 3] = s * peak
    if peak == top:
        rest = (w_end - w) - gained - (peak * peak - x * x) / (2.0 * jerk)
        count = push(out, count, 0.0, rest / peak)
    count = push(out, count, -s * jerk, (peak - x) / jerk)
    out[count, 2] = s * w_end
    out[count, 3] = s * x
    return count


@kernel
def to_velocity(out: Floats, target: float, acc: float, dec: float, jerk: float) -> int:
    """Plan from the state in `out[0]` to a velocity with acceleration zero; return the number of pieces.

    The last piece is the endless motion at the target.
    """
    v, a = out[0, 2], out[0, 3]
    reached = v + 0.5 * a * abs(a) / jerk
    s = 1.0 if target > reached or (target == reached and a >= 0.0) else -1.0  # the tie too has its mirror image
    count = 0
    if s * a < 0.0:
        count = push(out, 0, s * jerk, abs(a) / jerk)
        out[count, 3] = 0.0
    w, b, w_end = s * out[count, 2], s * out[count, 3], s * target
    if w < 0.0 < w_end:
        # (1): the acceleration at v = 0 is bounded by both limits, by the start and by the target ...
        low = min(acc, dec)
        square = min(low * low, b * b - 2.0 * jerk * w, 2.0 * jerk * w_end)
        # ... and is never less than what a start outside the limits leaves.
        x = math.sqrt(max(square, b * b + 2.0 * jerk * w))
        count = ramp(out, count, s, 0.0, x, dec, jerk)
        count = ramp(out, count, s, w_end, 0.0, acc, jerk)
    else:
        count = ramp(out, count, s, w_end, 0.0, dec if w < 0.0 else acc, jerk)
    out[count, 4] = 0.0
    return count + 1


@kernel
def steady_displacement(scratch: Floats, v: float, a: float, u: float, acc: float, dec: float, jerk: float) -> float:
    """Return how far the fastest way from (v, a) to the velocity u gains on a point that moves at u all the time."""
    if u == 0.0:
        return stop_displacement(v, a, dec, jerk)
    scratch[0, 0] = 0.0
    scratch[0, 1] = 0.0
    scratch[0, 2] = v
    scratch[0, 3] = a
    last = to_velocity(scratch, u, acc, dec, jerk) - 1
    return float(scratch[last, 1] - u * scratch[last, 0])


@kernel
def meets_after(out: Floats, scratch: Floats, k: int, s: float, u: float, acc: float, dec: float, jerk: float) -> float:
    """Return the left side of (3), from the start of the plan, when its piece k is left after s seconds."""
    a, j = out[k, 3], out[k, 4]
    v = out[k, 2] + s * (a + s * (0.5 * j))
    p = out[k, 1] + s * (out[k, 2] + s * (0.5 * a + s * (j / 6.0)))
    return float(p - u * (out[k, 0] + s) + steady_displacement(scratch, v, a + s * j, u, acc, dec, jerk))


@kernel
def leave_at(
    out: Floats, scratch: Floats, k: int, duration: float, goal: float, u: float, acc: float, dec: float, jerk: float
) -> float:
    """Solve (3) for the time inside piece k by Chandrupatla's method.

    Between 0 and `duration` the left side passes `goal`. Inverse quadratic steps where they are safe, bisection
    elsewhere (Chandrupatla, Advances in Engineering Software 28, 1997).
    """
    x1, x2, x3 = duration, 0.0, 0.0
    f1 = meets_after(out, scratch, k, duration, u, acc, dec, jerk) - goal
    f2 = meets_after(out, scratch, k, 0.0, u, acc, dec, jerk) - goal
    if f1 == 0.0:
        return duration
    f3 = f2
    part = 0.5
    for _ in range(MAX_STEPS):
        x = x1 + part * (x2 - x1)
        f = meets_after(out, scratch, k, x, u, acc, dec, jerk) - goal
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
    return float(x1 if abs(f1) < abs(f2) else x2)


@kernel
def stop_on_clock(out: Floats, scratch: Floats, k: int, acc: float, dec: float, jerk: float) -> int:
    """Plan the stop from the cruise in `out[k]` in whole steps of a clock that has become coarse beside its phases.

    Every phase is stretched to the next steps, and acceleration and jerk lowered as much: it stays exact, and under
    its limits, at any time. It costs some 5e-16 of the time.
    """
    v, t = out[k, 2], out[k, 0]
    scratch[0, 0] = 0.0
    scratch[0, 1] = 0.0
    scratch[0, 2] = v
    scratch[0, 3] = 0.0
    last = to_velocity(scratch, 0.0, acc, dec, jerk) - 1
    if last < 2:  # a phase underflows: the end is missed, and the check says so
        out[k, 4] = 0.0
        return 1
    for i in range(last):
        t += (scratch[i + 1, 0] - scratch[i, 0]) + STEP * t
        out[k + i + 1, 0] = t
    rise = out[k + 1, 0] - out[k, 0]
    fall = out[k + last, 0] - out[k + last - 1, 0]
    peak = -v / (out[k + last, 0] - out[k, 0] - 0.5 * (rise + fall))
    out[k, 4] = min(max(peak / rise, -jerk), jerk)  # rounding
    for i in range(1, last):  # a hold, if there is one, and the fall
        duration = out[k + i, 0] - out[k + i - 1, 0]
        a, j = out[k + i - 1, 3], out[k + i - 1, 4]
        out[k + i, 1] = out[k + i - 1, 1] + duration * (out[k + i - 1, 2] + duration * (0.5 * a + duration * (j / 6.0)))
        out[k + i, 2] = out[k + i - 1, 2] + duration * (a + 0.5 * duration * j)
        out[k + i, 3] = peak
        out[k + i, 4] = 0.0
    out[k + last - 1, 4] = min(max(-peak / fall, -jerk), jerk)
    for field in range(2, 5):
        out[k + last, field] = 0.0
    return last + 1


@kernel
def to_meet(
    out: Floats, scratch: Floats, s: float, goal: float, u: float, cruise: float, acc: float, dec: float, jerk: float
) -> int:
    """Plan from the state in `out[0]` (with p = 0) by way of the velocity `cruise` to the motion goal + u·t.

    Direction s tells on which side of `steady_displacement` the goal lies; s·cruise >= s·u. Returns the number of
    pieces, or OUT_OF_REACH where the cruise does not come nearer.
    """
    last = to_velocity(out, cruise, acc, dec, jerk) - 1
    nearer = cruise - u
    duration = 0.0
    k = 0
    while k < last:
        duration = out[k + 1, 0] - out[k, 0]
        if s * (meets_after(out, scratch, k, duration, u, acc, dec, jerk) - goal) >= 0.0:
            break
        k += 1
    if k < last:
        time = leave_at(out, scratch, k, duration, goal, u, acc, dec, jerk)
    elif s * nearer > 0.0:  # left in the cruise, where (3) is linear
        time = (goal - meets_after(out, scratch, last, 0.0, u, acc, dec, jerk)) / nearer
    else:
        return OUT_OF_REACH
    cruised = k == last
    k = push(out, k, out[k, 4], time)
    if cruised and u == 0.0 and CLOCK * out[k, 0] > COARSE * min(math.sqrt(abs(cruise) / jerk), dec / jerk):
        count = k + stop_on_clock(out, scratch, k, acc, dec, jerk)
    else:
        out_tail = out[k:]
        count = k + to_velocity(out_tail, u, acc, dec, jerk)
    out[count - 1, 1] = goal + u * out[count - 1, 0]
    return count


@kernel
def to_rest(out: Floats, scratch: Floats, goal: float, vel: float, acc: float, dec: float, jerk: float) -> int:
    """Plan from the state in `out[0]` (with p = 0) to rest at displacement `goal`; return the number of pieces."""
    rest = stop_displacement(out[0, 2], out[0, 3], dec, jerk)
    if goal == rest:
        return to_velocity(out, 0.0, acc, dec, jerk)
    s = 1.0 if goal > rest else -1.0
    return to_meet(out, scratch, s, goal, 0.0, s * vel, acc, dec, jerk)


@kernel
def extent(out: Floats, count: int) -> tuple[float, float]:
    """Return the least and the greatest position of a plan that ends at rest."""
    low = out[count - 1, 1]
    high = low
    for k in range(count - 1):
        p, v, a, j = out[k, 1], out[k, 2], out[k, 3], out[k, 4]
        low, high = min(low, p), max(high, p)
        duration = out[k + 1, 0] - out[k, 0]
        # v(s) = v + a s + j s²/2 = 0, as 2v / (-a ± root), which divides by nothing small of its own making
        under = a * a - 2.0 * j * v
        if under >= 0.0:
            root = math.sqrt(under)
            for below in (-a - root, -a + root):
                if below != 0.0:
                    s = 2.0 * v / below
                    if 0.0 < s < duration:
                        turn = p + s * (v + s * (0.5 * a + s * (j / 6.0)))
                        low, high = min(low, turn), max(high, turn)
    return low, high
