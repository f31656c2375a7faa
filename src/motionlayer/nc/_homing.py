"""Homing: a table of steps, with the phases of `NcToPlc.HomingState` (function-blocks 2.10; record 27).

`direct`: the present position becomes the reference position. `switch`: search the edge of the reference switch, brake,
and define the position by the distance travelled since the edge, which the drive latches; an axis that stands on the
switch searches the same edge the other way round. `cam`: search the cam, come to rest on it, leave it again, slowly as
a rule; its falling edge is the reference. `index`: the same, and the zero pulse behind the cam is the reference.

Every search has a longest way. What the table does not list leaves the homing where it is.
"""

import enum
import math
from collections.abc import Callable
from typing import Final, Protocol

from motionlayer.command import ErrorId
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

    @property
    def index_latch(self) -> float | None:
        """Position of the zero pulse that came since the latch was armed, u; None while it waits."""

    def arm_latch(self) -> None:
        """Let the drive latch the next zero pulse."""

    def search(self, velocity: float, command: AxisCommand) -> None:
        """Move with a signed velocity."""

    def brake(self, command: AxisCommand) -> None:
        """Come to rest."""

    def show_phase(self, phase: int) -> None:
        """Show the phase, `NcToPlc.HomingState`."""

    def guard(self, position: float, homing: "Homing") -> None:
        """Tell the homing when the setpoint passes a position."""

    def finish_homing(self, position: float, command: AxisCommand) -> None:
        """Redefine the position; the homing is over."""

    def fault(self, error: ErrorId, detail: str = "") -> None:
        """Put the axis in error; the homing is over."""


class Step(enum.IntEnum):
    """Where the homing is, with the number of `HomingState`; the phases 1 and 3 take no time of their own."""

    READY = 0
    SEARCH = 2
    ON_CAM = 3
    LEAVE = 4
    SYNC = 5
    BRAKE = 6


class Cue(enum.Enum):
    """What takes it on."""

    DIRECT = "begin without a switch"
    SEARCH = "begin beside the switch or the cam"
    ON_SWITCH = "begin on the switch"
    ON_CAM = "begin on the cam"
    EDGE = "the edge that is the reference"
    ON = "the cam comes on"
    OFF = "the cam goes off, and a zero pulse is to come"
    LATCHED = "zero pulse"
    REST = "at rest"
    RELEASED = "at rest, and the cam is off again"
    TOO_FAR = "the longest way of a search is over"


class Homing:
    """One homing of one axis.

    Args:
        axis: whom to move.
        command: whom to tell.
        reference: position of the reference, u.
        mode: in which way.
    """

    def __init__(self, axis: HomingAxis, command: AxisCommand, reference: float, mode: HomingMode) -> None:
        self._axis = axis
        self._command = command
        self._reference = reference
        self._mode = mode
        self._step = Step.READY
        self._on = axis.at_home_input
        self._place = math.nan

    def begin(self) -> None:
        """Start the search, or be done at once in direct mode."""
        self._command.activate()
        if self._mode is HomingMode.DIRECT:
            self._take(Cue.DIRECT)
        elif not self._on:
            self._take(Cue.SEARCH)
        else:
            self._take(Cue.ON_SWITCH if self._mode is HomingMode.SWITCH else Cue.ON_CAM)

    def input_changed(self) -> None:
        """Look for edges and for the zero pulse."""
        if self._axis.at_home_input != self._on:
            self._on = not self._on
            self._take(self._edge())
        if self._step is Step.SYNC and self._axis.index_latch is not None:
            self._take(Cue.LATCHED)

    def at_rest(self) -> None:
        """Take up that the axis has come to rest."""
        self._take(Cue.REST if self._on or self._step is Step.BRAKE else Cue.RELEASED)

    def _edge(self) -> Cue:
        """Return what the present change of the input means."""
        if self._mode is HomingMode.SWITCH:
            return Cue.EDGE
        if self._on:
            return Cue.ON
        return Cue.OFF if self._mode is HomingMode.INDEX else Cue.EDGE

    def too_far(self, step: Step) -> None:
        """Take up that the search of a step has gone its longest way."""
        if step is self._step:
            self._take(Cue.TOO_FAR)

    @property
    def step(self) -> Step:
        """Present step."""
        return self._step

    def _take(self, cue: Cue) -> None:
        found = STEPS.get((self._step, cue))
        if found is not None:
            self._step, action = found
            self._axis.show_phase(self._step)
            action(self)

    def define_here(self) -> None:
        """Let the present position be the reference."""
        self._axis.finish_homing(self._reference, self._command)

    def search(self) -> None:
        """Move towards the switch or the cam."""
        home = self._axis.config.home
        self._move(home.direction * home.velocity)

    def search_back(self) -> None:
        """Move off the switch, towards the same edge."""
        home = self._axis.config.home
        self._move(-home.direction * home.velocity)

    def leave_cam(self) -> None:
        """Move off the cam."""
        home = self._axis.config.home
        self._move(home.sync_direction * home.sync_velocity)

    def brake(self) -> None:
        """Come to rest on the cam."""
        self._axis.brake(self._command)

    def brake_behind_edge(self) -> None:
        """Note the edge and come to rest behind it."""
        self._place = self._axis.home_latch
        self._axis.brake(self._command)

    def arm_latch(self) -> None:
        """Go on, and let the next zero pulse be the reference."""
        self._axis.arm_latch()
        self._guard(self._axis.config.home.sync_direction)

    def brake_behind_pulse(self) -> None:
        """Note the zero pulse and come to rest behind it; too near to the edge it may be another one next time."""
        place, edge, least = self._axis.index_latch, self._axis.home_latch, self._axis.config.home.pulse_distance
        assert place is not None
        if abs(place - edge) < least:
            self._axis.fault(ErrorId.LATCH_TOO_CLOSE, f"{abs(place - edge)}, at least {least} {self._unit}")
            return
        self._place = place
        self._axis.brake(self._command)

    def released_early(self) -> None:
        """Give up: the cam is shorter than the brake."""
        self._axis.fault(ErrorId.CAM_RELEASED_EARLY, "the axis came to rest behind the cam")

    def define_from_place(self) -> None:
        """Define the position: reference plus what was travelled since the latched place."""
        self._axis.finish_homing(self._reference + self._axis.set_position - self._place, self._command)

    def cam_not_found(self) -> None:
        """Give up the search of the cam or the switch."""
        self._give_up(ErrorId.CAM_NOT_FOUND)

    def cam_not_left(self) -> None:
        """Give up leaving the cam."""
        self._give_up(ErrorId.CAM_NOT_LEFT)

    def pulse_not_found(self) -> None:
        """Give up the search of the zero pulse."""
        self._give_up(ErrorId.SYNC_PULSE_NOT_FOUND)

    def _give_up(self, error: ErrorId) -> None:
        self._axis.fault(error, f"within {self._axis.config.home.travel} {self._unit}")

    @property
    def _unit(self) -> str:
        return self._axis.config.unit

    def _move(self, velocity: float) -> None:
        self._axis.search(velocity, self._command)
        self._guard(math.copysign(1.0, velocity))

    def _guard(self, direction: float) -> None:
        """Bound the way of a search."""
        way = direction * self._axis.config.home.travel
        if math.isfinite(way):
            self._axis.guard(self._axis.set_position + way, self)


_H = Homing
STEPS: Final[dict[tuple[Step, Cue], tuple[Step, Callable[[Homing], None]]]] = {
    (Step.READY, Cue.DIRECT): (Step.READY, _H.define_here),
    (Step.READY, Cue.SEARCH): (Step.SEARCH, _H.search),
    (Step.READY, Cue.ON_SWITCH): (Step.LEAVE, _H.search_back),
    (Step.READY, Cue.ON_CAM): (Step.LEAVE, _H.leave_cam),
    (Step.SEARCH, Cue.EDGE): (Step.BRAKE, _H.brake_behind_edge),
    (Step.SEARCH, Cue.ON): (Step.ON_CAM, _H.brake),
    (Step.SEARCH, Cue.TOO_FAR): (Step.SEARCH, _H.cam_not_found),
    (Step.ON_CAM, Cue.REST): (Step.LEAVE, _H.leave_cam),
    (Step.ON_CAM, Cue.RELEASED): (Step.ON_CAM, _H.released_early),
    (Step.LEAVE, Cue.EDGE): (Step.BRAKE, _H.brake_behind_edge),
    (Step.LEAVE, Cue.OFF): (Step.SYNC, _H.arm_latch),
    (Step.LEAVE, Cue.TOO_FAR): (Step.LEAVE, _H.cam_not_left),
    (Step.SYNC, Cue.LATCHED): (Step.BRAKE, _H.brake_behind_pulse),
    (Step.SYNC, Cue.TOO_FAR): (Step.SYNC, _H.pulse_not_found),
    (Step.BRAKE, Cue.REST): (Step.READY, _H.define_from_place),
}
"""Per step and cue: the next step, and what it does."""
