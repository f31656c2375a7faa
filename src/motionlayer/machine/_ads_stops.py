"""Functions of the NC ports that bring an axis to rest (ads 8.3); each takes the dynamics that the client has sent.

A dynamic value of 0 is that of the machine file.
"""

import math
import struct
from typing import TYPE_CHECKING, Any, Final

from motionlayer.command import Command, ErrorId
from motionlayer.nc import Axis
from motionlayer.profile import Limits, stop_at

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF

DYNAMICS: Final = struct.Struct("<2d")
"""Deceleration and jerk."""

ORIENTED: Final = struct.Struct("<3d")
"""Orientation, deceleration and jerk."""


def clear_task(ref: "AXIS_REF", _data: bytes) -> Command[Any]:
    """Give up all that the axis has to do: what waits is dropped, what moves is halted."""
    return ref.axis.halt()


def emergency_stop(ref: "AXIS_REF", data: bytes) -> Command[Any]:
    """Brake with what is given, or with the maximum dynamics; what is too weak is raised by the axis."""
    deceleration, jerk = DYNAMICS.unpack(data)
    if deceleration == jerk == 0.0:
        return ref.axis.emergency_stop()
    return ref.axis.stop(deceleration=deceleration or None, jerk=jerk or None)


def parameterised_stop(ref: "AXIS_REF", data: bytes) -> Command[Any]:
    """Halt with what is given."""
    deceleration, jerk = DYNAMICS.unpack(data)
    return ref.axis.halt(deceleration=deceleration or None, jerk=jerk or None)


def oriented_stop(ref: "AXIS_REF", data: bytes) -> Command[Any]:
    """Come to rest in an orientation: the next one that is reached with these dynamics without turning back.

    On the way there the axis is not faster than it is. One that rests has nothing to be stopped.
    """
    orientation, deceleration, jerk = ORIENTED.unpack(data)
    axis, period = ref.axis, ref.axis.config.modulo.period
    if not 0.0 <= orientation < period:
        detail = f"orientation = {orientation} {axis.config.unit}, allowed: 0 and above, below {period}"
        return axis.refuse("oriented_stop", ErrorId.ORIENTED_STOP_TARGET, detail)
    if axis.set_velocity == axis.set_acceleration == 0.0:
        return axis.halt(deceleration=deceleration or None, jerk=jerk or None)
    limits = _limits(axis, deceleration, jerk)
    # Bringing the acceleration to 0 takes the velocity here, whatever is done next.
    last = axis.set_velocity + 0.5 * axis.set_acceleration * abs(axis.set_acceleration) / limits.jerk
    rest = stop_at(axis.set_position, axis.set_velocity, axis.set_acceleration, limits)
    turns = (rest - orientation) / period
    target = (math.ceil(turns) if last > 0.0 else math.floor(turns)) * period + orientation
    highest = axis.config.maximum.velocity
    return axis.move_absolute(
        target,
        velocity=min(abs(last) / axis.override, highest) if last and axis.override else highest,
        deceleration=deceleration or None,
        jerk=jerk or None,
    )


def _limits(axis: Axis, deceleration: float, jerk: float) -> Limits:
    """Return the limits of a stop; a value that is none is left to the axis to be refused."""
    maximum, default = axis.config.maximum, axis.config.default
    return default._replace(
        deceleration=deceleration if 0.0 < deceleration <= maximum.deceleration else default.deceleration,
        jerk=jerk if 0.0 < jerk <= maximum.jerk else default.jerk,
    )
