"""Ways: from a job and a state to a profile, without an axis.

A *joint* is where one job hands over to the next: a position, passed with a velocity and without acceleration.
Several rules meet there (function-blocks 2.8; record 25):

- the buffer mode names a speed out of those of the two jobs;
- a follower that turns back needs rest, and one that ends soon needs a speed from which it can still brake;
- the running job may be too near to reach that speed, or to brake down to it: then it is the nearest it can reach.

Near a place that is passed in motion a job can no longer come to rest before it, and need not. The direction in which
it arrives there is decided when it is planned first, and kept: to decide it anew would turn the axis round.

A job that is to be faster at its end than on its way keeps to its own velocity and gains the rest just before the
joint.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from motionlayer.nc._config import AxisConfig
from motionlayer.nc._motion import BOUNDED, SCALED, TARGETED, Job, JobKind
from motionlayer.profile import (
    Limits,
    Profile,
    passable_velocity,
    plan_passing,
    plan_position,
    plan_stop,
    plan_velocity,
    stop_at,
)

HALVINGS: Final = 48
"""Steps of a bisection."""

BLUR: Final = 1e-9
"""Relative: two places are one that are nearer than this share of the ways, and a slower motion is rest."""

SAME_PLACE: Final = 1e-10
ROUNDING: Final = 4e-15
"""Shares of a way and of positions: no more than what rounding does to the state in the midst of a plan."""


class Point(NamedTuple):
    """Position, velocity and acceleration of a setpoint: u, u/s, u/s²."""

    p: float
    v: float
    a: float


class Way(NamedTuple):
    """A profile, and the limits that are in force on it."""

    profile: Profile
    limits: Limits

    @property
    def end(self) -> Point:
        """Where the last piece begins."""
        return Point(*self.profile.pieces[-1, 1:4].tolist())


def scaled(job: Job, factor: float) -> Limits:
    """Return the limits of a job under an override; at 0 and 1 as they are."""
    if job.kind not in SCALED or factor in {0.0, 1.0}:
        return job.limits
    return job.limits._replace(velocity=job.limits.velocity * factor)


def limit_ahead(config: AxisConfig, direction: float) -> float:
    """Return the software limit in a direction."""
    return config.limit_max if direction > 0.0 else config.limit_min


def way_of(config: AxisConfig, job: Job, start: Point, factor: float) -> Way:
    """Plan a job.

    Args:
        config: of the axis.
        job: what to plan; of CONTINUOUS, `reach` and `heading` are set.
        start: where it begins.
        factor: override; 0 brakes what it scales.

    Raises:
        PlanError: the plan failed its check.
    """
    limits = scaled(job, factor)
    if job.kind not in SCALED or factor == 0.0:
        job.reach = math.inf
        return Way(plan_stop(*start, limits), limits)
    if job.kind is JobKind.POSITION:
        return Way(plan_position(*start, job.target, limits), limits)
    if job.kind is JobKind.CONTINUOUS:
        return _continuous(config, job, start, factor)
    if job.kind in BOUNDED:
        return _endless(config, start, math.copysign(limits.velocity, job.target), limits)
    return Way(plan_velocity(*start, math.copysign(limits.velocity, job.target), limits), limits)


def _endless(config: AxisConfig, start: Point, velocity: float, limits: Limits) -> Way:
    """Plan to a velocity and on with it, up to a software limit ahead."""
    end = limit_ahead(config, velocity)
    if math.isfinite(end):
        return Way(plan_position(*start, end, limits), limits)
    return Way(plan_velocity(*start, velocity, limits), limits)


def _continuous(config: AxisConfig, job: Job, start: Point, factor: float) -> Way:
    """Plan past the target with the end velocity, or the nearest that can be reached there, and on with it.

    What override 0 holds brakes without regard to the target. Where that leaves no room to take the acceleration back
    before it, the target is as good as passed: the axis goes on from where it is, and is not turned round for it.
    """
    limits, speed = scaled(job, factor), job.end_speed * factor
    highest, slow = limits._replace(velocity=max(limits.velocity, speed)), limits._replace(velocity=speed)
    if job.passed == 0.0:
        heading = job.heading or arrival(start, job.target, limits)
        most = brakeable_speed(config, job.target, heading * max(config.maximum.velocity, highest.velocity), limits)
        asked = min(speed, most)
        first = through(start, job.target, heading, asked, limits, most)
        # Without the highest speed: only for rounding, in the midst of a brake before the target.
        first = first or through(start, job.target, heading, asked, limits)
        if first is not None:
            job.reach, job.heading = first.profile.duration, heading
            rest = _endless(config, first.end, heading * speed, slow)
            return Way(joined(first.profile, rest.profile), highest)
        job.passed = heading
    return Way(_endless(config, start, job.passed * speed, slow).profile, highest)


def brakeable_speed(config: AxisConfig, place: float, velocity: float, limits: Limits) -> float:
    """Return the speed of a velocity at a place, lowered to what comes to rest before the software limit behind it.

    Infinite without a limit there. A brake is an acceleration from rest, backwards. It is asked for in every plan,
    since the override may have risen.
    """
    room, speed = abs(limit_ahead(config, velocity) - place), abs(velocity)
    if math.isinf(room):
        return math.inf
    backwards = limits._replace(velocity=speed, acceleration=limits.deceleration)
    found = passable_velocity(0.0, 0.0, 0.0, room, speed, backwards)
    return speed if found == speed else found * (1.0 - BLUR)


def arrival(start: Point, place: float, limits: Limits) -> float:
    """Return the direction in which the fastest way to rest at `place` arrives there, +1 or -1."""
    rest = stop_at(*start, limits)
    if abs(place - rest) <= BLUR * (abs(place - start.p) + abs(rest - start.p)):
        return math.copysign(1.0, start.v if start.v != 0.0 else place - start.p)
    return math.copysign(1.0, place - rest)


def turns_back(job: Job, start: Point, profile: Profile) -> bool:
    """Tell whether a job in motion comes to its target position only by turning back, as `profile` does."""
    if start.v == 0.0 or job.kind not in TARGETED:
        return False
    beyond = profile.high > job.target if start.v > 0.0 else profile.low < job.target
    return beyond and arrival(start, job.target, job.limits) * start.v < 0.0


def through(
    start: Point, place: float, heading: float, speed: float, limits: Limits, highest: float = math.inf
) -> Way | None:
    """Plan through `place`, with the nearest speed to `speed` that can be reached there without turning back.

    Args:
        start: where the way begins.
        place: position that the last piece begins at, u.
        heading: direction in which it is passed, +1 or -1.
        speed: u/s; above the velocity limit too.
        limits: in force on the way.
        highest: that is allowed there, u/s; at least `speed`.

    Returns:
        The way, its velocity limit raised where it is faster at the end; None where the axis can neither pass the place
        so slowly nor come to rest there.

    Raises:
        PlanError: a plan failed its check.
    """
    if speed > limits.velocity:
        late = _gained_late(start, place, heading * speed, limits)
        if late is not None:
            return late
    # Too near to be slowed down, it passes with what remains when its acceleration has been taken back.
    settled = heading * (start.v + 0.5 * start.a * abs(start.a) / limits.jerk)
    reached = _reachable(start, place, heading, speed, _at_least(limits, max(speed, settled)), highest)
    if reached is None:
        return _settling(start, place, heading, limits, highest)
    if reached == 0.0:
        return Way(plan_position(*start, place, limits), limits)
    raised = _at_least(limits, reached)
    return Way(plan_passing(*start, place, heading * reached, raised), raised)


def _settling(start: Point, place: float, heading: float, limits: Limits, highest: float) -> Way | None:
    """Take the acceleration back, and pass the place with what remains, where that is just as far; None elsewhere.

    It is the rest of a way that did so. Only the rounding of its state decides whether a planner finds it.
    """
    velocity = start.v + 0.5 * start.a * abs(start.a) / limits.jerk
    if not 0.0 < heading * velocity <= highest * (1.0 + BLUR):
        return None
    raised = _at_least(limits, abs(velocity))
    profile = plan_velocity(*start, velocity, raised)
    off = abs(float(profile.pieces[-1, 1]) - place)
    if off > SAME_PLACE * abs(place - start.p) + ROUNDING * (abs(place) + abs(start.p)):
        return None
    profile.pieces[-1, 1] = place
    return Way(profile, raised)


def _at_least(limits: Limits, speed: float) -> Limits:
    """Return limits with a velocity of at least `speed`."""
    return limits if speed <= limits.velocity else limits._replace(velocity=speed)


def _reachable(
    start: Point, place: float, heading: float, speed: float, limits: Limits, highest: float
) -> float | None:
    """Return the nearest speed that can be reached at a place; None without one, not even 0.

    A stop can be shorter than the way to a lower speed, since its acceleration is brought to zero while the axis
    hardly moves. So what is reachable may have a gap above 0.
    """
    found = abs(passable_velocity(*start, place, heading * speed, limits)) if speed > 0.0 else 0.0
    if BLUR * limits.velocity < found <= highest * (1.0 + BLUR):
        return found
    rest = stop_at(*start, limits)
    if (place - rest) * heading < -BLUR * (abs(place - start.p) + abs(rest - start.p)):
        return None
    low, high = 0.0, min(speed, highest)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if abs(passable_velocity(*start, place, heading * middle, limits)) == middle:
            low = middle
        else:
            high = middle
    return low if low > BLUR * limits.velocity else 0.0


def _gained_late(start: Point, place: float, velocity: float, limits: Limits) -> Way | None:
    """Keep to the velocity limit and gain the rest at the end; None where there is no room for that."""
    fast = limits._replace(velocity=abs(velocity))
    own = math.copysign(limits.velocity, velocity)
    gain = plan_velocity(0.0, own, 0.0, velocity, fast)
    begin = place - float(gain.pieces[-1, 1])
    if passable_velocity(*start, begin, own, limits) != own:
        return None
    first = plan_passing(*start, begin, own, limits)
    whole = joined(first, plan_velocity(begin, own, 0.0, velocity, fast))
    whole.pieces[-1, 1] = place
    return Way(whole, fast)


def joined(first: Profile, second: Profile) -> Profile:
    """Return one profile: the first up to its last piece, then the second, which begins there.

    Pieces of the second that are over before the clock of the first has moved are left out.
    """
    later = second.pieces.copy()
    later[:, 0] += first.duration
    pieces = np.concatenate([first.pieces[:-1], later])
    pieces = pieces[np.append(pieces[:-1, 0] < pieces[1:, 0], True)]
    return Profile(pieces, min(first.low, second.low), max(first.high, second.high))
