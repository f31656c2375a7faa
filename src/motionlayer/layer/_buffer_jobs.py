"""The endless jobs MOVE_BUFFER and MOVE_BUFFER_VELO (motion-layer 5.8).

Two motions alternate, 1 and 2, so that the next one can be handed over while the one before is running; the buffer mode
decides how the axis joins them. Whoever changes the set values starts the next motion; `Ctrl.eProgress` = DONE ends the
job, and the motion that runs goes on.

D11: every change of position, velocity or dynamics counts, also after the running motion has ended. Of two motions to
the same place there is nothing to join: the new dynamics replace the old ones at once. D12: the direction counts too.
"""

from typing import TYPE_CHECKING, Final

from motionlayer.command import ErrorId
from motionlayer.event import Level, Subdevice
from motionlayer.layer._axis_job import AxisJob, aborted, fail, failed
from motionlayer.layer._job import JobTable, Transition, always, nothing
from motionlayer.layer._move_jobs import direction_of, ramps
from motionlayer.layer.types._library_kinds import NC_BUFFER_MODES
from motionlayer.layer.types._progress import Progress
from motionlayer.nc import AxisCommand, BufferMode

if TYPE_CHECKING:
    from collections.abc import Callable

_P = Progress
_POSITIONS: Final = {1: Subdevice.fbMoveAbsolute1, 2: Subdevice.fbMoveAbsolute2}
_VELOCITIES: Final = {1: Subdevice.fbMoveVelocity1, 2: Subdevice.fbMoveVelocity2}


def release(job: AxisJob) -> None:
    """Action: nothing is waited for; what runs goes on."""
    job.command = None


def commanded_end(job: AxisJob) -> bool:
    """Condition: the client ends the job."""
    return job.inputs.ctrl.progress == _P.DONE


def _free(job: AxisJob) -> bool:
    """Tell whether the buffer of the axis is free: the last motion runs already, or has ended without an error."""
    command = job.command
    return command is None or command.active or command.done


def _mode(job: AxisJob, method: str) -> BufferMode | None:
    """Return how the next motion joins; None with a refused command where there is no such mode."""
    number = job.inputs.options.buffer_mode
    mode = NC_BUFFER_MODES.get(number)
    if mode is None:
        allowed = f"eBufferMode = {int(number)}, allowed: {', '.join(str(int(one)) for one in NC_BUFFER_MODES)}"
        job.command = job.axis.refuse(method, ErrorId.MODE_INVALID, allowed)
    return mode


def tell_aborted(level: Level, part: Subdevice) -> "Callable[[AxisJob], None]":
    """Return the action that tells of a motion that somebody else has replaced; the job goes on without it."""

    def tell(job: AxisJob) -> None:
        """Action: tell, and go on without it."""
        job.tell(level, part, f"FB aborted: {job.shown}")
        release(job)

    return tell


# -- positions ---------------------------------------------------------------------------------------------------------


def _positioning(job: AxisJob) -> tuple[float, ...]:
    data = job.inputs.data
    return data.position, data.velocity, data.acceleration, data.deceleration, data.jerk


def other_position(job: AxisJob) -> bool:
    """Condition: other set values are wanted, and the axis can take them."""
    return job.latched != _positioning(job) and _free(job)


def start_position(instance: int) -> "Callable[[AxisJob], None]":
    """Return the action that starts a motion with the present set values."""
    part, follows = _POSITIONS[instance], "PROGRESS_PREPARE" if instance == 1 else "PROGRESS_OCCUPIED"

    def start(job: AxisJob) -> None:
        """Action: start a motion."""
        data, before, last = job.inputs.data, job.command, job.latched
        mode = _mode(job, "move_absolute")
        if mode is None:
            return
        arrived = isinstance(before, AxisCommand) and (not before.busy or before.at_target)
        if before is not None and (arrived or last[0] == data.position):
            mode = BufferMode.ABORTING
        job.latched = _positioning(job)
        job.tell(Level.VERBOSE, part, f"FB start : {data.position}")
        job.command = job.axis.move_absolute(data.position, velocity=data.velocity, buffer_mode=mode, **ramps(data))
        if job.command.busy:
            job.tell(Level.VERBOSE, part, f"FB busy: {follows}")

    return start


def tell_position(instance: int) -> "Callable[[AxisJob], None]":
    """Return the action that tells of the change, before the other instance takes it up."""
    part = _POSITIONS[instance]

    def tell(job: AxisJob) -> None:
        """Action: tell of the change."""
        old, new = job.latched[0], job.inputs.data.position
        job.tell(Level.VERBOSE, part, f"Position changed: {old} to {new}")

    return tell


MOVE_BUFFER: Final = JobTable[AxisJob](
    "MOVE_BUFFER",
    [
        Transition(_P.INIT, always, release, _P.BUSY),
        Transition(_P.BUSY, commanded_end, nothing, _P.DONE),
        Transition(_P.BUSY, always, nothing, _P.STARTUP),
        Transition(_P.STARTUP, always, start_position(1), _P.PREPARE),
        Transition(_P.PREPARE, commanded_end, release, _P.DONE),
        Transition(_P.PREPARE, failed, fail(_POSITIONS[1]), _P.ERROR),
        Transition(_P.PREPARE, aborted, tell_aborted(Level.VERBOSE, _POSITIONS[1]), _P.PREPARE),
        Transition(_P.PREPARE, other_position, tell_position(1), _P.CHECK),
        Transition(_P.CHECK, always, start_position(2), _P.OCCUPIED),
        Transition(_P.OCCUPIED, commanded_end, release, _P.DONE),
        Transition(_P.OCCUPIED, failed, fail(_POSITIONS[2]), _P.ERROR),
        Transition(_P.OCCUPIED, aborted, tell_aborted(Level.VERBOSE, _POSITIONS[2]), _P.OCCUPIED),
        Transition(_P.OCCUPIED, other_position, tell_position(2), _P.STARTUP),
    ],
)


# -- velocities --------------------------------------------------------------------------------------------------------


def _moving(job: AxisJob) -> tuple[float, ...]:
    data = job.inputs.data
    return data.velocity, data.direction, data.acceleration, data.deceleration, data.jerk


def other_velocity(job: AxisJob) -> bool:
    """Condition: other set values are wanted, and the axis can take them."""
    return job.latched != _moving(job) and _free(job)


def start_velocity(instance: int) -> "Callable[[AxisJob], None]":
    """Return the action that moves with the present set values."""
    part = _VELOCITIES[instance]

    def start(job: AxisJob) -> None:
        """Action: move with these values."""
        data = job.inputs.data
        mode = _mode(job, "move_velocity")
        way = None if mode is None else direction_of(job, "move_velocity")
        if mode is None or way is None:
            return
        job.latched = _moving(job)
        job.tell(Level.VERBOSE, part, f"start : {data.velocity}")
        job.command = job.axis.move_velocity(data.velocity, way, buffer_mode=mode, **ramps(data))
        if job.command.busy:
            job.tell(Level.VERBOSE, part, "FB busy: PROGRESS_WORKING")

    return start


def tell_velocity(instance: int) -> "Callable[[AxisJob], None]":
    """Return the action that tells of the change."""
    part = _VELOCITIES[instance]

    def tell(job: AxisJob) -> None:
        """Action: tell of the change."""
        job.tell(Level.VERBOSE, part, f"Velocity changed: {job.latched[0]} to {job.inputs.data.velocity}")

    return tell


MOVE_BUFFER_VELO: Final = JobTable[AxisJob](
    "MOVE_BUFFER_VELO",
    [
        Transition(_P.INIT, always, release, _P.BUSY),
        Transition(_P.BUSY, commanded_end, nothing, _P.DONE),
        Transition(_P.BUSY, always, nothing, _P.STARTUP),
        Transition(_P.STARTUP, always, start_velocity(1), _P.PREPARE),
        Transition(_P.PREPARE, commanded_end, release, _P.STILL_WORKING),
        Transition(_P.PREPARE, failed, fail(_VELOCITIES[1]), _P.ERROR),
        Transition(_P.PREPARE, aborted, tell_aborted(Level.ERROR, _VELOCITIES[1]), _P.PREPARE),
        Transition(_P.PREPARE, other_velocity, tell_velocity(1), _P.CHECK),
        Transition(_P.CHECK, always, start_velocity(2), _P.OCCUPIED),
        Transition(_P.OCCUPIED, commanded_end, release, _P.STILL_WORKING),
        Transition(_P.OCCUPIED, failed, fail(_VELOCITIES[2]), _P.ERROR),
        Transition(_P.OCCUPIED, aborted, tell_aborted(Level.ERROR, _VELOCITIES[2]), _P.OCCUPIED),
        Transition(_P.OCCUPIED, other_velocity, tell_velocity(2), _P.STARTUP),
        Transition(_P.STILL_WORKING, always, nothing, _P.DONE),
    ],
    shows=dict.fromkeys((_P.BUSY, _P.STARTUP, _P.PREPARE, _P.CHECK, _P.OCCUPIED), _P.WORKING),
)
