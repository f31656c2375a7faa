"""Joining what moves: a target at constant velocity as early as possible, a state at a given time."""

import math
from typing import Final, NamedTuple

import numpy as np

from motionlayer._kernel import kernel
from motionlayer.profile._check import BAD_LIMITS, FINE, JUMP, REASONS, TOO_EARLY, check_arrival
from motionlayer.profile._kernels import MAX_PIECES, Floats, extent, push
from motionlayer.profile._meet import to_point
from motionlayer.profile._passing import plan_passing
from motionlayer.profile._plan import Limits, PlanError, Profile, are_limits, begun, moved, plan_meeting
from motionlayer.profile._tolerances import TOLERANCES

_out: Final = np.zeros((MAX_PIECES, 5))
_scratch: Final = np.zeros((MAX_PIECES, 5))


class Moving(NamedTuple):
    """A target that is at `position` (u) at time 0 and goes on at `velocity` (u/s)."""

    position: float
    velocity: float


class State(NamedTuple):
    """Where something is (u), how fast (u/s), and how its velocity changes (u/s²)."""

    position: float
    velocity: float
    acceleration: float


@kernel
def ramp_into(velocity: float, pull: float, jerk: float) -> tuple[float, float, float]:
    """Return duration, way and first velocity of the ramp at full jerk from acceleration zero into (velocity, pull)."""
    duration = abs(pull) / jerk
    j = jerk if pull > 0.0 else -jerk
    way = duration * (velocity - duration * (0.5 * pull - duration * (j / 6.0)))
    return duration, way, velocity - 0.5 * duration * pull


@kernel
def plan_arrival(
    out: Floats, scratch: Floats, p: float, v: float, a: float, position: float, velocity: float, pull: float,
    time: float, vel: float, acc: float, dec: float, jerk: float,
) -> tuple[int, float, float]:  # fmt: skip
    """Plan to be at (position, velocity, pull) at `time`, check; return (pieces or fault, least, greatest p).

    The way ends with a ramp of full jerk from acceleration zero to `pull`. Before it lies a ride at constant velocity,
    and that is met like any moving point. Limits are finite and above zero.
    """
    gaining, way, w = ramp_into(velocity, pull, jerk)
    ramp_at = time - gaining
    goal = (position - p) - way - w * ramp_at
    count = to_point(out, scratch, goal, w, w, ramp_at, v, a, vel, acc, dec, jerk)
    if count < 0 or out[count - 1, 0] > ramp_at:
        return TOO_EARLY, p, p
    joined = out[count - 1, 0]
    out[count - 1, 1] = goal + w * joined
    last = push(out, count - 1, 0.0, ramp_at - joined)
    last = push(out, last, jerk if pull > 0.0 else -jerk, gaining)
    end = out[last]
    end[0], end[1], end[2], end[3], end[4] = time, position - p, velocity, pull, 0.0
    count = moved(out, last + 1, p)
    out[count - 1, 1] = position
    if not begun(out, count, p, v, a, vel, max(acc, dec)):
        return JUMP, p, p
    fault = check_arrival(out, count, time, position, velocity, pull, vel, acc, dec, jerk)
    low, high = extent(out, count)
    return (count if fault == FINE else fault), low, high


def plan_synchronise(p: float, v: float, a: float, target: Moving, limits: Limits) -> Profile:
    """Plan from (p, v, a) into the motion of a target as early as possible; the last piece is that motion.

    Args:
        p: start position, u.
        v: start velocity, u/s, also outside the limits.
        a: start acceleration, u/s², also outside the limits.
        target: the motion to join, on the clock of the profile.
        limits: in force on the way, of the absolute motion; `velocity` is at least that of the target.

    Returns:
        The profile; `low` and `high` are its extent until the last piece begins.

    Raises:
        ValueError: the target is faster than the velocity limit.
        PlanError: the target stays out of reach (it is as fast as the limit and ahead), or the result failed its check.
    """
    if not math.fabs(target.velocity) <= limits.velocity:
        raise ValueError(f"the target's velocity {target.velocity} is above the limit {limits.velocity}")
    position, u = target
    count, low, high = plan_meeting(_out, _scratch, p, v, a, position, u, u, *limits)
    if count < 0:
        raise PlanError(f"{REASONS[count]}: plan_synchronise({p!r}, {v!r}, {a!r}, {target!r}, {limits!r})")
    return Profile(_out[:count].copy(), low, high)


def plan_rendezvous(p: float, v: float, a: float, target: State, limits: Limits, *, at: float) -> Profile:
    """Plan from (p, v, a) so as to be in the state `target` at the instant `at`, for couplings.

    The target's acceleration is gained from zero at full jerk at the very end: a plan made anew after that ramp has
    begun would first have to take it back. Before the ramp the profile rides along at constant velocity.

    Args:
        p: start position, u.
        v: start velocity, u/s, also outside the limits.
        a: start acceleration, u/s², also outside the limits.
        target: the state to be in; its velocity before the ramp has to be inside the limits too.
        limits: in force on the way, of the absolute motion.
        at: when, s since the start of the profile.

    Returns:
        The profile. Its last piece begins in exactly `target` at exactly `at`, and keeps that acceleration for ever:
        whoever follows the target has to take over there. `low` and `high` are the extent until then.

    Raises:
        ValueError: the target is outside the limits, or `at` is not finite or before the end of the ramp.
        PlanError: a limit is not finite and above zero, the target cannot be met at `at` (the message says when it
            can), or the result failed its check.
    """
    count, low, high = BAD_LIMITS, p, p
    if are_limits(*limits):
        _require_reachable(target, limits, at)
        count, low, high = plan_arrival(_out, _scratch, p, v, a, *target, at, *limits)
    if count < 0:
        reason = _missed(p, v, a, target, limits, at) if count == TOO_EARLY else REASONS[count]
        raise PlanError(f"{reason}: plan_rendezvous({p!r}, {v!r}, {a!r}, {target!r}, {limits!r}, at={at!r})")
    return Profile(_out[:count].copy(), low, high)


def _missed(p: float, v: float, a: float, target: State, limits: Limits, at: float) -> str:
    """Say why a target is not met at a time, and when it can be.

    The times at which it can be met need not be one interval: who comes along fast, and is to be there a little later
    than soon, cannot slow down so much and has to back off.
    """
    position, velocity, pull = target
    gaining, way, before = ramp_into(velocity, pull, limits.jerk)
    earliest = plan_passing(p, v, a, position - way, before, limits).duration + gaining
    if at < earliest:
        return f"the target cannot be met before {earliest} s"
    return f"the target can be met at {earliest} s, and then only later than at {at} s, with time to back off"


def _require_reachable(target: State, limits: Limits, at: float) -> None:
    """Raise ValueError with the reason why no way whatever leads into the target under the limits."""
    _, u, pull = target
    vel, acc, dec, jerk = limits
    if not math.fabs(u) <= vel:
        raise ValueError(f"the target's velocity {u} is above the limit {vel}")
    name, limit = ("acceleration", acc) if u * pull > 0.0 else ("deceleration", dec)
    if not math.fabs(pull) <= limit:
        raise ValueError(f"the target's acceleration {pull} at velocity {u} is above the {name} limit {limit}")
    gaining, _, before = ramp_into(u, pull, jerk)
    if not math.fabs(before) <= vel:
        raise ValueError(
            f"the target's acceleration {pull} at velocity {u} can only be gained from velocity {before}, "
            f"which is above the limit {vel}"
        )
    if before * pull < 0.0 and u * pull >= 0.0:  # the ramp passes v = 0
        passing = math.sqrt(2.0 * jerk * math.fabs(before))
        if not passing <= min(acc, dec) * (1.0 + TOLERANCES.acceleration):
            raise ValueError(
                f"the target's acceleration {pull} at velocity {u} is gained through velocity 0 with {passing} there, "
                f"which is above the lower of the limits {acc} and {dec}"
            )
    if not gaining <= at < math.inf:
        raise ValueError(
            f"the time of meeting is {at} s; it must be finite and at least {gaining} s, what the ramp to the target's "
            "acceleration takes"
        )
