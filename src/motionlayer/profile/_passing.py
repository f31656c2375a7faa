"""Passing a position: there with a velocity, and on with it."""

import math
from typing import Final

import numpy as np

from motionlayer._kernel import kernel
from motionlayer.profile._check import REASONS
from motionlayer.profile._kernels import MAX_PIECES, Floats
from motionlayer.profile._meet import HALVINGS, gain
from motionlayer.profile._plan import Limits, PlanError, Profile, are_limits, plan_meeting

_out: Final = np.zeros((MAX_PIECES, 5))
_scratch: Final = np.zeros((MAX_PIECES, 5))


@kernel
def passable(
    scratch: Floats, goal: float, u: float, v: float, a: float, vel: float, acc: float, dec: float, jerk: float
) -> float:
    """Return the velocity nearest to u with which displacement `goal` is passed without turning back; 0 without one.

    Over the velocities of one sign the way to x has one valley, at the velocity r that is reached by bringing a to zero
    at once: who is to be slower brakes, who is to be faster gains velocity. So the answer lies between u and r.
    """
    s = 1.0 if u > 0.0 or (u == 0.0 and (goal > 0.0 or (goal == 0.0 and v > 0.0))) else -1.0
    if s * (goal - gain(scratch, v, a, 0.0, u, acc, dec, jerk)) >= 0.0:
        return u
    good, bad = s * min(max(s * (v + 0.5 * a * abs(a) / jerk), 0.0), vel), u
    if not s * (goal - gain(scratch, v, a, 0.0, good, acc, dec, jerk)) >= 0.0:
        return 0.0
    for _ in range(HALVINGS):
        middle = bad + 0.5 * (good - bad)
        if middle in (bad, good):
            break
        if s * (goal - gain(scratch, v, a, 0.0, middle, acc, dec, jerk)) >= 0.0:
            good = middle
        else:
            bad = middle
    return good


def plan_passing(p: float, v: float, a: float, target: float, end_velocity: float, limits: Limits) -> Profile:
    """Plan from (p, v, a) to the position `target`, there with `end_velocity` and acceleration 0, and on with it.

    Where the target is too near for that velocity (see `passable_velocity`), the axis backs off and comes again.

    Args:
        p: start position, u.
        v: start velocity, u/s, also outside the limits.
        a: start acceleration, u/s², also outside the limits.
        target: position to pass, u.
        end_velocity: signed, u/s; 0 asks for rest, as `plan_position` does.
        limits: in force on the way; a start outside goes back inside first.

    Returns:
        The profile. Its last piece begins at the target; `low` and `high` are its extent until then.

    Raises:
        ValueError: |end_velocity| is above the velocity limit.
        PlanError: the result failed its check.
    """
    _require_within(end_velocity, limits)
    count, low, high = plan_meeting(_out, _scratch, p, v, a, target, 0.0, end_velocity, *limits)
    if count < 0:
        call = f"plan_passing({p!r}, {v!r}, {a!r}, {target!r}, {end_velocity!r}, {limits!r})"
        raise PlanError(f"{REASONS[count]}: {call}")
    return Profile(_out[:count].copy(), low, high)


def passable_velocity(p: float, v: float, a: float, target: float, end_velocity: float, limits: Limits) -> float:
    """Return the velocity nearest to `end_velocity` with which `plan_passing` needs not back off.

    It is slower than asked where the way is too short to gain the velocity, and faster where it is too short to brake
    down to it. A start whose own acceleration turns it is turned by that alone.

    Args:
        p: start position, u.
        v: start velocity, u/s, also outside the limits.
        a: start acceleration, u/s², also outside the limits.
        target: position to pass, u.
        end_velocity: signed, u/s; for 0 the direction is that from p to the target (that of v if they are one).
        limits: in force on the way.

    Returns:
        A velocity of the same sign, to the last float; 0 if there is none: the target lies behind, or too near even to
        bring the acceleration to zero.

    Raises:
        ValueError: |end_velocity| is above the velocity limit.
        PlanError: a limit is not finite and above zero, or the state, the target or the way to it no finite number.
    """
    _require_within(end_velocity, limits)
    reached = v + 0.5 * a * abs(a) / limits.jerk if are_limits(*limits) else math.nan
    if not (math.isfinite(reached) and math.isfinite(target - p)):
        call = f"passable_velocity({p!r}, {v!r}, {a!r}, {target!r}, {end_velocity!r}, {limits!r})"
        raise PlanError(f"a limit, the state or the way is no finite number: {call}")
    return passable(_scratch, target - p, end_velocity, v, a, *limits)


def _require_within(end_velocity: float, limits: Limits) -> None:
    if not math.fabs(end_velocity) <= limits.velocity:
        raise ValueError(f"the end velocity {end_velocity} is above the limit {limits.velocity}")
