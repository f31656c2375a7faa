"""Software limits: which commands they refuse."""

import math

from motionlayer.command import ErrorId
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._motion import Job, JobKind, Refusal
from motionlayer.profile import Profile


def bad_target(config: AxisConfig, job: Job, here: float) -> Refusal | None:
    """Tell why a target cannot be commanded from `here`, before anything is planned."""
    low, high, unit = config.limit_min, config.limit_max, config.unit
    if job.kind is JobKind.POSITION and not math.isfinite(job.target):
        return Refusal(ErrorId.TARGET_NOT_FINITE, f"target = {job.target}")
    if job.kind is JobKind.POSITION and not low <= job.target <= high:
        return Refusal(ErrorId.TARGET_OUTSIDE_LIMITS, f"target = {job.target}, allowed: {low} to {high} {unit}")
    if job.kind is JobKind.VELOCITY and here >= high and job.target > 0.0:
        return Refusal(ErrorId.ABOVE_MAXIMUM, limit_text(config, here, up=True))
    if job.kind is JobKind.VELOCITY and here <= low and job.target < 0.0:
        return Refusal(ErrorId.BELOW_MINIMUM, limit_text(config, here, up=False))
    return None


def overrun(config: AxisConfig, job: Job, profile: Profile, here: float) -> Refusal | None:
    """Tell whether the way from `here` to the target leaves the software limits."""
    low, high = config.limit_min, config.limit_max
    blur = 1e-9 * (1.0 + abs(here))
    if job.kind not in (JobKind.POSITION, JobKind.VELOCITY) or (
        profile.low >= min(low, here) - blur and profile.high <= max(high, here) + blur
    ):
        return None
    reach = f"would reach {profile.low} to {profile.high}, allowed: {low} to {high} {config.unit}"
    return Refusal(ErrorId.OVERRUN, reach)


def limit_text(config: AxisConfig, here: float, *, up: bool) -> str:
    """Name the position and the limit in that direction."""
    return f"position = {here}, limit {config.limit_max if up else config.limit_min} {config.unit}"
