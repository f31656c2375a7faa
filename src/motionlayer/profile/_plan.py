"""Planning at command time: from plain numbers to a checked `Profile`."""

import math
from typing import Final, NamedTuple

import numpy as np

from motionlayer._kernel import kernel
from motionlayer.profile._check import BAD_LIMITS, FINE, JUMP, REASONS, check, is_limit, strays
from motionlayer.profile._kernels import Floats, extent, to_rest, to_velocity
from motionlayer.profile._stop import stop_displacement, stop_position

MAX_PIECES: Final = 20
"""Most pieces of a plan: three ramps and a correction on each way, twice, and the endless last one."""


class Limits(NamedTuple):
    """Magnitudes, all finite and > 0, in u/s, u/s², u/s², u/s³."""

    velocity: float
    acceleration: float
    deceleration: float
    jerk: float


class PlanError(ArithmeticError):
    """A plan failed its own check; nothing was commanded. The message holds the input, to be pasted."""


class Profile(NamedTuple):
    """A checked plan.

    Attributes:
        pieces: shape (k, 5): seconds since the start, p, v, a at the start of the piece, jerk. The last one has
            jerk and acceleration zero and goes on for ever.
        low: least position until the last piece.
        high: greatest position until the last piece.
    """

    pieces: Floats
    low: float
    high: float

    @property
    def duration(self) -> float:
        """Seconds until the last piece begins."""
        return float(self.pieces[-1, 0])


_out: Final = np.zeros((MAX_PIECES, 5))
_scratch: Final = np.zeros((MAX_PIECES, 5))


@kernel
def without_sliver(out: Floats, count: int) -> int:
    """Leave out a first piece whose jerk changes neither acceleration nor velocity by more than rounding does.

    Rounding makes such pieces at time 0, where the clock resolves what it cannot resolve later.
    """
    while count > 2 and out[0, 4] != 0.0:
        duration, v, a = out[1, 0], out[0, 2], out[0, 3]
        if abs(duration * out[0, 4]) > 1e-14 * abs(a) or abs(duration * a) > 1e-14 * abs(v):
            break
        count -= 1
        for k in range(count):
            for field in range(5):
                out[k, field] = out[k + 1, field]
        out[0, 0] = 0.0
    return count


@kernel
def plan(
    out: Floats, scratch: Floats, p: float, v: float, a: float, target: float, to_position: bool,
    vel: float, acc: float, dec: float, jerk: float,
) -> tuple[int, float, float]:  # fmt: skip
    """Plan, shift to the absolute position, check; return (pieces or fault, least, greatest position).

    The plan is made from displacement 0, so that its precision does not depend on where the axis stands.
    """
    if not (is_limit(vel) and is_limit(acc) and is_limit(dec) and is_limit(jerk)):
        return BAD_LIMITS, p, p
    out[0, 0] = 0.0
    out[0, 1] = 0.0
    out[0, 2] = v
    out[0, 3] = a
    if to_position:
        count = to_rest(out, scratch, target - p, vel, acc, dec, jerk)
    else:
        count = to_velocity(out, target, acc, dec, jerk)
        if target == 0.0 and count > 1:  # the same end as `stop_position`, bit for bit
            out[count - 1, 1] = stop_displacement(v, a, dec, jerk)
    count = without_sliver(out, count)
    for k in range(count):
        out[k, 1] += p
    if to_position:
        out[count - 1, 1] = target
    if count > 1:  # rounding may have touched the start; the check sees the joint to the next piece
        out[0, 1] = p
        out[0, 2] = v
        out[0, 3] = a
    elif strays(out[0], p, v, a, vel, max(acc, dec)):
        return JUMP, p, p
    fault = check(out, count, target, to_position, vel, acc, dec, jerk)
    low, high = extent(out, count)
    return (count if fault == FINE else fault), low, high


def _planned(p: float, v: float, a: float, target: float, to_position: bool, limits: Limits) -> Profile:
    count, low, high = plan(_out, _scratch, p, v, a, target, to_position, *limits)
    if count < 0:
        name = "plan_position" if to_position else "plan_velocity"
        raise PlanError(f"{REASONS[count]}: {name}({p!r}, {v!r}, {a!r}, {target!r}, {limits!r})")
    return Profile(_out[:count].copy(), low, high)


def plan_position(p: float, v: float, a: float, target: float, limits: Limits) -> Profile:
    """Plan the fastest way from (p, v, a) to rest at `target`.

    Args:
        p: start position, u.
        v: start velocity, u/s, also outside the limits.
        a: start acceleration, u/s², also outside the limits.
        target: end position, u.
        limits: in force on the way; a start outside goes back inside first.

    Raises:
        PlanError: the result failed its check.
    """
    return _planned(p, v, a, target, True, limits)


def plan_velocity(p: float, v: float, a: float, target: float, limits: Limits) -> Profile:
    """Plan the fastest way from (p, v, a) to the signed velocity `target` and on with it for ever.

    Raises:
        ValueError: |target| is above the velocity limit.
        PlanError: the result failed its check.
    """
    if not math.fabs(target) <= limits.velocity:
        raise ValueError(f"target velocity {target} is above the limit {limits.velocity}")
    return _planned(p, v, a, target, False, limits)


def plan_stop(p: float, v: float, a: float, limits: Limits) -> Profile:
    """Plan the fastest stop from (p, v, a); the velocity limit plays no part.

    Raises:
        PlanError: the result failed its check.
    """
    return _planned(p, v, a, 0.0, False, limits)


def stop_at(p: float, v: float, a: float, limits: Limits) -> float:
    """Return where `plan_stop` comes to rest, without the plan: bit for bit the same, in closed form.

    Raises:
        PlanError: a limit or a part of the state is no finite number, or the place is none.
    """
    if is_limit(limits.deceleration) and is_limit(limits.jerk) and math.isfinite(0.5 * a * abs(a) / limits.jerk):
        place = stop_position(p, v, a, limits.deceleration, limits.jerk)
        if math.isfinite(place):
            return place
    raise PlanError(f"a limit, the state or the place is no finite number: stop_at({p!r}, {v!r}, {a!r}, {limits!r})")


def rest_at(p: float) -> Profile:
    """Return the profile that stays at p."""
    return Profile(np.array([[0.0, p, 0.0, 0.0, 0.0]]), p, p)
