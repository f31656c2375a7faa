"""`Selector`: the parameter selector, which reads and writes parameters beside the command fields (motion-layer 5.12).

It has a memory of its own (D15), so that it and the command field of an axis can work on the same axis at once.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from motionlayer.event import Device, Event, Kind, Level, Subdevice
from motionlayer.layer._axis_job import AxisJob, AxisPort
from motionlayer.layer._axis_jobs import AXIS_JOBS
from motionlayer.layer._controller import Choice, Controller
from motionlayer.layer._objects import AxisObject, axis_object
from motionlayer.layer.types import E_AXIS_CTRL
from motionlayer.layer.types._axis_kinds import AxisSelector
from motionlayer.layer.types._commands import AxisCommand
from motionlayer.layer.types._progress import Progress

if TYPE_CHECKING:
    from motionlayer.iec import InputArray, OutputArray
    from motionlayer.layer._answer import Waits
    from motionlayer.layer.types import SelectorCtrl, SelectorState

COMMANDS: Final = (
    AxisCommand.PARAMETER_READ,
    AxisCommand.PARAMETER_WRITE,
    AxisCommand.PARAMETER_WRITE_PERSISTENT,
)
"""What it takes; any other number shows 0."""

PIECE: Final = 40
"""Characters of each part of a message (8.7)."""


@dataclass(frozen=True, slots=True)
class _Resolved:
    """The axis that is meant, None for none; index and id as they are shown."""

    port: AxisPort | None
    index: int
    axis_id: int


class Selector(Controller):
    """The parameter selector.

    Args:
        ports: the axes.
        ctrl: `GVL_AXIS.SelectorCtrl`.
        state: `GVL_AXIS.SelectorState`.
        waits: of the layer.

    Attributes:
        active: a job is under way, or an end not yet published.
    """

    def __init__(
        self,
        ports: Sequence[AxisPort],
        ctrl: "InputArray[SelectorCtrl]",
        state: "OutputArray[SelectorState]",
        waits: "Waits",
    ) -> None:
        self._ports = ports
        self._written = ctrl
        self._ctrl = ctrl.value
        self._shows = state.value
        self._waits = waits
        self.memory = self._memory(ports[0])
        super().__init__(self.memory)
        self.active = False

    def _memory(self, port: AxisPort) -> AxisJob:
        """Return the memory of a job of an axis."""
        return AxisJob(port, self._objects(port))

    def _objects(self, port: AxisPort) -> AxisObject:
        return axis_object(port.index, port.ref.axis.name, {"nc_parameter_in": self._ctrl.data}, self._waits)

    def cycle(self) -> None:
        """Do the work of one cycle."""
        self._written.take()
        self.active = self.call()
        if self.active:
            info, (number, value) = self._shows.info, self.memory.parameter
            info.number, info.value = number, value

    @property
    def state(self) -> int:
        """What is published; 0 without a command."""
        return 0 if self.result is Progress.INVALID else self._number + self.result

    def asked(self) -> int:
        """Return what the command field holds."""
        return self._ctrl.control.cmd

    def choose(self, command: int) -> Choice:
        """Find the axis, and return the job."""
        found = self._resolve()
        self._shows.axis_index, self._shows.axis_id = found.index, found.axis_id
        if command not in COMMANDS:
            return Choice(Progress.INVALID)
        if found.port is None:
            return Choice(Progress.ERROR, 0)
        self.job = self.memory = self._memory(found.port)
        self.memory.name = E_AXIS_CTRL.iec_name(command)
        return Choice(AXIS_JOBS[command])

    def _resolve(self) -> _Resolved:
        number, ports = self._ctrl.axis, self._ports
        if self._ctrl.selector == AxisSelector.INDEX:
            if 1 <= number <= len(ports):
                return _Resolved(ports[number - 1], number, _id_of(ports[number - 1]))
            return _Resolved(None, number, 0)
        if self._ctrl.selector == AxisSelector.AXIS_ID:
            found = [port for port in ports if _id_of(port) == number]
            if found:
                return _Resolved(found[-1], found[-1].index, number)
        return _Resolved(None, 0, 0)

    def publish(self, state: int, result: Progress) -> None:  # noqa: ARG002 - the state says all
        """Write the state field."""
        self._shows.state.state = state

    def tell_command(self, command: int) -> None:
        """Log that a command has come."""
        self._tell(f"new command: E_AXIS_CTRL.{E_AXIS_CTRL.iec_name(command)[:PIECE]}")

    def changed(self, result: Progress) -> None:
        """Log the progress."""
        name = E_AXIS_CTRL.iec_name(self.command)[:PIECE]
        self._tell(f"E_AXIS_CTRL.{name}: E_PROGRESS.PROGRESS_{result.name}")

    def _tell(self, text: str) -> None:
        device, part = Device.Device_ParameterSelector, Subdevice.General
        tick, code = self.memory.ledger.tick, self._shows.axis_index
        event = Event(tick, Level.INFO, Kind.MESSAGE, self._written.name, text, code, 0, device, part)
        self.memory.port.events.add(event)


def _id_of(port: AxisPort) -> int:
    """Return the id of an axis in the NC."""
    return int(port.ref.NcToPlc.AxisId)
