"""Parameters of an axis by number (function-blocks 2.17): one table of what can be read and written.

Numbers that the interface knows and this runtime has nothing for are left out; asking for one is error 0x4B05, as is
asking for a bool as a number or the other way round, or writing what can only be read.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final, cast

from motionlayer.command import ErrorId
from motionlayer.fb._parameter_kinds import (
    INF,
    Parameter,
    any_position,
    any_step,
    below_maximum,
    flag,
    lag_time,
    limit_high,
    limit_low,
    motion_time,
    motion_window,
    shown,
    switched,
    target_time,
    tolerance,
    up_to_maximum,
    up_to_monitor,
    up_to_own_maximum,
    value,
)
from motionlayer.fb._parameter_numbers import MC_AxisParameter
from motionlayer.fb._reference_modes import reference_mode

if TYPE_CHECKING:
    from motionlayer.fb._axis_ref import AXIS_REF


def _remaining(ref: "AXIS_REF") -> float:
    return float(ref.NcToPlc.TargetPos) - float(ref.NcToPlc.SetPos)


_P = MC_AxisParameter
_MAX_V = value("largest velocity", "u/s", "maximum.velocity", up_to_maximum("velocity"))
_MAX_A = value("largest acceleration", "u/s²", "maximum.acceleration", up_to_maximum("acceleration"))
_MAX_D = value("largest deceleration", "u/s²", "maximum.deceleration", up_to_maximum("deceleration"))
_MAX_J = value("largest jerk", "u/s³", "maximum.jerk", up_to_maximum("jerk"))
_SLOW = value("slow manual velocity", "u/s", "manual.slow", below_maximum)
_FAST = value("fast manual velocity", "u/s", "manual.fast", below_maximum)
_HIGH = value("maximum software limit", "u", "limit_max", limit_high, INF)
_LOW = value("minimum software limit", "u", "limit_min", limit_low, -INF)
_EN_HIGH = switched("the maximum software limit holds", "limit_max", limit_high, INF)
_EN_LOW = switched("the minimum software limit holds", "limit_min", limit_low, -INF)
_LAG = value("largest position lag", "u", "monitor.lag", up_to_monitor("lag"))
_EN_LAG = switched("the position lag is watched", "monitor.lag", up_to_monitor("lag"))
_CYCLE = shown("base cycle", "s", lambda ref: ref.cycle_time)

PARAMETERS: Final[Mapping[MC_AxisParameter, Parameter]] = {
    _P.CommandedPosition: shown("set position", "u", lambda ref: ref.NcToPlc.SetPos),
    _P.SWLimitPos: _HIGH,
    _P.SWLimitNeg: _LOW,
    _P.EnableLimitPos: _EN_HIGH,
    _P.EnableLimitNeg: _EN_LOW,
    _P.EnablePosLagMonitoring: _EN_LAG,
    _P.MaxPositionLag: _LAG,
    _P.MaxVelocitySystem: _MAX_V,
    _P.MaxVelocityAppl: _MAX_V,
    _P.ActualVelocity: shown("actual velocity", "u/s", lambda ref: ref.NcToPlc.ActVelo),
    _P.CommandedVelocity: shown("set velocity", "u/s", lambda ref: ref.NcToPlc.SetVelo),
    _P.MaxAccelerationSystem: _MAX_A,
    _P.MaxAccelerationAppl: _MAX_A,
    _P.MaxDecelerationSystem: _MAX_D,
    _P.MaxDecelerationAppl: _MAX_D,
    _P.MaxJerkSystem: _MAX_J,
    _P.MaxJerkAppl: _MAX_J,
    _P.AxisId: shown("number of the axis", "", lambda ref: float(ref.NcToPlc.AxisId)),
    _P.AxisVeloManSlow: _SLOW,
    _P.AxisVeloManFast: _FAST,
    _P.AxisVeloMax: _MAX_V,
    _P.AxisAcc: value("default acceleration", "u/s²", "default.acceleration", up_to_own_maximum("acceleration")),
    _P.AxisDec: value("default deceleration", "u/s²", "default.deceleration", up_to_own_maximum("deceleration")),
    _P.AxisJerk: value("default jerk", "u/s³", "default.jerk", up_to_own_maximum("jerk")),
    _P.MaxJerk: _MAX_J,
    _P.AxisMaxVelocity: _MAX_V,
    _P.AxisManualVelocityFast: _FAST,
    _P.AxisManualVelocitySlow: _SLOW,
    _P.AxisCalibrationVelocityForward: value(
        "velocity of homing, towards the cam", "u/s", "home.velocity", below_maximum
    ),
    _P.AxisCalibrationVelocityBackward: value(
        "velocity of homing, off the cam", "u/s", "home.sync_velocity", below_maximum
    ),
    _P.AxisJogIncrementForward: value("step of inching, positive", "u", "manual.forward", any_step),
    _P.AxisJogIncrementBackward: value("step of inching, negative", "u", "manual.backward", any_step),
    _P.AxisEnMinSoftPosLimit: _EN_LOW,
    _P.AxisMinSoftPosLimit: _LOW,
    _P.AxisEnMaxSoftPosLimit: _EN_HIGH,
    _P.AxisMaxSoftPosLimit: _HIGH,
    _P.AxisEnPositionLagMonitoring: _EN_LAG,
    _P.AxisMaxPosLagValue: _LAG,
    _P.AxisMaxPosLagFilterTime: value("for how long the lag may be larger", "s", "monitor.lag_time", lag_time),
    _P.AxisEnPositionRangeMonitoring: switched(
        "InPositionArea is watched", "monitor.range_window", up_to_monitor("range_window")
    ),
    _P.AxisPositionRangeWindow: value(
        "window of InPositionArea", "u", "monitor.range_window", up_to_monitor("range_window")
    ),
    _P.AxisEnTargetPositionMonitoring: switched(
        "InTargetPosition is watched", "monitor.target_window", up_to_monitor("target_window")
    ),
    _P.AxisTargetPositionWindow: value(
        "window of InTargetPosition", "u", "monitor.target_window", up_to_monitor("target_window")
    ),
    _P.AxisTargetPositionMonitoringTime: value(
        "time inside it without interruption", "s", "monitor.target_time", target_time
    ),
    _P.AxisEnInTargetTimeout: switched(
        "the time until then is watched", "monitor.target_timeout", up_to_monitor("target_timeout")
    ),
    _P.AxisInTargetTimeout: value(
        "longest time from the end of the setpoint to InTargetPosition",
        "s",
        "monitor.target_timeout",
        up_to_monitor("target_timeout"),
    ),
    _P.AxisEnMotionMonitoring: switched(
        "it is watched that the axis moves while its setpoint does", "monitor.motion_window", motion_window
    ),
    _P.AxisMotionMonitoringWindow: value(
        "the actual position changes by more than this in a cycle", "u", "monitor.motion_window", motion_window
    ),
    _P.AxisMotionMonitoringTime: value("at least once within this time", "s", "monitor.motion_time", motion_time),
    _P.AxisEncoderModuloValue: value("modulo period", "u", "modulo.period", any_step),
    _P.AxisModuloToleranceWindow: value(
        "half width of the modulo tolerance window", "u", "modulo.tolerance", tolerance
    ),
    _P.AxisCycleTime: _CYCLE,
    _P.AxisMaximumAcceleration: _MAX_A,
    _P.AxisMaximumDeceleration: _MAX_D,
    _P.AxisEncoderHomingInvDirCamSearch: flag(
        "homing searches the cam in negative direction", lambda ref: ref.axis.config.home.direction < 0.0
    ),
    _P.AxisEncoderHomingInvDirSyncSearch: flag(
        "homing leaves the cam in negative direction", lambda ref: ref.axis.config.home.sync_direction < 0.0
    ),
    _P.AxisEncoderHomingCalibValue: value("position of the reference", "u", "home.position", any_position),
    _P.AxisEncoderReferenceMode: shown(
        "what the reference is, as E_EncoderReferenceMode; 0: a switch alone, or the present position",
        "",
        lambda ref: float(reference_mode(ref.axis.config.home.mode)),
    ),
    _P.AxisTargetPosition: shown("where the motion ends", "u", lambda ref: ref.NcToPlc.TargetPos),
    _P.AxisRemainingTimeToGo: shown("time until then; infinite without end", "s", lambda ref: ref.axis.remaining_time),
    _P.AxisRemainingDistanceToGo: shown("way until then", "u", _remaining),
    _P.NcSafCycleTime: _CYCLE,
    _P.NcSvbCycleTime: _CYCLE,
}
"""What can be read and written."""


def find(number: int, kind: type) -> tuple[str, Parameter] | None:
    """Return name and entry of a parameter of a kind; None if there is none.

    Raises:
        TypeError: the number is none.
    """
    if isinstance(number, bool) or not isinstance(number, int):
        raise TypeError(f"ParameterNumber is {number!r}; give a whole number or an MC_AxisParameter")
    found = PARAMETERS.get(cast("MC_AxisParameter", number))
    return (MC_AxisParameter(number).name, found) if found is not None and found.kind is kind else None


UNKNOWN: Final = ErrorId.COMMAND_NOT_PERMITTED
"""No such parameter, one of another kind, or one that can only be read."""
