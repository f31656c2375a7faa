"""Jobs that move once: MOVE_POS, MOVE_VELO, HALT, STOP, SEND_TO_POS (motion-layer 5.5, 5.6, 5.9).

Of the dynamics 0 asks for those of the machine file; the velocity has none to fall back on, and 0 is refused.
"""

from typing import TYPE_CHECKING, Final

from motionlayer.command import ErrorId
from motionlayer.event import Level, Subdevice
from motionlayer.layer._axis_job import DONE, AxisJob, aborted, fail, failed, say, standing, succeeded, tell_held
from motionlayer.layer._job import JobTable, Transition, a_call_later, always, nothing
from motionlayer.layer.types._progress import Progress
from motionlayer.nc import Direction

if TYPE_CHECKING:
    from motionlayer.layer.types import MoveData
    from motionlayer.nc import BrakeKeywords, RampKeywords

_P = Progress
_MOVE: Final = Subdevice.fbMovePtP
_VELOCITY: Final = Subdevice.fbMoveVelo
_SEND: Final = Subdevice.fbSendToPos

DIRECTIONS: Final = {
    0: Direction.POSITIVE,
    1: Direction.POSITIVE,
    3: Direction.NEGATIVE,
    -1: Direction.NEGATIVE,
    4: Direction.CURRENT,
}
"""What `iDirection` means; 0, its start value, is the positive direction of the library."""


def ramps(data: "MoveData") -> "RampKeywords":
    """Return the dynamics that are asked for."""
    return {
        "acceleration": data.acceleration or None,
        "deceleration": data.deceleration or None,
        "jerk": data.jerk or None,
    }


def _brakes(data: "MoveData") -> "BrakeKeywords":
    return {"deceleration": data.deceleration or None, "jerk": data.jerk or None}


def is_active(job: AxisJob) -> bool:
    """Condition: the axis works on the command, or has done so already; what it takes is active at once."""
    command = job.command
    return command is not None and (command.active or command.done)


# -- to a position -----------------------------------------------------------------------------------------------------


def target_of(job: AxisJob) -> float | None:
    """Return the position that is asked for; None with a refused command, once, where it stands for no number."""
    if not job.no_target:
        return job.inputs.data.position
    job.no_target = False
    detail = "rSetPos was not finite, and nobody has asked for 0.0; write the target again"
    job.command = job.axis.refuse("move_absolute", ErrorId.TARGET_NOT_FINITE, detail)
    return None


def start_move(job: AxisJob) -> None:
    """Action: move to the position."""
    data, target = job.inputs.data, target_of(job)
    if target is not None:
        job.tell(Level.INFO, _MOVE, f" : {target}")
        job.command = job.axis.move_absolute(target, velocity=data.velocity, **ramps(data))
        tell_held(job)


MOVE_POS: Final = JobTable[AxisJob](
    "MOVE_POS",
    [
        Transition(_P.INIT, always, start_move, _P.PREPARE),
        Transition(_P.PREPARE, is_active, say(Level.VERBOSE, _MOVE, "FB active: PROGRESS_OCCUPIED"), _P.OCCUPIED),
        Transition(_P.PREPARE, failed, fail(_MOVE), _P.ERROR),
        Transition(_P.OCCUPIED, succeeded, say(Level.VERBOSE, _MOVE, DONE), _P.DONE),
        Transition(_P.OCCUPIED, failed, fail(_MOVE), _P.ERROR),
        Transition(_P.OCCUPIED, aborted, fail(_MOVE, "FB aborted : PROGRESS_ERROR"), _P.ERROR),
    ],
    shows={_P.PREPARE: _P.OCCUPIED},
)


def start_send(job: AxisJob) -> None:
    """Action: move to the position, and remember from where."""
    data, target = job.inputs.data, target_of(job)
    job.start = job.axis.actual_position
    job.latched = (job.inputs.options.distance,)
    if target is not None:
        job.command = job.axis.move_absolute(target, velocity=data.velocity, **ramps(data))
        tell_held(job)


def far_enough(job: AxisJob) -> bool:
    """Condition: the axis has travelled more than the distance, in either direction, or the move has ended (D8)."""
    return succeeded(job) or (
        job.ledger.tick > job.since and abs(job.axis.actual_position - job.start) > job.latched[0]
    )


SEND_TO_POS: Final = JobTable[AxisJob](
    "SEND_TO_POS",
    [
        Transition(_P.INIT, always, start_send, _P.PREPARE),
        Transition(_P.PREPARE, is_active, nothing, _P.OCCUPIED),
        Transition(_P.PREPARE, failed, fail(_SEND, ""), _P.ERROR),
        Transition(_P.OCCUPIED, failed, fail(_SEND, ""), _P.ERROR),
        Transition(_P.OCCUPIED, aborted, fail(_SEND, ""), _P.ERROR),
        Transition(_P.OCCUPIED, far_enough, say(Level.VERBOSE, _SEND, DONE), _P.DONE),
    ],
    shows={_P.PREPARE: _P.OCCUPIED},
)


# -- without end -------------------------------------------------------------------------------------------------------


def direction_of(job: AxisJob, method: str) -> Direction | None:
    """Return the direction that is asked for; None with a refused command where there is no such direction."""
    number = job.inputs.data.direction
    way = DIRECTIONS.get(number)
    if way is None:
        allowed = f"iDirection = {number}, allowed: 1 positive, 3 or -1 negative, 4 current"
        job.command = job.axis.refuse(method, ErrorId.COMMAND_NOT_PERMITTED, allowed)
    return way


def start_velocity(job: AxisJob) -> None:
    """Action: move without end."""
    data = job.inputs.data
    way = direction_of(job, "move_velocity")
    if way is not None:
        job.tell(Level.INFO, _VELOCITY, f"FB start : {data.velocity}")
        job.command = job.axis.move_velocity(data.velocity, way, **ramps(data))
        tell_held(job)


def in_velocity(job: AxisJob) -> bool:
    """Condition: the axis moves at the velocity that was asked for."""
    return job.ledger.tick > job.since and job.axis.in_velocity and is_active(job)


MOVE_VELO: Final = JobTable[AxisJob](
    "MOVE_VELO",
    [
        Transition(_P.INIT, always, start_velocity, _P.OCCUPIED),
        Transition(_P.OCCUPIED, failed, fail(_VELOCITY), _P.ERROR),
        Transition(_P.OCCUPIED, aborted, fail(_VELOCITY, "FB aborted : PROGRESS_ERROR"), _P.ERROR),
        Transition(_P.OCCUPIED, in_velocity, say(Level.VERBOSE, _VELOCITY, "FB InVelocity : PROGRESS_DONE"), _P.DONE),
    ],
)


# -- to rest -----------------------------------------------------------------------------------------------------------


def no_command(job: AxisJob) -> None:
    """Action: nothing is to be braked, and a drive that is off would refuse it."""
    job.command = None


def start_halt(job: AxisJob) -> None:
    """Action: brake; another command may take over."""
    job.command = job.axis.halt(**_brakes(job.inputs.data))


def start_stop(job: AxisJob) -> None:
    """Action: brake; the axis takes no other motion until it rests."""
    job.command = job.axis.stop(**_brakes(job.inputs.data))


def rests(job: AxisJob) -> bool:
    """Condition: the brake has come to its end, or the axis does not move anyway."""
    return succeeded(job) or (standing(job) and a_call_later(job))


HALT: Final = JobTable[AxisJob](
    "HALT",
    [
        Transition(_P.INIT, always, nothing, _P.BUSY),
        Transition(_P.BUSY, standing, no_command, _P.OCCUPIED),
        Transition(_P.BUSY, always, start_halt, _P.OCCUPIED),
        Transition(_P.OCCUPIED, failed, fail(Subdevice.fbHalt), _P.ERROR),
        Transition(
            _P.OCCUPIED,
            aborted,
            say(Level.WARNING, Subdevice.fbHalt, "command aborted : PROGRESS_BUSY"),
            _P.BUSY,
        ),
        Transition(_P.OCCUPIED, rests, say(Level.VERBOSE, Subdevice.fbHalt, DONE), _P.DONE),
    ],
    shows={_P.BUSY: _P.OCCUPIED},
)

STOP: Final = JobTable[AxisJob](
    "STOP",
    [
        Transition(_P.INIT, always, nothing, _P.BUSY),
        Transition(_P.BUSY, standing, no_command, _P.OCCUPIED),
        Transition(_P.BUSY, always, start_stop, _P.OCCUPIED),
        Transition(_P.OCCUPIED, failed, fail(Subdevice.fbStop, ""), _P.ERROR),
        Transition(_P.OCCUPIED, aborted, nothing, _P.BUSY),
        Transition(_P.OCCUPIED, rests, nothing, _P.DONE),
    ],
    shows={_P.BUSY: _P.OCCUPIED},
)
