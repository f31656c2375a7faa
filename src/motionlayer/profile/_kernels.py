"""Pieces, ramps and the way to a velocity. Theory and equation numbers: the docstring of `motionlayer.profile`.

A plan under construction is an array `out` of pieces (time, p, v, a, jerk). `out[count]` always holds the state at
which the next piece begins; its jerk is not known yet. Direction s turns everything into "gain velocity".
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel

Floats = NDArray[np.float64]

MAX_PIECES: Final = 20
"""Most pieces of a plan: three ramps and a correction on each way, twice, and the endless last one."""

SLIVER: Final = 1e-14
"""A first piece that changes velocity and acceleration by less than this share was made by rounding."""


@kernel
def begin(out: Floats, v: float, a: float) -> None:
    """Open a plan at time 0 and displacement 0."""
    out[0, 0] = 0.0
    out[0, 1] = 0.0
    out[0, 2] = v
    out[0, 3] = a


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
    s = 1.0 if target > reached or (target == reached and a < 0.0) else -1.0  # the tie too has its mirror image
    count = 0
    if s * a < 0.0:
        count = push(out, 0, s * jerk, abs(a) / jerk)
        out[count, 3] = 0.0
    if target == reached:  # another ramp would make up for nothing but rounding
        out[count, 2] = target
        out[count, 4] = 0.0
        return count + 1
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
def turns(v: float, a: float, j: float, duration: float) -> tuple[float, float]:
    """Return when inside a piece its velocity is zero, in order; 0 for what is not inside."""
    under = a * a - 2.0 * j * v
    if not under >= 0.0:
        return 0.0, 0.0
    root = math.sqrt(under)
    # v + a s + j s²/2 = 0, as 2v / (-a ± root), which divides by nothing small of its own making
    one = 2.0 * v / (-a - root) if -a - root != 0.0 else 0.0
    two = 2.0 * v / (-a + root) if -a + root != 0.0 else 0.0
    one = one if 0.0 < one < duration else 0.0
    two = two if 0.0 < two < duration else 0.0
    return min(one, two), max(one, two)


@kernel
def extent(out: Floats, count: int) -> tuple[float, float]:
    """Return the least and the greatest position of a plan until its last piece begins."""
    low = out[count - 1, 1]
    high = low
    for k in range(count - 1):
        p, v, a, j = out[k, 1], out[k, 2], out[k, 3], out[k, 4]
        low, high = min(low, p), max(high, p)
        for s in turns(v, a, j, out[k + 1, 0] - out[k, 0]):
            turn = p + s * (v + s * (0.5 * a + s * (j / 6.0)))
            low, high = min(low, turn), max(high, turn)
    return low, high


@kernel
def without_sliver(out: Floats, count: int) -> int:
    """Leave out a first piece whose jerk changes neither acceleration nor velocity by more than rounding does.

    Rounding makes such pieces at time 0, where the clock resolves what it cannot resolve later.
    """
    while count > 2 and out[0, 4] != 0.0:
        duration, v, a = out[1, 0], out[0, 2], out[0, 3]
        if abs(duration * out[0, 4]) > SLIVER * abs(a) or abs(duration * a) > SLIVER * abs(v):
            break
        count -= 1
        for k in range(count):
            for field in range(5):
                out[k, field] = out[k + 1, field]
        out[0, 0] = 0.0
    return count
