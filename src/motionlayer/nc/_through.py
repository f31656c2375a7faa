"""Ways through a place: passed in motion without acceleration, as a joint is, or the target of a continuous move.

Such a place is passed with the speed that is asked for there, or with the nearest that the axis can still reach. It may
be too near even for that: then nothing leads through it but a turn, and that is for others to decide.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from motionlayer.profile import (
    Limits,
    Profile,
    passable_velocity,
    plan_passing,
    plan_position,
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

    @property
    def heading(self) -> float:
        """Direction in which it goes on at its end, +1 or -1; 0 at rest."""
        velocity = self.end.v
        return math.copysign(1.0, velocity) if velocity != 0.0 else 0.0


def arrival(start: Point, place: float, limits: Limits) -> float:
    """Return the direction in which the fastest way to rest at `place` arrives there, +1 or -1."""
    rest = stop_at(*start, limits)
    if abs(place - rest) <= BLUR * (abs(place - start.p) + abs(rest - start.p)):
        return math.copysign(1.0, start.v if start.v != 0.0 else place - start.p)
    return math.copysign(1.0, place - rest)


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
    kept = _at_least(limits, max(speed, heading * remaining(start, limits.jerk)))
    reached = _reachable(start, place, heading, speed, kept, highest)
    if reached is None:
        return _settling(start, place, heading, limits, highest)
    if reached == 0.0:
        return Way(plan_position(*start, place, limits), limits)
    raised = _at_least(limits, reached)
    return Way(plan_passing(*start, place, heading * reached, raised), raised)


def remaining(start: Point, jerk: float) -> float:
    """Return the velocity that remains when the acceleration has been taken back."""
    return start.v + 0.5 * start.a * abs(start.a) / jerk


def settled(start: Point, limits: Limits) -> Way:
    """Take the acceleration back, and go on with what velocity remains.

    Raises:
        PlanError: the plan failed its check.
    """
    velocity = remaining(start, limits.jerk)
    raised = _at_least(limits, abs(velocity))
    return Way(plan_velocity(*start, velocity, raised), raised)


def _settling(start: Point, place: float, heading: float, limits: Limits, highest: float) -> Way | None:
    """Take the acceleration back, and pass the place with what remains, where that is just as far; None elsewhere.

    It is the rest of a way that did so. Only the rounding of its state decides whether a planner finds it.
    """
    if not 0.0 < heading * remaining(start, limits.jerk) <= highest * (1.0 + BLUR):
        return None
    way = settled(start, limits)
    off = abs(way.end.p - place)
    if off > SAME_PLACE * abs(place - start.p) + ROUNDING * (abs(place) + abs(start.p)):
        return None
    way.profile.pieces[-1, 1] = place
    return way


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
