"""Homing: a table of steps.

`direct`: the present position becomes the reference position. `switch`: search the reference switch, brake, and define
the position by the distance travelled since the edge, which the drive latches. An axis that stands on the switch
searches the same edge the other way round.
"""

import enum
from typing import TYPE_CHECKING

from motionlayer.nc._config import HomingMode

if TYPE_CHECKING:
    from motionlayer.nc._axis import Axis
    from motionlayer.nc._motion import AxisCommand


class Step(enum.Enum):
    """Where the homing is."""

    SEARCH = "search the edge"
    BRAKE = "brake behind the edge"


class Homing:
    """One homing of one axis.

    Args:
        axis: whom to move.
        command: whom to tell.
        reference: position of the reference, u.
    """

    def __init__(self, axis: "Axis", command: "AxisCommand", reference: float) -> None:
        self._axis = axis
        self._command = command
        self._reference = reference
        self._step = Step.SEARCH
        self._started_on = axis.at_home_input

    def begin(self) -> None:
        """Start the search, or be done at once in direct mode."""
        self._command.activate()
        home = self._axis.config.home
        if home.mode is HomingMode.DIRECT:
            self._axis.finish_homing(self._reference, self._command)
            return
        direction = -home.direction if self._started_on else home.direction
        self._axis.search(direction * home.velocity, self._command)

    def input_changed(self) -> None:
        """Look for the edge."""
        if self._step is Step.SEARCH and self._axis.at_home_input != self._started_on:
            self._step = Step.BRAKE
            self._axis.brake(self._command)

    def at_rest(self) -> None:
        """Define the position: reference plus what was travelled since the edge."""
        travelled = self._axis.set_position - self._axis.home_latch
        self._axis.finish_homing(self._reference + travelled, self._command)
