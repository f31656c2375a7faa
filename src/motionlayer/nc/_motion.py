"""What an axis executes: the command, and the job behind it."""

import enum
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, NamedTuple, Protocol

from motionlayer.command import Command, ErrorId, Ledger
from motionlayer.event import Subdevice
from motionlayer.nc._states import AxisEvent
from motionlayer.nc._subdevices import SUBDEVICES
from motionlayer.profile import Limits


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

    @property
    def locks(self) -> bool:
        """It is a stop that keeps its axis locked."""
        return self.kind is JobKind.STOP and isinstance(self.command, HeldCommand) and self.command.held
