"""`McAxis`: an axis for other namespaces, with memories that nobody shares (motion-layer 1.3; D15)."""

from typing import TYPE_CHECKING, Final

from motionlayer.layer._answer import Waits
from motionlayer.layer._axis_job import AxisJob, AxisPort
from motionlayer.layer._move_jobs import HALT, STOP
from motionlayer.layer._objects import AxisObject, axis_object
from motionlayer.layer._parameter_jobs import PARAMETER_READ, PARAMETER_WRITE, PARAMETER_WRITE_PERSISTENT
from motionlayer.layer._power_jobs import DISABLE, ENABLE, RESET
from motionlayer.layer.types._progress import Progress

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF
    from motionlayer.layer._job import JobTable

TABLES: Final = (DISABLE, ENABLE, RESET, HALT, STOP, PARAMETER_READ, PARAMETER_WRITE, PARAMETER_WRITE_PERSISTENT)


class McAxis:
    """An `I_McAxis` for one caller.

    Args:
        port: to the axis.
    """

    def __init__(self, port: AxisPort) -> None:
        self._port = port
        self._jobs = {table.name: AxisJob(port, self._own()) for table in TABLES}
        for table in TABLES:
            self._jobs[table.name].take(table)

    def _own(self) -> AxisObject:
        return axis_object(self._port.index, self._port.ref.axis.name, {}, Waits())

    @property
    def axis_ref(self) -> "AXIS_REF":
        """The axis with its parameters."""
        return self._port.ref

    @property
    def position(self) -> float:
        """Actual position, u."""
        return self._port.ref.axis.actual_position

    @property
    def read_parameter_value(self) -> float:
        """What `read_parameter` has read last."""
        return self._jobs[PARAMETER_READ.name].inputs.nc_parameter_out.value

    def disable(self, *, execute: bool) -> Progress:
        """Switch the drive off."""
        return self._jobs[DISABLE.name].call(execute=execute)

    def enable(self, *, execute: bool) -> Progress:
        """Switch the drive on."""
        return self._jobs[ENABLE.name].call(execute=execute)

    def reset(self, *, execute: bool) -> Progress:
        """Clear the errors of axis and drive."""
        return self._jobs[RESET.name].call(execute=execute)

    def halt(self, deceleration: float = 0.0, jerk: float = 0.0, *, execute: bool) -> Progress:
        """Brake; 0 asks for the dynamics of the machine file."""
        return self._brake(HALT, deceleration, jerk, execute=execute)

    def stop(self, deceleration: float = 0.0, jerk: float = 0.0, *, execute: bool) -> Progress:
        """Brake; the axis takes no other motion until it rests."""
        return self._brake(STOP, deceleration, jerk, execute=execute)

    def read_parameter(self, number: int, *, execute: bool) -> Progress:
        """Read a parameter; the number is that of the call with Execute FALSE."""
        return self._parameter(PARAMETER_READ, number, 0.0, execute=execute)

    def write_parameter(self, number: int, value: float, *, execute: bool) -> Progress:
        """Write a parameter; number and value are those of the call with Execute FALSE."""
        return self._parameter(PARAMETER_WRITE, number, value, execute=execute)

    def write_parameter_persistent(self, number: int, value: float, *, execute: bool) -> Progress:
        """Write a parameter and keep it for the runs to come."""
        return self._parameter(PARAMETER_WRITE_PERSISTENT, number, value, execute=execute)

    def _brake(self, table: "JobTable[AxisJob]", deceleration: float, jerk: float, *, execute: bool) -> Progress:
        job = self._jobs[table.name]
        job.inputs.data.deceleration, job.inputs.data.jerk = deceleration, jerk
        return job.call(execute=execute)

    def _parameter(self, table: "JobTable[AxisJob]", number: int, value: float, *, execute: bool) -> Progress:
        job = self._jobs[table.name]
        job.inputs.nc_parameter_in.number, job.inputs.nc_parameter_in.value = number, value
        return job.call(execute=execute)
