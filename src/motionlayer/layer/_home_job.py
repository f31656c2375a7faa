"""HOME (motion-layer 5.7).

An axis that is homed first counts as not homed any more. Then the axis finds its reference in the way that the mode
names; the calibration signal is told to it in every cycle in which it changes (D9). A drive that has a switch of its
own finds the reference by that as well: either signal counts.
"""

from typing import TYPE_CHECKING, Final

from motionlayer.command import ErrorId
from motionlayer.event import Level, Subdevice
from motionlayer.fb import HOMING_METHODS, E_EncoderReferenceMode
from motionlayer.layer._axis_job import DONE, AxisJob, aborted, fail, failed, say, succeeded
from motionlayer.layer._job import JobTable, Transition, always
from motionlayer.layer.types._library_kinds import NC_CALIBRATIONS
from motionlayer.layer.types._progress import Progress
from motionlayer.nc import Calibration, Direction, HomeCommand

if TYPE_CHECKING:
    from motionlayer.layer.types import HomeParams

_P = Progress
_HOME: Final = Subdevice.fbHome

LEAVING: Final = 4
"""Phase of a homing in which the axis leaves the cam; a simulated signal is off from then on."""


def calibration_signal(job: AxisJob) -> bool:
    """Return the signal by the first that applies: simulated, a limit switch, the calibration cam.

    Each switch is inverted by its own flag (D10). A cam that nobody writes is that of the drive, which the axis sees
    for itself.
    """
    params, switches = job.inputs.home.parameters, job.inputs.limit_switches
    if params.simulate_sensor:
        return int(job.port.ref.NcToPlc.HomingState) < LEAVING
    if params.home_on_limit_min:
        return switches.minimum is not params.invert_limit_min
    if params.home_on_limit_max:
        return switches.maximum is not params.invert_limit_max
    return job.switches_written and switches.calibrate is not params.invert_sensor


def homed(job: AxisJob) -> bool:
    """Condition: the axis counts as homed."""
    return job.axis.homed


def forget_reference(job: AxisJob) -> None:
    """Action: it does not count as homed any more."""
    job.command = job.axis.home(mode=Calibration.RESET)


def start_home(job: AxisJob) -> None:
    """Action: find the reference, or refuse what there is not."""
    params = job.inputs.home.parameters
    options = params.options
    job.cam = calibration_signal(job)
    calibration, reference = NC_CALIBRATIONS.get(int(params.mode)), int(options.reference_mode)
    objection = _objection(params)
    if calibration is None or objection is not None:
        error, text = objection or (ErrorId.MODE_INVALID, _mode_text(params))
        job.command = job.axis.refuse("home", error, text)
        return
    job.command = job.axis.home(
        params.position,
        calibration,
        method=HOMING_METHODS[E_EncoderReferenceMode(reference)],
        search_direction=Direction(options.search_direction),
        search_velocity=options.search_velocity or None,
        sync_direction=Direction(options.sync_direction),
        sync_velocity=options.sync_velocity or None,
        cam=job.cam,
        clear_lag=options.clear_lag,
    )


def _mode_text(params: "HomeParams") -> str:
    allowed = ", ".join(str(int(one)) for one in NC_CALIBRATIONS)
    return f"HomingMode = {int(params.mode)}, allowed: {allowed}"


def _objection(params: "HomeParams") -> tuple[ErrorId, str] | None:
    """Tell what the motion runtime cannot even be asked."""
    options = params.options
    if options.reference_mode not in HOMING_METHODS:
        allowed = ", ".join(str(int(one)) for one in HOMING_METHODS)
        return ErrorId.REFERENCE_MODE, f"ReferenceMode = {int(options.reference_mode)}, allowed: {allowed}"
    for name, number in (("SearchDirection", options.search_direction), ("SyncDirection", options.sync_direction)):
        if not isinstance(number, Direction):
            return ErrorId.MODE_INVALID, f"{name} = {number}, allowed: 1, 3, 128"
    return None


def signal_changed(job: AxisJob) -> bool:
    """Condition: the calibration signal is not what the homing was told last."""
    return calibration_signal(job) is not job.cam


def tell_signal(job: AxisJob) -> None:
    """Action: tell the homing."""
    job.cam = not job.cam
    if isinstance(job.command, HomeCommand):
        job.command.cam(on=job.cam)


HOME: Final = JobTable[AxisJob](
    "HOME",
    [
        Transition(_P.INIT, homed, forget_reference, _P.STARTUP),
        Transition(_P.INIT, always, start_home, _P.OCCUPIED),
        Transition(_P.STARTUP, succeeded, start_home, _P.OCCUPIED),
        Transition(_P.STARTUP, failed, fail(_HOME, ""), _P.ERROR),
        Transition(_P.OCCUPIED, succeeded, say(Level.VERBOSE, _HOME, DONE), _P.DONE),
        Transition(_P.OCCUPIED, failed, fail(_HOME, ""), _P.ERROR),
        Transition(_P.OCCUPIED, aborted, fail(_HOME, ""), _P.ERROR),
        Transition(_P.OCCUPIED, signal_changed, tell_signal, _P.OCCUPIED),
    ],
)
