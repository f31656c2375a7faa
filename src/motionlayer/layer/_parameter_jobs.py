"""PARAMETER_READ, PARAMETER_WRITE and PARAMETER_WRITE_PERSISTENT (motion-layer 5.11).

Number and value are latched with the command. A parameter that is TRUE or FALSE travels as 1.0 or 0.0.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Final, cast

from motionlayer.command import ErrorId
from motionlayer.event import Level, Subdevice
from motionlayer.fb import PARAMETERS, write_parameter
from motionlayer.layer._axis_job import DONE, AxisJob, aborted, fail, failed, say, succeeded
from motionlayer.layer._job import JobTable, Transition, a_call_later, always, nothing
from motionlayer.layer.types._progress import Progress

if TYPE_CHECKING:
    from motionlayer.fb import MC_AxisParameter

_P = Progress
_READ: Final = Subdevice.fbReadParameter
_WRITE: Final = Subdevice.fbWriteParameter
_KEEP: Final = Subdevice.fbWriteParameterPersistent


def latch(job: AxisJob) -> None:
    """Preparation: take number and value over; what the client changes from now on is for the next command."""
    asked = job.inputs.nc_parameter_in
    job.parameter = int(asked.number), asked.value


def read(job: AxisJob) -> None:
    """Action: read the parameter, or refuse a number that there is not."""
    number, job.command = job.parameter[0], None
    parameter = PARAMETERS.get(cast("MC_AxisParameter", number))
    if parameter is None:
        job.command = job.axis.refuse("read_parameter", ErrorId.COMMAND_NOT_PERMITTED, f"ParameterNumber = {number}")
        return
    job.parameter = number, float(parameter.read(job.port.ref))


def write(job: AxisJob) -> None:
    """Action: write it; it holds at once."""
    job.command = write_parameter(job.port.ref, *job.parameter)


def write_persistent(job: AxisJob) -> None:
    """Action: write it, and keep it for the runs to come."""
    job.command = write_parameter(job.port.ref, *job.parameter, persistent=True)


def show(job: AxisJob) -> None:
    """Action: show number and value."""
    out = job.inputs.nc_parameter_out
    out.number, out.value = job.parameter


PARAMETER_READ: Final = JobTable[AxisJob](
    "PARAMETER_READ",
    [
        Transition(_P.INIT, always, read, _P.OCCUPIED),
        Transition(_P.OCCUPIED, failed, fail(_READ), _P.ERROR),
        Transition(_P.OCCUPIED, a_call_later, show, _P.WORKING),
        Transition(_P.WORKING, a_call_later, say(Level.VERBOSE, _READ, DONE), _P.DONE),
    ],
    prepare=latch,
)


def _writing(
    name: str, write_it: Callable[[AxisJob], None], part: Subdevice, written: Callable[[AxisJob], None]
) -> JobTable[AxisJob]:
    """Return the job that writes a parameter in a way, and what it does when that is done."""
    return JobTable(
        name,
        [
            Transition(_P.INIT, always, write_it, _P.OCCUPIED),
            Transition(_P.OCCUPIED, failed, fail(part, ""), _P.ERROR),
            Transition(_P.OCCUPIED, aborted, fail(part, ""), _P.ERROR),
            Transition(_P.OCCUPIED, succeeded, written, _P.WORKING),
            Transition(_P.WORKING, a_call_later, nothing, _P.DONE),
        ],
        prepare=latch,
    )


PARAMETER_WRITE: Final = _writing("PARAMETER_WRITE", write, _WRITE, show)
PARAMETER_WRITE_PERSISTENT: Final = _writing("PARAMETER_WRITE_PERSISTENT", write_persistent, _KEEP, nothing)
