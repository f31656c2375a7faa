"""Homing: a table of steps, with the phases of `NcToPlc.HomingState` (function-blocks 2.10; record 27).

`direct`: the present position becomes the reference position. `switch`: search the edge of the reference switch, brake,
and define the position by the distance travelled since the edge, which the drive latches; an axis that stands on the
switch searches the same edge the other way round. `cam`: search the cam, come to rest on it, leave it again, slowly as
a rule; its falling edge is the reference. The others: the same, and what the drive latches behind the cam is the
reference; `LATCHES` tells what that is.

A program may read the cam itself and tell its signal, which counts beside that of the drive. Nothing latches it: its
edge is where the axis is in the tick in which it is told.

Every search has a longest way. What the table does not list leaves the homing where it is.
"""

import math
from collections.abc import Callable
from typing import Final

from motionlayer.command import ErrorId
from motionlayer.nc._config import HomingMode
from motionlayer.nc._homing_port import Cue, HomingPort, Step
from motionlayer.nc._motion import AxisCommand, Moving
from motionlayer.store import Latch

LATCHES: Final = {
    HomingMode.INDEX: Latch.ZERO_PULSE,
    HomingMode.SOFTWARE_SYNC: Latch.OVERFLOW,
    HomingMode.LATCH_POSITIVE: Latch.RISING,
    HomingMode.LATCH_NEGATIVE: Latch.FALLING,
    HomingMode.SOFT_LATCH_POSITIVE: Latch.SOFT_RISING,
    HomingMode.SOFT_LATCH_NEGATIVE: Latch.SOFT_FALLING,
}
"""What the drive is asked to latch behind the cam."""


class HomeCommand(AxisCommand):
    """A homing, which a program can tell the signal of a cam that it reads itself."""

    def __init__(self, axis: Moving, name: str) -> None:
        super().__init__(axis, name)
        self.homing: Homing | None = None

    def cam(self, *, on: bool) -> None:
        """Tell whether the cam is on; it counts beside the signal of the drive. After the end it does nothing."""
        if self.homing is not None and self.busy:
            self.homing.cam_told(on=on)


class Homing:
    """One homing of one axis.

    Args:
        port: to the axis.
        command: whom to tell.
        cam: signal of a cam that the program reads.
    """

    def __init__(self, port: HomingPort, command: AxisCommand, *, cam: bool) -> None:
        self._port = port
        self._command = command
        self._mode = port.config.home.mode
        self._reference = port.config.home.position
        self._step = Step.READY
        self._cam = cam
        self._switch = port.switch()
        self._on = cam or self._switch
        self._edge_place = self._place = math.nan

    def begin(self) -> None:
        """Start the search, or be done at once in direct mode."""
        self._command.activate()
        if self._mode is HomingMode.DIRECT:
            self._take(Cue.DIRECT)
        elif not self._on:
            self._take(Cue.SEARCH)
        else:
            self._take(Cue.ON_SWITCH if self._mode is HomingMode.SWITCH else Cue.ON_CAM)

    def cam_told(self, *, on: bool) -> None:
        """Take up the signal of a cam that the program reads."""
        self._cam = on
        self.input_changed()

    def input_changed(self) -> None:
        """Look for edges and for what the drive has latched."""
        before, self._switch = self._switch, self._port.switch()
        if (self._cam or self._switch) != self._on:
            self._on = not self._on
            self._edge_place = self._port.edge() if self._switch != before else self._port.actual()
            self._take(self._edge())
        if self._step is Step.SYNC and self._port.latched() is not None:
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
        return Cue.OFF if self._mode in LATCHES else Cue.EDGE

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
            self._port.show(self._step)
            action(self)

    def define_here(self) -> None:
        """Let the present position be the reference."""
        self._port.finish(self._reference, self._command)

    def search(self) -> None:
        """Move towards the switch or the cam."""
        home = self._port.config.home
        self._move(home.direction * home.velocity)

    def search_back(self) -> None:
        """Move off the switch, towards the same edge."""
        home = self._port.config.home
        self._move(-home.direction * home.velocity)

    def leave_cam(self) -> None:
        """Move off the cam."""
        home = self._port.config.home
        self._move(home.sync_direction * home.sync_velocity)

    def brake(self) -> None:
        """Come to rest on the cam."""
        self._port.brake(self._command)

    def brake_behind_edge(self) -> None:
        """Note the edge and come to rest behind it."""
        self._place = self._edge_place
        self._port.brake(self._command)

    def arm_latch(self) -> None:
        """Go on, and let the drive latch the reference."""
        self._port.arm()
        self._guard(self._port.config.home.sync_direction)

    def brake_behind_latch(self) -> None:
        """Note what was latched and come to rest behind it; too near to the edge it may be another one next time."""
        place, edge, least = self._port.latched(), self._edge_place, self._port.config.home.pulse_distance
        assert place is not None
        if abs(place - edge) < least:
            self._port.fault(ErrorId.LATCH_TOO_CLOSE, f"{abs(place - edge):.9g}, at least {least} {self._unit}")
            return
        self._place = place
        self._port.brake(self._command)

    def released_early(self) -> None:
        """Give up: the cam is shorter than the brake."""
        self._port.fault(ErrorId.CAM_RELEASED_EARLY, "the axis came to rest behind the cam")

    def define_from_place(self) -> None:
        """Define the position: reference plus what was travelled since the latched place."""
        self._port.finish(self._reference + self._port.place() - self._place, self._command)

    def cam_not_found(self) -> None:
        """Give up the search of the cam or the switch."""
        self._give_up(ErrorId.CAM_NOT_FOUND)

    def cam_not_left(self) -> None:
        """Give up leaving the cam."""
        self._give_up(ErrorId.CAM_NOT_LEFT)

    def nothing_latched(self) -> None:
        """Give up the search of what is to be latched."""
        self._give_up(ErrorId.SYNC_PULSE_NOT_FOUND)

    def _give_up(self, error: ErrorId) -> None:
        self._port.fault(error, f"home.travel = {self._port.config.home.travel:.9g} {self._unit}")

    @property
    def _unit(self) -> str:
        return self._port.config.unit

    def _move(self, velocity: float) -> None:
        self._port.search(velocity, self._command)
        self._guard(math.copysign(1.0, velocity))

    def _guard(self, direction: float) -> None:
        """Bound the way of a search."""
        way = direction * self._port.config.home.travel
        if math.isfinite(way):
            self._port.guard(self._port.place() + way, self)


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
    (Step.SYNC, Cue.LATCHED): (Step.BRAKE, _H.brake_behind_latch),
    (Step.SYNC, Cue.TOO_FAR): (Step.SYNC, _H.nothing_latched),
    (Step.BRAKE, Cue.REST): (Step.READY, _H.define_from_place),
}
"""Per step and cue: the next step, and what it does."""
