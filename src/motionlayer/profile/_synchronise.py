"""Synchronising with a target that moves at constant velocity."""

import math
from typing import Final, NamedTuple

import numpy as np

from motionlayer._kernel import kernel
from motionlayer.profile._check import BAD_LIMITS, FINE, JUMP, REASONS, check_meeting, is_limit, strays
from motionlayer.profile._kernels import Floats, extent, steady_displacement, to_meet, to_velocity
from motionlayer.profile._plan import MAX_PIECES, Limits, PlanError, Profile

HALVINGS: Final = 1100
"""Most halvings of a bracket: a float64 between 0 and its largest value needs 1075."""

_out: Final = np.zeros((MAX_PIECES, 5))
_scratch: Final = np.zeros((MAX_PIECES, 5))


class Moving(NamedTuple):
    """A target that is at `position` (u) at time 0 and goes on at `velocity` (u/s)."""

    position: float
    velocity: float


@kernel
def meet(
    out: Floats, scratch: Floats, s: float, goal: float, u: float, cruise: float,
    v: float, a: float, acc: float, dec: float, jerk: float,
) -> int:  # fmt: skip
    """Plan from (0, v, a) to the motion goal + u·t by way of the velocity `cruise`: see `to_meet`."""
    out[0, 0] = 0.0
    out[0, 1] = 0.0
    out[0, 2] = v
    out[0, 3] = a
    return to_meet(out, scratch, s, goal, u, cruise, acc, dec, jerk)


@kernel
def meet_by(
    out: Floats, scratch: Floats, goal: float, u: float, time: float,
    v: float, a: float, vel: float, acc: float, dec: float, jerk: float,
) -> int:  # fmt: skip
    """Plan from (0, v, a) to the motion goal + u·t, in it as late as possible but not after `time`.

    The slower the velocity by way of which, the later: as it nears u, the time grows beyond all bounds. It is bisected
    down to neighbouring floats; the earlier of the two is taken. An infinite time asks for the earliest meeting.
    """
    direct = steady_displacement(scratch, v, a, u, acc, dec, jerk)
    out[0, 0] = 0.0
    out[0, 1] = 0.0
    out[0, 2] = v
    out[0, 3] = a
    if goal == direct:
        count = to_velocity(out, u, acc, dec, jerk)
        out[count - 1, 1] = goal + u * out[count - 1, 0]
        return count
    s = 1.0 if goal > direct else -1.0
    fast, slow = s * vel, u
    count = meet(out, scratch, s, goal, u, fast, v, a, acc, dec, jerk)
    if count < 0 or time == math.inf or out[count - 1, 0] > time:
        return count
    for _ in range(HALVINGS):
        middle = slow + 0.5 * (fast - slow)
        if middle in (slow, fast):
            break
        count = meet(out, scratch, s, goal, u, middle, v, a, acc, dec, jerk)
        if count > 0 and out[count - 1, 0] <= time:
            fast = middle
        else:
            slow = middle
    return meet(out, scratch, s, goal, u, fast, v, a, acc, dec, jerk)


@kernel
def plan_meeting(
    out: Floats, scratch: Floats, p: float, v: float, a: float, position: float, u: float, time: float,
    vel: float, acc: float, dec: float, jerk: float,
) -> tuple[int, float, float]:  # fmt: skip
    """Plan, shift to the absolute position, check; return (pieces or fault, least, greatest position)."""
    if not (is_limit(vel) and is_limit(acc) and is_limit(dec) and is_limit(jerk)):
        return BAD_LIMITS, p, p
    count = meet_by(out, scratch, position - p, u, time, v, a, vel, acc, dec, jerk)
    if count < 0:
        return count, p, p
    for k in range(count):
        out[k, 1] += p
    end = out[count - 1]
    end[1] = position + u * end[0]
    if count > 1:  # as in `plan`
        out[0, 1] = p
        out[0, 2] = v
        out[0, 3] = a
    elif strays(end, p, v, a, vel, max(acc, dec)):
        return JUMP, p, p
    fault = check_meeting(out, count, position, u, vel, acc, dec, jerk)
    low, high = extent(out, count)
    return (count if fault == FINE else fault), low, high


def plan_synchronise(p: float, v: float, a: float, target: Moving, limits: Limits, *, at: float = math.inf) -> Profile:
    """Plan from (p, v, a) into the motion of a target; the last piece of the profile is that motion.

    Args:
        p: start position, u.
        v: start velocity, u/s, also outside the limits.
        a: start acceleration, u/s², also outside the limits.
        target: the motion to join, on the clock of the profile.
        limits: in force on the way, of the absolute motion; `velocity` is at least that of the target.
        at: the instant from which both move as one, s; without it as early as possible. The profile reaches the
            target's motion then, or as little before as its numbers allow; where the fastest way to its velocity
            happens to end in its motion, already there.

    Returns:
        The profile; `low` and `high` are its extent until the last piece begins.

    Raises:
        ValueError: the target is faster than the velocity limit, or `at` is before 0 or no number.
        PlanError: the target stays out of reach (it is as fast as the limit and ahead), cannot be met as early as
            `at`, or the result failed its check.
    """
    if not math.fabs(target.velocity) <= limits.velocity:
        raise ValueError(f"the target's velocity {target.velocity} is above the limit {limits.velocity}")
    if not at >= 0.0:
        raise ValueError(f"the time of meeting is {at}; it must be >= 0")
    count, low, high = plan_meeting(_out, _scratch, p, v, a, *target, at, *limits)
    call = f"plan_synchronise({p!r}, {v!r}, {a!r}, {target!r}, {limits!r}, at={at!r})"
    if count < 0:
        raise PlanError(f"{REASONS[count]}: {call}")
    earliest = float(_out[count - 1, 0])
    if earliest > at:
        raise PlanError(f"the target cannot be met before {earliest} s: {call}")
    return Profile(_out[:count].copy(), low, high)
