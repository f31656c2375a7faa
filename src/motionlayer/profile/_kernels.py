"""The planner's kernels. Theory and equation numbers: the docstring of `motionlayer.profile`.

A plan under construction is an array `out` of pieces (time, p, v, a, jerk). `out[count]` always holds the state at
which the next piece begins; its jerk is not known yet. Direction s turns everything into "gain velocity".
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel

Floats = NDArray[np.float64]

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
def stop_displacement(scratch: Floats, v: float, a: float, acc: float, dec: float, jerk: float) -> float:
    """Return S(v, a): how far the fastest stop still travels, with its sign."""
    scratch[0, 0] = 0.0
    scratch[0, 1] = 0.0
    scratch[0, 2] = v
    scratch[0, 3] = a
    count = to_velocity(scratch, 0.0, acc, dec, jerk)
    return float(scratch[count - 1, 1])


@kernel
def rest_after(out: Floats, scratch: Floats, k: int, s: float, acc: float, dec: float, jerk: float) -> float:
    """Return the left side of (3), from the start of the plan, when its piece k is left after s seconds."""
    a, j = out[k, 3], out[k, 4]
    v = out[k, 2] + s * (a + s * (0.5 * j))
    p = out[k, 1] + s * (out[k, 2] + s * (0.5 * a + s * (j / 6.0)))
    return float(p + stop_displacement(scratch, v, a + s * j, acc, dec, jerk))


@kernel
def leave_at(
    out: Floats, scratch: Floats, k: int, duration: float, goal: float, acc: float, dec: float, jerk: float
) -> float:
    """Solve (3) for the time inside piece k by Chandrupatla's method.

    Between 0 and `duration` the left side passes `goal`. Inverse quadratic steps where they are safe, bisection
    elsewhere (Chandrupatla, Advances in Engineering Software 28, 1997).
    """
    x1, x2, x3 = duration, 0.0, 0.0
    f1 = rest_after(out, scratch, k, duration, acc, dec, jerk) - goal
    f2 = rest_after(out, scratch, k, 0.0, acc, dec, jerk) - goal
    if f1 == 0.0:
        return duration
    f3 = f2
    part = 0.5
    for _ in range(MAX_STEPS):
        x = x1 + part * (x2 - x1)
        f = rest_after(out, scratch, k, x, acc, dec, jerk) - goal
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
def to_rest(out: Floats, scratch: Floats, goal: float, vel: float, acc: float, dec: float, jerk: float) -> int:
    """Plan from the state in `out[0]` (with p = 0) to rest at displacement `goal`; return the number of pieces."""
    v, a = out[0, 2], out[0, 3]
    rest = stop_displacement(scratch, v, a, acc, dec, jerk)
    if goal == rest:
        return to_velocity(out, 0.0, acc, dec, jerk)
    s = 1.0 if goal > rest else -1.0
    last = to_velocity(out, s * vel, acc, dec, jerk) - 1
    k = 0
    while k < last:
        duration = out[k + 1, 0] - out[k, 0]
        if s * (rest_after(out, scratch, k, duration, acc, dec, jerk) - goal) >= 0.0:
            break
        k += 1
    if k == last:  # the stop begins in the cruise, where (3) is linear
        time = (goal - rest_after(out, scratch, last, 0.0, acc, dec, jerk)) / (s * vel)
    else:
        time = leave_at(out, scratch, k, duration, goal, acc, dec, jerk)
    k = push(out, k, out[k, 4], time)
    out_tail = out[k:]
    count = k + to_velocity(out_tail, 0.0, acc, dec, jerk)
    out[count - 1, 1] = goal
    return count


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
