"""`StartUp`: brings the axes up one after the other (motion-layer 1.6); a client waits for `MAIN_AXIS.eInit` = 10000.

One row per call. An axis that cannot be initialised holds the start-up at 9000; everything is called on, and as soon as
a new AXIS_INIT of this axis has succeeded the start-up goes on with the next one (D63).
"""

from typing import TYPE_CHECKING, Final

from motionlayer.event import Device, Event, Kind, Level, Subdevice
from motionlayer.layer._inputs import overwrite
from motionlayer.layer._job import Job, JobTable, Transition, always, nothing
from motionlayer.layer.types import E_AXIS_CTRL
from motionlayer.layer.types._commands import AxisCommand
from motionlayer.layer.types._progress import Progress

if TYPE_CHECKING:
    from collections.abc import Sequence

    from motionlayer.iec import InputArray, OutputArray
    from motionlayer.layer._axis import AxisController
    from motionlayer.layer.types import AxisCtrl

_P = Progress
SOURCE: Final = "MAIN_AXIS"


class StartUp(Job):
    """The start-up.

    Args:
        controllers: of the axes, in the order of their indices.
        ctrl: the command fields.
        e_init: where the progress is published.

    Attributes:
        index: of the axis that is being initialised, from 1.
    """

    def __init__(
        self,
        controllers: "Sequence[AxisController]",
        ctrl: "InputArray[AxisCtrl]",
        e_init: "OutputArray[Progress | int]",
    ) -> None:
        super().__init__(START_UP, controllers[0].memory.ledger)
        self._controllers = controllers
        self._ctrl = ctrl
        self._e_init = e_init
        self._lost: AxisCommand | int = AxisCommand.NULL
        self.index = 1

    @property
    def done(self) -> bool:
        """All axes are initialised."""
        return self.step is _P.DONE

    @property
    def controller(self) -> "AxisController":
        """That of the axis that is being initialised."""
        return self._controllers[self.index - 1]

    @property
    def count(self) -> int:
        """Axes there are."""
        return len(self._controllers)

    def go_on(self) -> None:
        """Do the work of one cycle."""
        before = self.step
        after = self.call(execute=True)
        if after is not before:
            self._e_init.value = after

    def write(self, command: AxisCommand) -> None:
        """Write the command field of the axis, whoever owns it; a command that is lost by this is told once."""
        asked = self._ctrl[self.index].cmd
        if asked == command:
            return
        if asked not in (AxisCommand.NULL, AxisCommand.INIT, self._lost):
            self._tell_lost(asked)
        overwrite(self._ctrl, self.index, cmd=command)

    def _tell_lost(self, asked: AxisCommand | int) -> None:
        self._lost = asked
        what = f"{self._ctrl.name}[{self.index}]: {E_AXIS_CTRL.iec_name(asked)}"
        text = f"{what} comes before the start-up has ended, and is overwritten by it"
        self.tell(Level.WARNING, f"{text}; wait for MAIN_AXIS.eInit = 10000 before the first command", int(asked))

    def tell(self, level: Level, text: str, code: int) -> None:
        """Write a message."""
        port = self.controller.memory.port
        event = Event(
            self.ledger.tick, level, Kind.MESSAGE, SOURCE, text, code, 0, Device.Device_MainAxis, Subdevice.MainInit
        )
        port.events.add(event)


def initialised(job: StartUp) -> bool:
    """Condition: State of the axis is AXIS_INIT + DONE."""
    return job.controller.code == AxisCommand.INIT + _P.DONE


def not_initialised(job: StartUp) -> bool:
    """Condition: State of the axis is AXIS_INIT + ERROR."""
    return job.controller.code == AxisCommand.INIT + _P.ERROR


def more(job: StartUp) -> bool:
    """Condition: there is another axis."""
    return job.index < job.count


def begin(job: StartUp) -> None:
    """Action: begin with the first axis."""
    job.index = 1


def tell_init(job: StartUp) -> None:
    """Action: say that it begins."""
    job.tell(Level.INFO, "MAIN_AXIS.eInit: PROGRESS_INIT", job.count)


def tell_done(job: StartUp) -> None:
    """Action: say that all axes are there."""
    job.tell(Level.INFO, "MAIN_AXIS.eInit: PROGRESS_DONE", job.count)


def tell_error(job: StartUp) -> None:
    """Action: say which axis is not."""
    job.tell(Level.ERROR, f"MAIN_AXIS.eInit ERROR at Index: {job.index}", job.controller.memory.error)


def write_null(job: StartUp) -> None:
    """Action: take back what stands in the command field."""
    job.tell(Level.VERBOSE, f"AxisInit Index: {job.index}", job.index)
    job.write(AxisCommand.NULL)


def write_init(job: StartUp) -> None:
    """Action: initialise."""
    job.write(AxisCommand.INIT)


def next_axis(job: StartUp) -> None:
    """Action: go on to the next axis."""
    job.index += 1


START_UP: Final = JobTable[StartUp](
    "START_UP",
    [
        Transition(_P.INVALID, always, begin, _P.INIT),
        Transition(_P.INIT, always, tell_init, _P.BUSY),
        Transition(_P.BUSY, always, nothing, _P.PREPARE),
        Transition(_P.PREPARE, always, write_null, _P.STARTUP),
        Transition(_P.STARTUP, not_initialised, tell_error, _P.ERROR),
        Transition(_P.STARTUP, initialised, nothing, _P.CHECK),
        Transition(_P.STARTUP, always, write_init, _P.STARTUP),
        Transition(_P.ERROR, initialised, nothing, _P.CHECK),
        Transition(_P.CHECK, more, next_axis, _P.PREPARE),
        Transition(_P.CHECK, always, tell_done, _P.OCCUPIED),
        Transition(_P.OCCUPIED, always, nothing, _P.DONE),
    ],
    run_through=False,
    ends=frozenset({_P.DONE}),
)
