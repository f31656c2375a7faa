"""The keywords that motion commands share, declared once.

A command names its own arguments and takes these as `**keywords: Unpack[...]`; a misspelt one is a TypeError that names
those that there are.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple, TypedDict

from motionlayer.command import only_known
from motionlayer.nc._arguments import USUAL, Asked, member, number
from motionlayer.nc._config import BufferMode
from motionlayer.nc._follower import AT_ONCE, Buffering


class RampKeywords(TypedDict, total=False):
    """How fast the velocity may change; the defaults of the axis where left out.

    Attributes:
        acceleration: at most while |v| grows, u/s².
        deceleration: at most while |v| falls, u/s².
        jerk: at most, u/s³; raised where it could not take back the present acceleration within the maxima.
    """

    acceleration: float | None
    deceleration: float | None
    jerk: float | None


class BufferKeywords(TypedDict, total=False):
    """When a command begins that is given while another one runs.

    Attributes:
        buffer_mode: see `BufferMode`; ABORTING where left out. Beside an endless motion every command begins at once.
        blending_position: where a blending mode hands over instead of at the target of the running command, u; it must
            lie before that. Passed already, the command begins at once.
    """

    buffer_mode: BufferMode
    blending_position: float | None


class JogKeywords(RampKeywords, total=False):
    """Dynamics.

    Attributes:
        velocity: at most, u/s; a default of the axis where left out.
    """

    velocity: float | None


class EndlessKeywords(RampKeywords, BufferKeywords, total=False):
    """Dynamics, and when to begin."""


class ContinuousKeywords(JogKeywords, BufferKeywords, total=False):
    """Dynamics with a velocity, and when to begin."""


class MoveKeywords(ContinuousKeywords, total=False):
    """The same, and when the command is done.

    Attributes:
        position_monitoring: done only when the actual position has come into the window of the axis too, if the axis
            has one; True where left out. False: done with the setpoint.
    """

    position_monitoring: bool


class BrakeKeywords(TypedDict, total=False):
    """How to come to rest, and when that is done.

    Attributes:
        deceleration: u/s²; that of the running command where left out. Weaker dynamics are raised to those.
        jerk: u/s³; the same.
        position_monitoring: done only when the actual position has come into the window of the axis too, if the axis
            has one; False where left out.
    """

    deceleration: float | None
    jerk: float | None
    position_monitoring: bool


class HaltKeywords(BrakeKeywords, BufferKeywords, total=False):
    """The same, and when to begin."""


class Keywords(NamedTuple):
    """The keywords of a command, checked for their types.

    Attributes:
        asked: dynamics.
        buffering: when to begin.
        monitored: whether the window of the actual position is waited for; None where left out.
    """

    asked: Asked
    buffering: Buffering
    monitored: bool | None


NONE_GIVEN: Final = Keywords(USUAL, AT_ONCE, None)


def checked(method: str, declared: type, given: Mapping[str, Any]) -> Keywords:
    """Return the keywords of a call.

    Args:
        method: for the message.
        declared: the TypedDict of the method.
        given: what the caller wrote.

    Raises:
        TypeError: there is no such keyword, or one has a value of another type.
    """
    if not given:
        return NONE_GIVEN
    only_known(method, declared, given)
    asked = given.get("velocity"), given.get("acceleration"), given.get("deceleration"), given.get("jerk")
    mode = member("buffer_mode", given.get("buffer_mode", BufferMode.ABORTING), BufferMode)
    monitored = given.get("position_monitoring")
    if not (monitored is None or isinstance(monitored, bool)):
        raise TypeError(f"position_monitoring is {monitored!r}; it must be True or False")
    return Keywords(asked, Buffering(mode, number("blending_position", given.get("blending_position"))), monitored)
