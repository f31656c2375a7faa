"""Homing: a table of steps.

`direct`: the present position becomes the reference position. `switch`: search the reference switch, brake, and define
the position by the distance travelled since the edge, which the drive latches. An axis that stands on the switch
searches the same edge the other way round. What the table does not list leaves the homing where it is.
"""

import enum
from collections.abc import Callable
from typing import Final, Protocol

from motionlayer.nc._config import AxisConfig, HomingMode
from motionlayer.nc._motion import AxisCommand


class HomingAxis(Protocol):
    """What a homing needs of its axis."""

    config: AxisConfig

    @property
    def set_position(self) -> float:
        """Present setpoint, u."""

    @property
    def at_home_input(self) -> bool:
        """The reference switch is on."""

    @property
    def home_latch(self) -> float:
        """Position of the last edge of the switch, u."""

    def search(self, velocity: float, command: AxisCommand) -> None:
        """Move with a signed velocity."""

    def brake(self, command: AxisCommand) -> None:
        """Come to rest."""

    def finish_homing(self, position: float, command: AxisCommand) -> None:
        """Redefine the position; the homing is over."""


class Step(enum.Enum):
    """Where the homing is."""

    READY = "ready"
    SEARCH = "search the edge"
    BRAKE = "brake behind the edge"
    DONE = "done"


class Cue(enum.Enum):
    """What takes it on."""

    DIRECT = "begin without a switch"
    SWITCH = "begin with a switch"
    EDGE = "edge of the switch"
    REST = "at rest"


class Homing:
    """One homing of one axis.

    Args:
        axis: whom to move.
        command: whom to tell.
        reference: position of the reference, u.
    """

    def __init__(self, axis: HomingAxis, command: AxisCommand, reference: float) -> None:
        self._axis = axis
        self._command = command
        self._reference = reference
        self._step = Step.READY
        self._started_on = axis.at_home_input

    def begin(self) -> None:
        """Start the search, or be done at once in direct mode."""
        self._command.activate()
        self._take(Cue.DIRECT if self._axis.config.home.mode is HomingMode.DIRECT else Cue.SWITCH)

    def input_changed(self) -> None:
        """Look for the edge."""
        if self._axis.at_home_input != self._started_on:
            self._take(Cue.EDGE)

    def at_rest(self) -> None:
        """Take up that the axis has come to rest."""
        self._take(Cue.REST)

    def _take(self, cue: Cue) -> None:
        found = STEPS.get((self._step, cue))
        if found is not None:
            self._step, action = found
            action(self)

    def define_here(self) -> None:
        """Let the present position be the reference."""
        self._axis.finish_homing(self._reference, self._command)

    def search(self) -> None:
        """Move towards the edge."""
        home = self._axis.config.home
        direction = -home.direction if self._started_on else home.direction
        self._axis.search(direction * home.velocity, self._command)

    def brake(self) -> None:
        """Come to rest behind the edge."""
        self._axis.brake(self._command)

    def define_from_edge(self) -> None:
        """Define the position: reference plus what was travelled since the edge."""
        travelled = self._axis.set_position - self._axis.home_latch
        self._axis.finish_homing(self._reference + travelled, self._command)


STEPS: Final[dict[tuple[Step, Cue], tuple[Step, Callable[[Homing], None]]]] = {
    (Step.READY, Cue.DIRECT): (Step.DONE, Homing.define_here),
    (Step.READY, Cue.SWITCH): (Step.SEARCH, Homing.search),
    (Step.SEARCH, Cue.EDGE): (Step.BRAKE, Homing.brake),
    (Step.BRAKE, Cue.REST): (Step.DONE, Homing.define_from_edge),
}
"""Per step and cue: the next step, and what it does."""
