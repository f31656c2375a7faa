"""The endless jobs MOVE_BUFFER and MOVE_BUFFER_VELO (motion-layer 5.8).

Two motions alternate, 1 and 2, so that the next one can be handed over while the one before is running; the buffer mode
decides how the axis joins them. Whoever changes the set values starts the next motion; `Ctrl.eProgress` = DONE ends the
job, and the motion that runs goes on.

D11: every change of position, velocity or dynamics counts, also after the running motion has ended. Of two motions to
the same place there is nothing to join: the new dynamics replace the old ones at once. D12: the direction counts too.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

from motionlayer.command import ErrorId
from motionlayer.event import Level, Subdevice
from motionlayer.layer._axis_job import AxisJob, aborted, fail, failed, succeeded, tell_held
from motionlayer.layer._job import JobTable, Transition, always, nothing
from motionlayer.layer._move_jobs import direction_of, in_velocity, ramps, target_of
from motionlayer.layer.types._library_kinds import NC_BUFFER_MODES
from motionlayer.layer.types._progress import Progress
from motionlayer.nc import AxisCommand, BufferMode

_P = Progress


@dataclass(frozen=True, slots=True)
class _Kind:
    """What makes the difference between positions and velocities.

    Attributes:
        method: that starts a motion, for messages.
        value: what the first set value is, for messages.
        starts: begins the message that a motion starts.
        parts: who speaks in messages, by instance.
        aborted: level of the message that somebody else has replaced the motion.
        wanted: returns the set values of the client.
        move: starts a motion with the present set values in a buffer mode; None where they are refused.
        arrived: condition: the motion has come to its position or velocity.
        end: step that the client's end leads to.
        shows: see `JobTable`.
    """

    method: str
    value: str
    starts: str
    parts: tuple[Subdevice, Subdevice]
    aborted: Level
    wanted: Callable[[AxisJob], tuple[float, ...]]
    move: Callable[[AxisJob, BufferMode], AxisCommand | None]
    arrived: Callable[[AxisJob], bool]
    end: Progress
    shows: Mapping[Progress, Progress]

    def other_values(self, job: AxisJob) -> bool:
        """Condition: other set values are wanted, and the axis can take them."""
        return job.latched != self.wanted(job) and _free(job)

    def newly_arrived(self, job: AxisJob) -> bool:
        """Condition: the motion has come to its position or velocity, which was not told yet."""
        return job.told is not job.command and self.arrived(job)


# -- positions ---------------------------------------------------------------------------------------------------------


def _positioning(job: AxisJob) -> tuple[float, ...]:
    data = job.inputs.data
    return data.position, data.velocity, data.acceleration, data.deceleration, data.jerk


def _move_absolute(job: AxisJob, mode: BufferMode) -> AxisCommand | None:
    """Move to the position; an axis that is there already, or on its way there, has nothing to join."""
    data, before, target = job.inputs.data, job.command, target_of(job)
    if target is None:
        return None
    there = isinstance(before, AxisCommand) and (not before.busy or before.at_target)
    if before is not None and (there or job.latched[0] == target):
        mode = BufferMode.ABORTING
    return job.axis.move_absolute(target, velocity=data.velocity, buffer_mode=mode, **ramps(data))


POSITIONS: Final = _Kind(
    method="move_absolute",
    value="Position",
    starts="FB start",
    parts=(Subdevice.fbMoveAbsolute1, Subdevice.fbMoveAbsolute2),
    aborted=Level.VERBOSE,
    wanted=_positioning,
    move=_move_absolute,
    arrived=succeeded,
    end=_P.DONE,
    shows={},
)

# -- velocities --------------------------------------------------------------------------------------------------------


def _moving(job: AxisJob) -> tuple[float, ...]:
    data = job.inputs.data
    return data.velocity, data.direction, data.acceleration, data.deceleration, data.jerk


def _move_velocity(job: AxisJob, mode: BufferMode) -> AxisCommand | None:
    """Move in the direction that is asked for; a direction that there is not is refused."""
    data, way = job.inputs.data, direction_of(job, VELOCITIES.method)
    return None if way is None else job.axis.move_velocity(data.velocity, way, buffer_mode=mode, **ramps(data))


VELOCITIES: Final = _Kind(
    method="move_velocity",
    value="Velocity",
    starts="start",
    parts=(Subdevice.fbMoveVelocity1, Subdevice.fbMoveVelocity2),
    aborted=Level.ERROR,
    wanted=_moving,
    move=_move_velocity,
    arrived=in_velocity,
    end=_P.STILL_WORKING,
    shows=dict.fromkeys((_P.BUSY, _P.STARTUP, _P.PREPARE, _P.CHECK, _P.OCCUPIED), _P.WORKING),
)

# -- conditions and actions of both ------------------------------------------------------------------------------------


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


def _start(kind: _Kind, part: Subdevice, follows: Progress) -> Callable[[AxisJob], None]:
    """Return the action that starts a motion with the present set values, or refuses them."""
    busy = f"FB busy: PROGRESS_{kind.shows.get(follows, follows).name}"

    def start(job: AxisJob) -> None:
        """Action: start a motion."""
        number, wanted = job.inputs.options.buffer_mode, kind.wanted(job)
        mode = NC_BUFFER_MODES.get(number)
        if mode is None:
            allowed = f"eBufferMode = {int(number)}, allowed: {', '.join(str(int(one)) for one in NC_BUFFER_MODES)}"
            job.command = job.axis.refuse(kind.method, ErrorId.MODE_INVALID, allowed)
            return
        job.tell(Level.VERBOSE, part, f"{kind.starts} : {wanted[0]}")
        command = kind.move(job, mode)
        job.latched = wanted
        if command is not None:
            job.command = command
            if command.busy:
                job.tell(Level.VERBOSE, part, busy)
                tell_held(job)

    return start


def _tell_change(kind: _Kind, part: Subdevice) -> Callable[[AxisJob], None]:
    def tell_change(job: AxisJob) -> None:
        """Action: tell of the change."""
        job.tell(Level.VERBOSE, part, f"{kind.value} changed: {job.latched[0]} to {kind.wanted(job)[0]}")

    return tell_change


def _tell_aborted(kind: _Kind, part: Subdevice) -> Callable[[AxisJob], None]:
    """Return the action that tells of a motion that somebody else has replaced; the job goes on without it."""

    def tell_aborted(job: AxisJob) -> None:
        """Action: tell, and go on without it."""
        job.tell(kind.aborted, part, f"FB aborted: {job.shown}")
        release(job)

    return tell_aborted


def _tell_arrived(part: Subdevice) -> Callable[[AxisJob], None]:
    def tell_arrived(job: AxisJob) -> None:
        """Action: tell, once."""
        job.told = job.command
        job.tell(Level.VERBOSE, part, f"FB done: {job.shown}")

    return tell_arrived


# -- the tables --------------------------------------------------------------------------------------------------------


def _watch(kind: _Kind, instance: int, step: Progress, other: Progress) -> list[Transition[AxisJob]]:
    """Return the rows that watch an instance in its step, until the other one takes over in its own."""
    part = kind.parts[instance - 1]
    return [
        Transition(step, commanded_end, release, kind.end),
        Transition(step, failed, fail(part), _P.ERROR),
        Transition(step, aborted, _tell_aborted(kind, part), step),
        Transition(step, kind.other_values, _tell_change(kind, part), other),
        Transition(step, kind.newly_arrived, _tell_arrived(part), step),
    ]


def _alternating(name: str, kind: _Kind, *rows: Transition[AxisJob]) -> JobTable[AxisJob]:
    """Return the job; `rows` follow its end."""
    first, second = kind.parts
    return JobTable(
        name,
        [
            Transition(_P.INIT, always, release, _P.BUSY),
            Transition(_P.BUSY, commanded_end, nothing, _P.DONE),
            Transition(_P.BUSY, always, nothing, _P.STARTUP),
            Transition(_P.STARTUP, always, _start(kind, first, _P.PREPARE), _P.PREPARE),
            *_watch(kind, 1, _P.PREPARE, _P.CHECK),
            Transition(_P.CHECK, always, _start(kind, second, _P.OCCUPIED), _P.OCCUPIED),
            *_watch(kind, 2, _P.OCCUPIED, _P.STARTUP),
            *rows,
        ],
        shows=kind.shows,
    )


MOVE_BUFFER: Final = _alternating("MOVE_BUFFER", POSITIONS)
MOVE_BUFFER_VELO: Final = _alternating(
    "MOVE_BUFFER_VELO", VELOCITIES, Transition(_P.STILL_WORKING, always, nothing, _P.DONE)
)
