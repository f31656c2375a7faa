"""Planning at command time: from plain numbers to a checked `Profile`."""

import math
from typing import Final, NamedTuple

import numpy as np

from motionlayer._kernel import kernel
from motionlayer.profile._check import (
    BAD_LIMITS,
    FINE,
    JUMP,
    REASONS,
    check_meeting,
    check_velocity,
    is_limit,
    strays,
)
from motionlayer.profile._kernels import MAX_PIECES, Floats, begin, extent, to_velocity, without_sliver
from motionlayer.profile._meet import to_point
from motionlayer.profile._stop import stop_displacement, stop_position


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
        pieces: shape (k, 5): seconds since the start, p, v, a at the start of the piece, jerk. The last one goes on
            for ever with jerk zero, and with acceleration zero but after a rendezvous.
        low: least position until the last piece.
        high: greatest position until the last piece.
    """

    pieces: Floats
    low: float
    high: float

    @property
    def duration(self) -> float:
        """Seconds until the last piece begins."""
        return self.pieces.item(-1, 0)


_out: Final = np.zeros((MAX_PIECES, 5))
_scratch: Final = np.zeros((MAX_PIECES, 5))


@kernel
def are_limits(vel: float, acc: float, dec: float, jerk: float) -> bool:
    """Tell whether all limits are finite and above zero."""
    return is_limit(vel) and is_limit(acc) and is_limit(dec) and is_limit(jerk)


@kernel
def moved(out: Floats, count: int, p: float) -> int:
    """Move a plan made from displacement 0 to where the axis stands; return its pieces without slivers.

    Plans are made from displacement 0, so that their precision does not depend on where the axis stands.
    """
    count = without_sliver(out, count)
    for k in range(count):
        out[k, 1] += p
    return count


@kernel
def begun(out: Floats, count: int, p: float, v: float, a: float, vel: float, pull: float) -> bool:
    """Put the exact start into a plan: rounding may have touched it, and the check sees the joint to the next piece.

    A single piece has none: tell whether it begins at the start.
    """
    if count == 1:
        return not strays(out[0], p, v, a, vel, pull)
    out[0, 1] = p
    out[0, 2] = v
    out[0, 3] = a
    return True


@kernel
def plan_meeting(
    out: Floats, scratch: Floats, p: float, v: float, a: float, target: float, w: float, u: float,
    vel: float, acc: float, dec: float, jerk: float,
) -> tuple[int, float, float]:  # fmt: skip
    """Plan to the point target + w·t with the end velocity u, check; return (pieces or fault, least, greatest p).

    Args:
        out: gets the pieces; MAX_PIECES rows.
        scratch: as large.
        p: start position, u.
        v: start velocity, u/s.
        a: start acceleration, u/s².
        target: where the point is at time 0.
        w: the velocity of the point.
        u: the velocity at the end, and from there on.
        vel: velocity limit.
        acc: acceleration limit.
        dec: deceleration limit.
        jerk: jerk limit.
    """
    if not are_limits(vel, acc, dec, jerk):
        return BAD_LIMITS, p, p
    count = to_point(out, scratch, target - p, w, u, math.inf, v, a, vel, acc, dec, jerk)
    if count < 0:
        return count, p, p
    count = moved(out, count, p)
    out[count - 1, 1] = target + w * out[count - 1, 0]
    if not begun(out, count, p, v, a, vel, max(acc, dec)):
        return JUMP, p, p
    fault = check_meeting(out, count, target, w, u, vel, acc, dec, jerk)
    low, high = extent(out, count)
    return (count if fault == FINE else fault), low, high


@kernel
def plan(
    out: Floats, scratch: Floats, p: float, v: float, a: float, target: float, to_position: bool,
    vel: float, acc: float, dec: float, jerk: float,
) -> tuple[int, float, float]:  # fmt: skip
    """Plan to rest at the position `target`, or to the velocity `target`; else as `plan_meeting`."""
    if to_position:
        return plan_meeting(out, scratch, p, v, a, target, 0.0, 0.0, vel, acc, dec, jerk)
    if not are_limits(vel, acc, dec, jerk):
        return BAD_LIMITS, p, p
    begin(out, v, a)
    count = to_velocity(out, target, acc, dec, jerk)
    if target == 0.0 and count > 1:  # the same end as `stop_position`, bit for bit
        out[count - 1, 1] = stop_displacement(v, a, dec, jerk)
    count = moved(out, count, p)
    if not begun(out, count, p, v, a, vel, max(acc, dec)):
        return JUMP, p, p
    fault = check_velocity(out, count, target, vel, acc, dec, jerk)
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
    _, _, dec, jerk = limits
    if 0.0 < dec < math.inf and 0.0 < jerk < math.inf and math.isfinite(0.5 * a * abs(a) / jerk):
        place = stop_position(p, v, a, dec, jerk)
        if math.isfinite(place):
            return place
    raise PlanError(f"a limit, the state or the place is no finite number: stop_at({p!r}, {v!r}, {a!r}, {limits!r})")


def rest_at(p: float) -> Profile:
    """Return the profile that stays at p."""
    return Profile(np.array([[0.0, p, 0.0, 0.0, 0.0]]), p, p)
