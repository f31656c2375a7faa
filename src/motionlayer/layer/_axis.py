"""`AxisController`: the command field of an axis (motion-layer 5.2)."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer.command import ErrorId
from motionlayer.event import Level, Subdevice
from motionlayer.layer._axis_job import AxisJob, AxisPort
from motionlayer.layer._axis_jobs import AXIS_JOBS, NO_INIT
from motionlayer.layer._controller import LARGEST, Choice, Controller
from motionlayer.layer._objects import AxisObject
from motionlayer.layer.info import Flag
from motionlayer.layer.types import E_AXIS_CTRL
from motionlayer.layer.types._commands import NO_INIT as NO_INIT_STATE
from motionlayer.layer.types._commands import AxisCommand
from motionlayer.layer.types._progress import Progress

_CONTROL: Final = Subdevice.AxisControl
_CLEARS: Final = frozenset({AxisCommand.INIT, AxisCommand.IDLE})
"""Commands that leave an axis without error when they are done (D14)."""


class AxisController(Controller):
    """The command field of one axis, and what its State and Info show of it.

    Args:
        port: to the axis.
        objects: its structures in `GVL_AXIS`.
        flags: of all axes, see `Flag`.
        errors: number of the error of all axes' jobs, 0 without.

    Attributes:
        initialised: AXIS_INIT is done.
        memory: of the command field.
        place: of the axis among all, from 0.
    """

    __slots__ = (
        "_ctrl", "_errors", "_flags", "_port", "_state", "_unknown", "initialised", "memory", "place",
    )  # fmt: skip

    def __init__(
        self, port: AxisPort, objects: AxisObject, flags: NDArray[np.int64], errors: NDArray[np.int64]
    ) -> None:
        self.memory = AxisJob(port, objects)
        super().__init__(self.memory)
        self.initialised = False
        self._unknown = False
        self._port = port
        self._ctrl = objects.ctrl
        self._state = objects.state.view
        self._flags = flags
        self._errors = errors
        self.place = port.index - 1

    @property
    def code(self) -> int:
        """State as published."""
        return int(self._state.state)

    def asked(self) -> int:
        """Return what the command field holds."""
        return self._ctrl.cmd

    def choose(self, command: int) -> Choice:
        """Return the job of a command; what does not exist is answered at once (D65)."""
        self._flag(off=Flag.TIMEOUT | (Flag.ERROR if command == AxisCommand.RESET else 0))
        self._errors[self.place] = 0
        self.memory.name = E_AXIS_CTRL.iec_name(command)
        if command == AxisCommand.NULL:
            self._flag(off=Flag.REQUESTED)
            return Choice(Progress.DONE if self.initialised else Progress.INVALID)
        self._flag(Flag.REQUESTED)
        if command == AxisCommand.INIT:
            self.initialised = False
            self._flag(off=Flag.INITIALISED)
        elif not self.initialised:
            return Choice(NO_INIT, NO_INIT_STATE)
        job = AXIS_JOBS.get(command)
        if job is not None:
            return Choice(job)
        self.memory.error = ErrorId.FUNCTION_UNSUPPORTED
        if isinstance(command, AxisCommand):
            return Choice(Progress.NOT_EXIST)
        self._unknown = True
        return Choice(Progress.ERROR, command if command <= LARGEST else 0)

    def publish(self, state: int, result: Progress) -> None:
        """Write State, and what Info shows of an end."""
        self._state.state = state
        if result is Progress.ERROR or result is Progress.NOT_EXIST:
            timeout = Flag.TIMEOUT if self.memory.timed_out else 0
            self._flag(Flag.ERROR | timeout, off=Flag.REQUESTED)
            self._errors[self.place] = self.memory.error
        elif result is Progress.DONE:
            self._flag(off=Flag.REQUESTED)

    def tell_command(self, command: int) -> None:
        """Log that a command has come, and whether there is such a command at all."""
        name = f"E_AXIS_CTRL.{E_AXIS_CTRL.iec_name(command)}"
        self._tell(Level.INFO, f"new command: {name}", self._port.index)
        if self._unknown:
            self._unknown = False
            self._tell(Level.ERROR, f"{name}: PROGRESS_INVALID", 0)

    def changed(self, result: Progress) -> None:
        """Log the progress; an axis that is done with AXIS_INIT or AXIS_IDLE is without error."""
        self._tell(Level.INFO, f"E_AXIS_CTRL.{self.memory.name}: PROGRESS_{result.name}", self._port.index)
        if result is Progress.DONE and self.command in _CLEARS:
            self._flag(off=Flag.ERROR)
            if self.command == AxisCommand.INIT:
                self.initialised = True
                self._flag(Flag.INITIALISED)

    def _flag(self, on: int = 0, *, off: int = 0) -> None:
        self._flags[self.place] = int(self._flags[self.place]) & ~off | on

    def _tell(self, level: Level, text: str, code: int) -> None:
        self.memory.tell(level, _CONTROL, text, code)
