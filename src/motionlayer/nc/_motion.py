"""What an axis executes: the command, the job behind it, and the dynamics it asked for."""

import enum
import math
import numbers
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, NamedTuple, Protocol, TypeVar

from motionlayer.command import Command, ErrorId, Ledger
from motionlayer.event import Subdevice
from motionlayer.nc._states import AxisEvent
from motionlayer.nc._subdevices import SUBDEVICES
from motionlayer.profile import RANGES, Limits


class Moving(Protocol):
    """What a command asks its axis."""

    name: str
    ledger: Ledger

    @property
    def in_velocity(self) -> bool:
        """The setpoint moves at the commanded velocity."""

    @property
    def in_end_velocity(self) -> bool:
        """The setpoint has passed its target and moves at the end velocity."""

    @property
    def remaining_time(self) -> float:
        """Seconds until the setpoint comes to its target."""


class JobKind(enum.Enum):
    """What the motion is for; it decides what its end means."""

    __hash__ = object.__hash__  # members are single: that of `Enum` is Python code, and every command asks for it

    POSITION = "position"
    VELOCITY = "velocity"
    CONTINUOUS = "continuous"
    """Past a position with an end velocity, and on with it."""
    JOG = "jog"
    HALT = "halt"
    STOP = "stop"
    SEARCH = "search"
    BRAKE = "brake"


SCALED: Final = frozenset({JobKind.POSITION, JobKind.VELOCITY, JobKind.CONTINUOUS, JobKind.JOG, JobKind.SEARCH})
"""Kinds that the override scales, and holds at 0 %."""

TARGETED: Final = frozenset({JobKind.POSITION, JobKind.CONTINUOUS})
"""Kinds with a target position."""

BOUNDED: Final = frozenset({JobKind.VELOCITY, JobKind.CONTINUOUS, JobKind.JOG})
"""Endless kinds that come to rest on a software limit ahead."""

BRAKES: Final = frozenset({JobKind.HALT, JobKind.STOP, JobKind.BRAKE})
"""Kinds that come to rest wherever that is."""

DEFINITE: Final = frozenset({JobKind.POSITION, JobKind.HALT})
"""Kinds with an end at which a buffered command can begin."""


class Refusal(NamedTuple):
    """Why a command is not taken; becomes its error."""

    id: ErrorId
    detail: str = ""


class AxisCommand(Command[None]):
    """A command of one axis.

    Attributes:
        part: the function block that it is, for the messages about it.
        end_time: time of the run, in seconds, at which its setpoint came to the target; exact inside the cycle.
            None before.
    """

    def __init__(self, axis: Moving, name: str) -> None:
        ledger = axis.ledger
        super().__init__(f"{axis.name}.{name}", number=ledger.number(), owner=ledger.issuer)
        self.axis = axis
        self.part = SUBDEVICES.get(name, Subdevice.AxisControl)
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
    def in_end_velocity(self) -> bool:
        """The setpoint has passed the target and moves at the end velocity; False once another took over."""
        return self.active and self.axis.in_end_velocity

    @property
    def remaining_time(self) -> float:
        """Seconds until the setpoint comes to its target; 0 after, infinite where there is none yet."""
        if not self.busy:
            return 0.0
        return self.axis.remaining_time if self.active else math.inf


class HeldCommand(AxisCommand):
    """A command that lasts for as long as it is held: a stop that keeps the axis locked, a jog key.

    Args:
        axis: that executes it.
        name: of the method.
        released: told when it is let go.

    Attributes:
        held: nobody has released it.
        watched: its setpoint rests, and the actual position is waited for.
    """

    def __init__(self, axis: Moving, name: str, released: Callable[["HeldCommand"], None]) -> None:
        super().__init__(axis, name)
        self._released = released
        self.held = True
        self.watched = False

    @property
    def at_target(self) -> bool:
        """The setpoint rests, and the actual position is in its window where that is waited for."""
        return super().at_target and not self.watched

    def release(self) -> None:
        """Let go: a stop unlocks the axis once it rests, a jog brakes. Again, or after the end, it does nothing."""
        if self.held and self.busy:
            self.held = False
            self._released(self)


@dataclass(slots=True)
class Job:
    """What an axis is executing.

    Attributes:
        kind: see `JobKind`.
        target: position, or signed velocity for VELOCITY, JOG and SEARCH.
        limits: as commanded, before the override.
        command: whom to tell; None for a brake that nobody waits for.
        event: what it means for the state machine when it begins; None for parts of what has begun already.
        end_speed: magnitude of the end velocity of CONTINUOUS, before the override.
        reach: seconds since the profile began at which CONTINUOUS passes its target; infinite while it is held at 0 %.
        heading: direction in which CONTINUOUS arrives at its target; 0 before it is planned.
        passed: direction in which CONTINUOUS has passed its target, 0 before.
        monitored: its end is that of the actual position, where the axis has a window for it.
        arrived: the setpoint has come to its target, and something else is waited for: the actual position, a
            release.
        watched: the actual position is what is waited for.
        start: set position at which it began, NaN before.
    """

    kind: JobKind
    target: float
    limits: Limits
    command: AxisCommand | None
    event: AxisEvent | None = None
    end_speed: float = 0.0
    reach: float = math.inf
    heading: float = 0.0
    passed: float = 0.0
    monitored: bool = False
    arrived: bool = False
    watched: bool = False
    start: float = math.nan


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
