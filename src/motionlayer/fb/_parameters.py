"""Parameters of an axis by number (function-blocks 2.17): one table of what can be read and written.

Numbers that the interface knows and this runtime has nothing for are left out; asking for one is error 0x4B05, as is
asking for a bool as a number or the other way round, or writing what can only be read.
"""

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Final, NamedTuple, cast

from motionlayer.command import Command, ErrorId
from motionlayer.fb._parameter_numbers import MC_AxisParameter
from motionlayer.fb._settings import Range, Settings

if TYPE_CHECKING:
    from motionlayer.fb._axis_ref import AXIS_REF
    from motionlayer.nc import AxisConfig

INF: Final = math.inf


class Parameter(NamedTuple):
    """What a number stands for.

    Attributes:
        kind: float for LREAL, bool for BOOL.
        unit: of the value, u that of the axis; empty without.
        text: meaning.
        read: returns the value.
        write: sets it; None for what can only be read.
    """

    kind: type
    unit: str
    text: str
    read: Callable[["AXIS_REF"], float]
    write: Callable[["AXIS_REF", str, Any], Command[Any]] | None = None


Bounds = Callable[["AxisConfig", "AxisConfig"], Range]
"""Returns the range of a value, from the configuration described and the one in force."""


def shown(text: str, unit: str, read: Callable[["AXIS_REF"], float]) -> Parameter:
    """Return a parameter that can only be read."""
    return Parameter(float, unit, text, read)


def value(text: str, unit: str, path: str, bounds: Bounds, off: float | None = None) -> Parameter:
    """Return a value that is set; `off` stands in the configuration while it is switched off."""

    def write(ref: "AXIS_REF", name: str, new: float) -> Command[Any]:
        settings = ref.settings
        return settings.write(name, path, float(new), _range(settings, bounds), off, unit)

    return Parameter(float, unit, text, lambda ref: ref.settings.value(path, off), write)


def switched(text: str, path: str, bounds: Bounds, off: float | None = None) -> Parameter:
    """Return what switches a monitor or a limit."""

    def write(ref: "AXIS_REF", name: str, new: bool) -> Command[Any]:
        settings = ref.settings
        return settings.switch(name, path, off, _range(settings, bounds), on=bool(new))

    return Parameter(bool, "", text, lambda ref: ref.settings.is_on(path, off), write)


def _range(settings: Settings, bounds: Bounds) -> Range:
    return bounds(settings.described, settings.axis.config)


def _at_most(limit: float | None) -> Range:
    return Range(0.0, INF if limit is None else limit, low_open=True)


def _maximum(name: str) -> Bounds:
    return lambda described, _now: _at_most(getattr(described.maximum, name))


def _usual(name: str) -> Bounds:
    return lambda _described, now: _at_most(getattr(now.maximum, name))


def _monitor(name: str) -> Bounds:
    return lambda described, _now: _at_most(getattr(described.monitor, name))


def _below_maximum(_described: "AxisConfig", now: "AxisConfig") -> Range:
    return _at_most(now.maximum.velocity)


def _any_step(_described: "AxisConfig", _now: "AxisConfig") -> Range:
    return _at_most(None)


def _limit_high(described: "AxisConfig", now: "AxisConfig") -> Range:
    return Range(now.limit_min, described.limit_max, low_open=True)


def _limit_low(described: "AxisConfig", now: "AxisConfig") -> Range:
    return Range(described.limit_min, now.limit_max, high_open=True)


def _lag_time(described: "AxisConfig", _now: "AxisConfig") -> Range:
    return Range(0.0, INF if described.monitor.lag is None else described.monitor.lag_time)


def _target_time(described: "AxisConfig", _now: "AxisConfig") -> Range:
    return Range(0.0 if described.monitor.target_window is None else described.monitor.target_time, INF)


def _motion_window(described: "AxisConfig", _now: "AxisConfig") -> Range:
    """The wider the stricter: who moves by more in a cycle than a wide window has moved by more than a narrow one."""
    least = described.monitor.motion_window
    return Range(0.0 if least is None else least, INF, low_open=least is None)


def _motion_time(described: "AxisConfig", _now: "AxisConfig") -> Range:
    return _at_most(None if described.monitor.motion_window is None else described.monitor.motion_time)


def _tolerance(_described: "AxisConfig", now: "AxisConfig") -> Range:
    return Range(0.0, now.modulo.period)


def _remaining(ref: "AXIS_REF") -> float:
    return float(ref.NcToPlc.TargetPos) - float(ref.NcToPlc.SetPos)


_P = MC_AxisParameter
_MAX_V = value("largest velocity", "u/s", "maximum.velocity", _maximum("velocity"))
_MAX_A = value("largest acceleration", "u/s²", "maximum.acceleration", _maximum("acceleration"))
_MAX_D = value("largest deceleration", "u/s²", "maximum.deceleration", _maximum("deceleration"))
_MAX_J = value("largest jerk", "u/s³", "maximum.jerk", _maximum("jerk"))
_SLOW = value("slow manual velocity", "u/s", "manual.slow", _below_maximum)
_FAST = value("fast manual velocity", "u/s", "manual.fast", _below_maximum)
_HIGH = value("maximum software limit", "u", "limit_max", _limit_high, INF)
_LOW = value("minimum software limit", "u", "limit_min", _limit_low, -INF)
_EN_HIGH = switched("the maximum software limit holds", "limit_max", _limit_high, INF)
_EN_LOW = switched("the minimum software limit holds", "limit_min", _limit_low, -INF)
_LAG = value("largest position lag", "u", "monitor.lag", _monitor("lag"))
_EN_LAG = switched("the position lag is watched", "monitor.lag", _monitor("lag"))
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
    _P.AxisAcc: value("default acceleration", "u/s²", "default.acceleration", _usual("acceleration")),
    _P.AxisDec: value("default deceleration", "u/s²", "default.deceleration", _usual("deceleration")),
    _P.AxisJerk: value("default jerk", "u/s³", "default.jerk", _usual("jerk")),
    _P.MaxJerk: _MAX_J,
    _P.AxisMaxVelocity: _MAX_V,
    _P.AxisManualVelocityFast: _FAST,
    _P.AxisManualVelocitySlow: _SLOW,
    _P.AxisCalibrationVelocityForward: value(
        "velocity of homing, towards the cam", "u/s", "home.velocity", _below_maximum
    ),
    _P.AxisCalibrationVelocityBackward: value(
        "velocity of homing, off the cam", "u/s", "home.sync_velocity", _below_maximum
    ),
    _P.AxisJogIncrementForward: value("step of inching, positive", "u", "manual.forward", _any_step),
    _P.AxisJogIncrementBackward: value("step of inching, negative", "u", "manual.backward", _any_step),
    _P.AxisEnMinSoftPosLimit: _EN_LOW,
    _P.AxisMinSoftPosLimit: _LOW,
    _P.AxisEnMaxSoftPosLimit: _EN_HIGH,
    _P.AxisMaxSoftPosLimit: _HIGH,
    _P.AxisEnPositionLagMonitoring: _EN_LAG,
    _P.AxisMaxPosLagValue: _LAG,
    _P.AxisMaxPosLagFilterTime: value("for how long the lag may be larger", "s", "monitor.lag_time", _lag_time),
    _P.AxisEnPositionRangeMonitoring: switched(
        "InPositionArea is watched", "monitor.range_window", _monitor("range_window")
    ),
    _P.AxisPositionRangeWindow: value(
        "window of InPositionArea", "u", "monitor.range_window", _monitor("range_window")
    ),
    _P.AxisEnTargetPositionMonitoring: switched(
        "InTargetPosition is watched", "monitor.target_window", _monitor("target_window")
    ),
    _P.AxisTargetPositionWindow: value(
        "window of InTargetPosition", "u", "monitor.target_window", _monitor("target_window")
    ),
    _P.AxisTargetPositionMonitoringTime: value(
        "time inside it without interruption", "s", "monitor.target_time", _target_time
    ),
    _P.AxisEnInTargetTimeout: switched(
        "the time until then is watched", "monitor.target_timeout", _monitor("target_timeout")
    ),
    _P.AxisInTargetTimeout: value(
        "longest time from the end of the setpoint to InTargetPosition",
        "s",
        "monitor.target_timeout",
        _monitor("target_timeout"),
    ),
    _P.AxisEnMotionMonitoring: switched(
        "it is watched that the axis moves while its setpoint does", "monitor.motion_window", _motion_window
    ),
    _P.AxisMotionMonitoringWindow: value(
        "the actual position changes by more than this in a cycle", "u", "monitor.motion_window", _motion_window
    ),
    _P.AxisMotionMonitoringTime: value("at least once within this time", "s", "monitor.motion_time", _motion_time),
    _P.AxisEncoderModuloValue: value("modulo period", "u", "modulo.period", _any_step),
    _P.AxisModuloToleranceWindow: value(
        "half width of the modulo tolerance window", "u", "modulo.tolerance", _tolerance
    ),
    _P.AxisCycleTime: _CYCLE,
    _P.AxisMaximumAcceleration: _MAX_A,
    _P.AxisMaximumDeceleration: _MAX_D,
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
