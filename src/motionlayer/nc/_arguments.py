"""What a call says: numbers, members of enumerations, and dynamics with their defaults and maxima."""

import enum
import math
import numbers
from typing import Final, TypeVar

from motionlayer.command import ErrorId
from motionlayer.nc._motion import Refusal
from motionlayer.profile import RANGES, Limits


def number(name: str, value: object) -> float | None:
    """Return a float, or None for None.

    Raises:
        TypeError: it is not a number.
    """
    if value is None or type(value) is float:
        return value
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} is {value!r}, a {type(value).__name__}; it must be a number")
    try:
        return float(value)
    except OverflowError:  # an integer beyond all floats: refused as infinite
        return math.copysign(math.inf, 1.0 if value == abs(value) else -1.0)


def required(name: str, value: object) -> float:
    """Return a float.

    Raises:
        TypeError: it is not a number.
    """
    given = number(name, value)
    if given is None:
        raise TypeError(f"{name} is None; it must be a number")
    return given


E = TypeVar("E", bound=enum.Enum)


def member(name: str, value: object, of: type[E]) -> E:
    """Return a member of an enumeration.

    Raises:
        TypeError: it is none.
    """
    if not isinstance(value, of):
        allowed = ", ".join(f"{of.__name__}.{one.name}" for one in of)
        raise TypeError(f"{name} is {value!r}; it must be one of {allowed}")
    return value


Asked = tuple[float | None, float | None, float | None, float | None]
"""Velocity, acceleration, deceleration and jerk of a command; None asks for the default."""

USUAL: Final[Asked] = (None, None, None, None)

_FIELDS: Final = (
    ("velocity", ErrorId.VELOCITY, "/s"),
    ("acceleration", ErrorId.ACCELERATION, "/s²"),
    ("deceleration", ErrorId.DECELERATION, "/s²"),
    ("jerk", ErrorId.JERK, "/s³"),
)


def dynamics(
    asked: Asked,
    default: Limits,
    maximum: Limits,
    unit: str,
) -> Limits | Refusal:
    """Fill in defaults and check every value against its maximum.

    Raises:
        TypeError: a value is not a number.
    """
    if asked == USUAL:
        return default
    values = []
    for (name, error, per), value, usual, most in zip(_FIELDS, asked, default, maximum, strict=True):
        given = number(name, value)
        if given is None:
            values.append(usual)
        elif RANGES.smallest <= given <= most:
            values.append(given)
        else:
            return Refusal(error, f"{name} = {given}, allowed: {_from(given)} {name} <= {most} {unit}{per}")
    return Limits(*values)


def bad_speed(name: str, value: float | None, most: float, unit: str) -> Refusal | None:
    """Tell why a velocity cannot be asked for; None, where it is left out, can."""
    if value is None or RANGES.smallest <= value <= most:
        return None
    return Refusal(ErrorId.VELOCITY, f"{name} = {value}, allowed: {_from(value)} {name} <= {most} {unit}/s")


def _from(value: float) -> str:
    """Return the lower bound of a size as a message names it: what is plannable matters only to whom it refuses."""
    return f"{RANGES.smallest} <=" if 0.0 < value < RANGES.smallest else "0 <"
