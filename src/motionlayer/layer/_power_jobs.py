"""Jobs that switch, clear errors and initialise: INIT, DISABLE, ENABLE, IDLE, RESET (motion-layer 5.5, 5.6).

Each takes at most the layer's time-out per step (D6).
"""

from collections.abc import Callable
from typing import Final

from motionlayer.event import Level, Subdevice
from motionlayer.layer._axis_job import (
    DONE,
    AxisJob,
    fail,
    in_error,
    late,
    lost,
    reset,
    say,
    succeeded,
    time_out,
)
from motionlayer.layer._job import JobTable, Transition, a_call_later, always, nothing
from motionlayer.layer.types._axis_kinds import AxisEncoderType
from motionlayer.layer.types._progress import Progress

Action = Callable[[AxisJob], object]

_P = Progress
_POWER: Final = Subdevice.fbPower
_START: Final = Subdevice.AxisStartUp

NO_NAME: Final = "NO NAME"
"""Device name of a drive that has none to be read: a simulated one."""


def enable(job: AxisJob) -> None:
    """Action: switch the drive on, both directions released."""
    job.command = job.axis.enable()


def disable(job: AxisJob) -> None:
    """Action: switch the drive off; an axis in motion comes to rest first."""
    job.command = job.axis.disable()


def clear_before_enable(job: AxisJob) -> None:
    """Action: clear the error; an axis in error is not switched on."""
    job.tell(Level.VERBOSE, _POWER, f"clear error on enable : {job.shown}")
    reset(job)


def clear_before_disable(job: AxisJob) -> None:
    """Action: clear the error before it is switched off."""
    job.tell(Level.VERBOSE, _POWER, f"clear error on disable : {job.shown}")
    reset(job)


def give_up_enable(job: AxisJob) -> None:
    """Action: take the request back, so that the drive does not come on when nobody waits for it any more."""
    _too_late(job)
    job.axis.disable()


_too_late: Final = time_out(_POWER, "")


def _switching(name: str, clear: Action, switch: Action, give_up: Action) -> JobTable[AxisJob]:
    """Return the job that switches power on or off, and clears an error before it does."""
    return JobTable(
        name,
        [
            Transition(_P.INIT, in_error, clear, _P.PREPARE),
            Transition(_P.INIT, always, switch, _P.OCCUPIED),
            Transition(_P.PREPARE, succeeded, switch, _P.OCCUPIED),
            Transition(_P.PREPARE, lost, fail(_POWER, ""), _P.ERROR),
            Transition(_P.PREPARE, late, _too_late, _P.ERROR),
            Transition(_P.OCCUPIED, succeeded, say(Level.VERBOSE, _POWER, DONE), _P.DONE),
            Transition(_P.OCCUPIED, lost, fail(_POWER, ""), _P.ERROR),
            Transition(_P.OCCUPIED, late, give_up, _P.ERROR),
        ],
        shows={_P.PREPARE: _P.OCCUPIED},
    )


ENABLE: Final = _switching("ENABLE", clear_before_enable, enable, give_up_enable)
DISABLE: Final = _switching("DISABLE", clear_before_disable, disable, _too_late)

RESET: Final = JobTable[AxisJob](
    "RESET",
    [
        Transition(_P.INIT, always, reset, _P.OCCUPIED),
        Transition(_P.OCCUPIED, succeeded, say(Level.VERBOSE, Subdevice.fbReset, DONE), _P.DONE),
        Transition(_P.OCCUPIED, lost, fail(Subdevice.fbReset, ""), _P.ERROR),
        Transition(_P.OCCUPIED, late, time_out(Subdevice.fbReset, ""), _P.ERROR),
    ],
)


# -- AXIS_IDLE ---------------------------------------------------------------------------------------------------------


def forget_attempts(job: AxisJob) -> None:
    """Preparation: begin to count."""
    job.attempts = 0


def attempt(job: AxisJob) -> None:
    """Action: clear all errors, once more."""
    job.attempts += 1
    reset(job)


def trouble(job: AxisJob) -> bool:
    """Condition: the present part of an attempt has not come about (D7)."""
    return lost(job) or late(job)


def last_trouble(job: AxisJob) -> bool:
    """Condition: the last attempt that is allowed has not come about either."""
    return trouble(job) and job.attempts > job.port.max_retry


def count_trouble(job: AxisJob) -> None:
    """Action: say what is wrong with this attempt."""
    late_alone = not lost(job)
    (time_out if late_alone else fail)(Subdevice.AxisIdle, f"{job.name} error axis enable: {job.port.index}")(job)


def retry(job: AxisJob) -> None:
    """Action: begin again."""
    job.tell(Level.INFO, Subdevice.AxisIdle, f"{job.name} retry: {job.attempts}", job.error)
    job.error, job.timed_out = 0, False
    attempt(job)


IDLE: Final = JobTable[AxisJob](
    "IDLE",
    [
        Transition(_P.INIT, always, attempt, _P.BUSY),
        Transition(_P.BUSY, succeeded, enable, _P.CHECK),
        Transition(_P.BUSY, last_trouble, count_trouble, _P.ERROR),
        Transition(_P.BUSY, trouble, count_trouble, _P.PREPARE),
        Transition(_P.CHECK, succeeded, nothing, _P.DONE),
        Transition(_P.CHECK, last_trouble, count_trouble, _P.ERROR),
        Transition(_P.CHECK, trouble, count_trouble, _P.PREPARE),
        Transition(_P.PREPARE, a_call_later, retry, _P.BUSY),
    ],
    prepare=forget_attempts,
)


# -- AXIS_INIT ---------------------------------------------------------------------------------------------------------


def look_up(job: AxisJob) -> None:
    """Action: ask for the type of the encoder."""
    job.tell(Level.VERBOSE, _START, f"StartUp NcAxisId: {job.port.index}")


def read_encoder(job: AxisJob) -> None:
    """Action: show type and name, and clear what is wrong with the axis.

    A servo drive stands behind an encoder in software; an ideal one has what the NC calls a simulation.
    """
    simulated = job.axis.config.simulated
    encoder = AxisEncoderType.Simulation_Encoder if simulated else AxisEncoderType.TCom_Encoder_SoftDrive
    job.inputs.state.view.encoder = encoder
    job.tell(Level.INFO, _START, f"Encoder Type: {encoder.name}")
    job.tell(Level.INFO, _START, f"Axis Name: {job.axis.name}")
    reset(job)


def has_device(job: AxisJob) -> bool:
    """Condition: all is well, and there is a device behind the encoder whose name can be asked for."""
    return succeeded(job) and job.inputs.state.view.encoder > AxisEncoderType.Simulation_Encoder


INITIALISED: Final = say(Level.INFO, _START, f"Axis Init: {NO_NAME} : PROGRESS_DONE")

INIT: Final = JobTable[AxisJob](
    "INIT",
    [
        Transition(_P.INIT, always, look_up, _P.STARTUP),
        Transition(_P.STARTUP, a_call_later, read_encoder, _P.PREPARE),
        Transition(_P.PREPARE, lost, fail(_START, "PROGRESS_ERROR"), _P.ERROR),
        Transition(_P.PREPARE, late, time_out(_START, "PROGRESS_ERROR"), _P.ERROR),
        Transition(_P.PREPARE, has_device, nothing, _P.CHECK),
        Transition(_P.PREPARE, succeeded, INITIALISED, _P.DONE),
        Transition(_P.CHECK, a_call_later, nothing, _P.OCCUPIED),
        Transition(_P.OCCUPIED, a_call_later, INITIALISED, _P.DONE),
    ],
)
