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

from motionlayer.nc._config import AxisConfig
from motionlayer.nc._motion import BOUNDED, SCALED, TARGETED, Job, JobKind
from motionlayer.nc._through import BLUR, Point, Way, arrival, joined, through
from motionlayer.profile import Limits, Profile, passable_velocity, plan_position, plan_stop, plan_velocity


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


def overshoots(job: Job, start: Point, profile: Profile) -> bool:
    """Tell whether a job in motion passes its target position, which lies ahead, and turns back, as `profile` does."""
    if job.kind not in TARGETED or not (job.target - start.p) * start.v > 0.0:
        return False
    beyond = profile.high > job.target if start.v > 0.0 else profile.low < job.target
    return beyond and arrival(start, job.target, job.limits) * start.v < 0.0
