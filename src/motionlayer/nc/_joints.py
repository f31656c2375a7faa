"""The speed at a joint: what the buffer mode names, lowered to what the follower can brake from."""

import math
from collections.abc import Callable, Mapping
from typing import Final

from motionlayer.nc._config import AxisConfig, BufferMode
from motionlayer.nc._motion import Job, JobKind
from motionlayer.nc._through import HALVINGS
from motionlayer.nc._ways import brakeable_speed, limit_ahead, scaled
from motionlayer.profile import Limits, plan_velocity, stop_displacement

BLENDED: Final[Mapping[BufferMode, Callable[[float, float], float]]] = {
    BufferMode.BUFFERED: lambda _first, _second: 0.0,
    BufferMode.BLENDING_LOW: min,
    BufferMode.BLENDING_PREVIOUS: lambda first, _second: first,
    BufferMode.BLENDING_NEXT: lambda _first, second: second,
    BufferMode.BLENDING_HIGH: max,
}
"""Speed at the joint, from those of the running job and of the follower."""


def joint_speeds(
    config: AxisConfig, mode: BufferMode, first: Limits, heading: float, place: float, job: Job, factor: float
) -> tuple[float, float]:
    """Return the speed that a follower asks for at a joint, and the highest one from which it can go on.

    An end velocity that the override has lowered since is not a reason to refuse what was planned before.

    Args:
        config: of the axis.
        mode: not ABORTING.
        first: limits of the running job, with the override.
        heading: direction in which it arrives.
        place: position of the joint.
        job: the follower.
        factor: override.
    """
    limits = scaled(job, factor)
    asked = BLENDED[mode](first.velocity, 0.0 if job.kind is JobKind.HALT else limits.velocity)
    if asked == 0.0:
        return 0.0, math.inf
    end, slow = _way_out(config, job, heading)
    if (end - place) * heading <= 0.0:
        return 0.0, math.inf
    # Who has just been told to be slower may arrive faster than anybody asks for now.
    most = max(config.maximum.velocity, asked)
    room = abs(end - place)
    # An end velocity counts only as far as it comes to rest before the software limit behind the target.
    there = brakeable_speed(config, end, heading * most, limits) if slow > 0.0 else 0.0
    wanted = _brakeable(most, min(slow * factor, there, asked), room, limits)
    return min(asked, wanted), wanted if slow == 0.0 else max(wanted, _brakeable(most, min(slow, there), room, limits))


def _way_out(config: AxisConfig, job: Job, heading: float) -> tuple[float, float]:
    """Return up to where a follower may go in the direction of the running job, and the speed it may have there."""
    if job.kind is JobKind.POSITION:
        return job.target, 0.0
    if job.kind is JobKind.CONTINUOUS:
        return job.target, job.end_speed
    if job.kind is not JobKind.HALT and job.target * heading < 0.0:
        return -heading * math.inf, 0.0
    return limit_ahead(config, heading), 0.0


def _brakeable(most: float, end: float, room: float, limits: Limits) -> float:
    """Return the highest speed, `most` at most, from which `end` is reached within `room`."""
    if math.isinf(room) or _braking_way(most, end, limits) <= room:
        return most
    low, high = end, most
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if _braking_way(middle, end, limits) <= room:
            low = middle
        else:
            high = middle
    return low


def _braking_way(speed: float, end: float, limits: Limits) -> float:
    """Return the way from one speed down to another."""
    if end <= 0.0:
        return stop_displacement(speed, 0.0, limits.deceleration, limits.jerk)
    down = plan_velocity(0.0, speed, 0.0, min(end, speed), limits._replace(velocity=speed))
    return float(down.pieces[-1, 1])
