"""Software limits and feed enables: which commands they refuse."""

import math

from motionlayer.command import ErrorId
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._motion import BOUNDED, SCALED, Job, JobKind, Refusal
from motionlayer.profile import Profile


def bad_target(config: AxisConfig, job: Job, here: float) -> Refusal | None:
    """Tell why a target cannot be commanded from `here`, before anything is planned."""
    low, high, unit = config.limit_min, config.limit_max, config.unit
    if job.kind in (JobKind.POSITION, JobKind.CONTINUOUS):
        if not math.isfinite(job.target):
            return Refusal(ErrorId.TARGET_NOT_FINITE, f"target = {job.target}")
        if not low <= job.target <= high:
            return Refusal(ErrorId.TARGET_OUTSIDE_LIMITS, f"target = {job.target}, allowed: {low} to {high} {unit}")
    elif job.kind in BOUNDED and here >= high and job.target > 0.0:
        return Refusal(ErrorId.ABOVE_MAXIMUM, limit_text(config, here, up=True))
    elif job.kind in BOUNDED and here <= low and job.target < 0.0:
        return Refusal(ErrorId.BELOW_MINIMUM, limit_text(config, here, up=False))
    return None


def overrun(config: AxisConfig, job: Job, profile: Profile, here: float) -> Refusal | None:
    """Tell whether the way from `here` to the target leaves the software limits."""
    low, high = config.limit_min, config.limit_max
    blur = _blur(here)
    if job.kind not in SCALED or (profile.low >= min(low, here) - blur and profile.high <= max(high, here) + blur):
        return None
    reach = f"would reach {profile.low} to {profile.high}, allowed: {low} to {high} {config.unit}"
    return Refusal(ErrorId.OVERRUN, reach)


def directions(profile: Profile, here: float) -> tuple[bool, bool]:
    """Tell whether a profile that begins at `here` leads in positive and in negative direction."""
    blur, end = _blur(here), float(profile.pieces[-1, 2])
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


def _blur(here: float) -> float:
    return 1e-9 * (1.0 + abs(here))
