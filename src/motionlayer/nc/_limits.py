"""Software limits, feed enables, the ranges of planning and the least dynamics: which commands they refuse.

What a way is compared with is blurred by a share of the sizes that take part, and of nothing else: the same motion in
µm, mm and m is judged alike.
"""

import math
from typing import Final

from motionlayer.command import ErrorId
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._motion import BOUNDED, BRAKES, SCALED, TARGETED, Job, JobKind, Refusal
from motionlayer.profile import RANGES, Limits, Profile

BLUR: Final = 1e-9
"""Share of positions and ways that counts as none; ten times what a plan may be off."""


def bad_target(config: AxisConfig, job: Job, here: float) -> Refusal | None:
    """Tell why a target cannot be commanded from `here`, before anything is planned."""
    low, high, unit = config.limit_min, config.limit_max, config.unit
    if job.kind in TARGETED:
        outside = bad_place("target", job.target, unit) or _too_near(job.target, here, unit)
        if outside is not None:
            return outside
        if not low <= job.target <= high:
            return Refusal(ErrorId.TARGET_OUTSIDE_LIMITS, f"target = {job.target}, allowed: {low} to {high} {unit}")
    elif job.kind in BOUNDED and here >= high and job.target > 0.0:
        return Refusal(ErrorId.ABOVE_MAXIMUM, limit_text(config, here, up=True))
    elif job.kind in BOUNDED and here <= low and job.target < 0.0:
        return Refusal(ErrorId.BELOW_MINIMUM, limit_text(config, here, up=False))
    return None


def bad_place(name: str, position: float, unit: str) -> Refusal | None:
    """Tell why an axis cannot be at a position: it is no number, or none that can be planned with."""
    if not math.isfinite(position):
        return Refusal(ErrorId.TARGET_NOT_FINITE, f"{name} = {position}")
    if abs(position) > RANGES.largest:
        allowed = f"allowed: {-RANGES.largest} to {RANGES.largest} {unit}"
        return Refusal(ErrorId.SET_POSITION_RANGE, f"{name} = {position}, {allowed}")
    return None


def _too_near(target: float, here: float, unit: str) -> Refusal | None:
    """Tell why a target is not gone to: the cube of the time that it takes would underflow."""
    way = abs(target - here)
    if way >= RANGES.smallest or way == 0.0:
        return None
    return Refusal(ErrorId.DISTANCE_TOO_SHORT, f"way = {way}, allowed: 0, or from {RANGES.smallest} {unit} on")


def too_long(job: Job, profile: Profile, factor: float) -> Refusal | None:
    """Tell why a motion is not taken: before its end the clock would be too coarse.

    What counts is the way to the target, of an endless motion that to its velocity: the cruise may last. An override
    makes no way too long, because it may rise again.

    Args:
        job: what has been planned.
        profile: its plan.
        factor: override that it was planned with, > 0.
    """
    if profile.duration * factor <= RANGES.duration or job.kind not in SCALED:
        return None
    time = factor * _time_to_target(job, profile)
    if time <= RANGES.duration:
        return None
    detail = f"it takes {time:.6g} s, allowed: up to {RANGES.duration:.0f} s, 104 days"
    return Refusal(ErrorId.POSITIONING_TOO_LONG, detail)


def _time_to_target(job: Job, profile: Profile) -> float:
    """Return after how many seconds of its profile a job is where it was asked to be, or as fast."""
    if job.kind is JobKind.CONTINUOUS:
        return job.reach
    if job.kind in BOUNDED:
        return next(float(time) for time, _, _, pull, jerk in profile.pieces.tolist() if pull == 0.0 and jerk == 0.0)
    return profile.duration


def least_pull(speed: float, jerk: float) -> float:
    """Return the weakest acceleration or deceleration that is planned for certain: V/A is `RANGES.phases` times A/J."""
    return math.sqrt(speed * jerk / RANGES.phases)


def least_jerk(v: float, a: float, maximum: Limits) -> float:
    """Return the least jerk that takes an acceleration, not 0, back within the maxima of the axis.

    With less, bringing `a` to zero would carry |v| beyond the maximum velocity, or, after a reversal, |a| beyond the
    maximum acceleration: along constant jerk a² changes by 2J per velocity. It never exceeds what got the axis into
    (v, a).
    """
    room = maximum.velocity - math.copysign(v, v * a)
    needed = a * a / (2.0 * room) if room > 0.0 else maximum.jerk
    if v * a < 0.0:
        needed = max(needed, (a * a - maximum.acceleration * maximum.acceleration) / (2.0 * abs(v)))
    return min(needed, maximum.jerk)


def too_weak(job: Job, speed: float, unit: str) -> Refusal | None:
    """Tell why dynamics are not taken: their phases are farther apart than what is planned for certain.

    They are judged whatever is planned with them first: a change of override or a brake has to be planned too. A brake
    is never too weak (see `AxisBraking`).

    Args:
        job: what is asked for.
        speed: with which it may begin, u/s.
        unit: of the axis.
    """
    velocity, acceleration, deceleration, jerk = job.limits
    weakest, fastest = min(acceleration, deceleration), max(velocity, speed)
    least = least_pull(fastest, jerk)
    if weakest >= least or job.kind in BRAKES:
        return None
    name = "acceleration" if acceleration == weakest else "deceleration"
    allowed = f"from {least:.6g} {unit}/s² on beside velocity = {fastest} and jerk = {jerk}"
    return Refusal(ErrorId.ACCELERATION_TOO_SMALL, f"{name} = {weakest}, allowed: {allowed}")


def overrun(config: AxisConfig, job: Job, profile: Profile, here: float) -> Refusal | None:
    """Tell whether the way from `here` to the target leaves the software limits."""
    low, high = config.limit_min, config.limit_max
    if job.kind not in SCALED or (low <= profile.low and profile.high <= high):
        return None
    blur = _blur(profile)
    if profile.low >= min(low, here) - blur and profile.high <= max(high, here) + blur:
        return None
    reach = f"would reach {profile.low} to {profile.high}, allowed: {low} to {high} {config.unit}"
    return Refusal(ErrorId.OVERRUN, reach)


def directions(profile: Profile, here: float) -> tuple[bool, bool]:
    """Tell whether a profile that begins at `here` leads in positive and in negative direction."""
    blur, end = _blur(profile), float(profile.pieces[-1, 2])
    return profile.high > here + blur or end > 0.0, profile.low < here - blur or end < 0.0


def missing_feed(job: Job, profile: Profile, here: float, feed: tuple[bool, bool]) -> Refusal | None:
    """Tell whether a way from `here` leads in a direction in which no motion is released."""
    if job.kind not in SCALED or all(feed):
        return None
    for name, needed, given in zip(("positive", "negative"), directions(profile, here), feed, strict=True):
        if needed and not given:
            return Refusal(ErrorId.FEED_NOT_ENABLED, f"feed enable in {name} direction is missing")
    return None


def limit_text(config: AxisConfig, here: float, *, up: bool) -> str:
    """Name the position and the limit in that direction."""
    return f"position = {here}, limit {config.limit_max if up else config.limit_min} {config.unit}"


def _blur(profile: Profile) -> float:
    """Return what rounding may do to the ends of a way."""
    return BLUR * max(abs(profile.low), abs(profile.high), profile.high - profile.low)
