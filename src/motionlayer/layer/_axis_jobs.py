"""What every command of an axis is: the table of its job (motion-layer 5.5)."""

from collections.abc import Mapping
from typing import Final

from motionlayer.command import ErrorId
from motionlayer.layer._axis_job import AxisJob
from motionlayer.layer._buffer_jobs import MOVE_BUFFER, MOVE_BUFFER_VELO
from motionlayer.layer._home_job import HOME
from motionlayer.layer._job import JobTable, Transition, always
from motionlayer.layer._move_jobs import HALT, MOVE_POS, MOVE_VELO, SEND_TO_POS, STOP
from motionlayer.layer._parameter_jobs import PARAMETER_READ, PARAMETER_WRITE, PARAMETER_WRITE_PERSISTENT
from motionlayer.layer._power_jobs import DISABLE, ENABLE, IDLE, INIT, RESET
from motionlayer.layer.types._commands import AxisCommand
from motionlayer.layer.types._progress import Progress


def not_ready(job: AxisJob) -> None:
    """Action: show why nothing was done."""
    job.error = ErrorId.NOT_READY


NO_INIT: Final = JobTable[AxisJob]("NO_INIT", [Transition(Progress.INIT, always, not_ready, Progress.ERROR)])
"""A command that comes before AXIS_INIT is done: 1009, then 9009."""

AXIS_JOBS: Final[Mapping[int, JobTable[AxisJob]]] = {
    AxisCommand.INIT: INIT,
    AxisCommand.DISABLE: DISABLE,
    AxisCommand.ENABLE: ENABLE,
    AxisCommand.IDLE: IDLE,
    AxisCommand.HOME: HOME,
    AxisCommand.MOVE_POS: MOVE_POS,
    AxisCommand.MOVE_VELO: MOVE_VELO,
    AxisCommand.HALT: HALT,
    AxisCommand.STOP: STOP,
    AxisCommand.SEND_TO_POS: SEND_TO_POS,
    AxisCommand.RESET: RESET,
    AxisCommand.MOVE_BUFFER: MOVE_BUFFER,
    AxisCommand.MOVE_BUFFER_VELO: MOVE_BUFFER_VELO,
    AxisCommand.PARAMETER_READ: PARAMETER_READ,
    AxisCommand.PARAMETER_WRITE: PARAMETER_WRITE,
    AxisCommand.PARAMETER_WRITE_PERSISTENT: PARAMETER_WRITE_PERSISTENT,
}
"""The other commands of `AxisCommand` belong to cams, saws and couplings, and do not exist for an axis alone."""
