"""What an axis executes: the command, the job behind it, and the dynamics it asked for."""

import enum
import math
import numbers
from dataclasses import dataclass
from typing import Final, NamedTuple, Protocol

from motionlayer.command import Command, ErrorId, Ledger
from motionlayer.profile import Limits


class Moving(Protocol):
    """What a command asks its axis."""

    name: str
    ledger: Ledger

    @property
    def in_velocity(self) -> bool:
        """The setpoint moves at the commanded velocity."""

    @property
    def remaining_time(self) -> float:
        """Seconds until the setpoint comes to its target."""


class JobKind(enum.Enum):
    """What the motion is for; it decides what its end means."""

    POSITION = "position"
    VELOCITY = "velocity"
    HALT = "halt"
    STOP = "stop"
    SEARCH = "search"
    BRAKE = "brake"


SCALED: Final = frozenset({JobKind.POSITION, JobKind.VELOCITY, JobKind.SEARCH})
"""Kinds that the override scales, and holds at 0 %."""


class Refusal(NamedTuple):
    """Why a command is not taken; becomes its error."""

    id: ErrorId
    detail: str = ""


class AxisCommand(Command[None]):
    """A command of one axis.

    Attributes:
        end_time: time of the run, in seconds, at which its setpoint came to the target; exact inside the cycle.
            None before.
    """

    def __init__(self, axis: Moving, name: str) -> None:
        ledger = axis.ledger
        super().__init__(f"{axis.name}.{name}", number=ledger.number(), owner=ledger.issuer)
        self.axis = axis
        self.end_time: float | None = None

    @property
    def at_target(self) -> bool:
        """The setpoint has come to the target."""
        return self.end_time is not None

    @property
    def in_velocity(self) -> bool:
        """The setpoint moves at the commanded velocity, without acceleration; False once another took over."""
        return self.active and self.axis.in_velocity

    @property
    def remaining_time(self) -> float:
        """Seconds until the setpoint comes to its target; 0 after, infinite where there is none yet."""
        if not self.busy:
            return 0.0
        return self.axis.remaining_time if self.active else math.inf


@dataclass(slots=True)
class Job:
    """What an axis is executing.

    Attributes:
        kind: see `JobKind`.
        target: position, or signed velocity for VELOCITY and SEARCH.
        limits: as commanded, before the override.
        command: whom to tell; None for a brake that nobody waits for.
        arrived: the setpoint has come to its target, the actual position is waited for.
    """

    kind: JobKind
    target: float
    limits: Limits
    command: AxisCommand | None
    arrived: bool = False


def number(name: str, value: float | None) -> float | None:
    """Return a float.

    Raises:
        TypeError: it is not a number.
    """
    if value is None or type(value) is float:
        return value
    given: object = value
    if isinstance(given, bool) or not isinstance(given, numbers.Real):
        raise TypeError(f"{name} is {value!r}, a {type(value).__name__}; it must be a number")
    try:
        return float(given)
    except OverflowError:  # an integer beyond all floats: refused as infinite
        return math.inf if value > 0 else -math.inf


def least_jerk(v: float, a: float, maximum: Limits) -> float:
    """Return the least jerk that takes the acceleration back within the maxima of the axis.

    With less, bringing `a` to zero would carry |v| beyond the maximum velocity, or, after a reversal, |a| beyond the
    maximum acceleration: along constant jerk a² changes by 2J per velocity. It never exceeds what got the axis into
    (v, a).
    """
    if a == 0.0:
        return 0.0
    room = maximum.velocity - math.copysign(v, v * a)
    needed = a * a / (2.0 * room) if room > 0.0 else maximum.jerk
    if v * a < 0.0:
        needed = max(needed, (a * a - maximum.acceleration * maximum.acceleration) / (2.0 * abs(v)))
    return min(needed, maximum.jerk)


_FIELDS: Final = (
    ("velocity", ErrorId.VELOCITY, "/s"),
    ("acceleration", ErrorId.ACCELERATION, "/s²"),
    ("deceleration", ErrorId.DECELERATION, "/s²"),
    ("jerk", ErrorId.JERK, "/s³"),
)


def dynamics(
    asked: tuple[float | None, float | None, float | None, float | None],
    default: Limits,
    maximum: Limits,
    unit: str,
) -> Limits | Refusal:
    """Fill in defaults and check every value against its maximum.

    Raises:
        TypeError: a value is not a number.
    """
    values = []
    for (name, error, per), value, usual, most in zip(_FIELDS, asked, default, maximum, strict=True):
        given = number(name, value)
        if given is None:
            values.append(usual)
        elif 0.0 < given <= most:
            values.append(given)
        else:
            return Refusal(error, f"{name} = {given}, allowed: 0 < {name} <= {most} {unit}{per}")
    return Limits(*values)
