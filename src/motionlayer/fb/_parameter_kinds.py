"""What a parameter of an axis can be: how it is read and written, and the ranges of what can be written."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from motionlayer.command import Command
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


def flag(text: str, read: Callable[["AXIS_REF"], bool]) -> Parameter:
    """Return a switch that can only be read."""
    return Parameter(bool, "", text, read)


def value(text: str, unit: str, path: str, bounds: Bounds, off: float | None = None) -> Parameter:
    """Return a value that is set; `off` stands in the configuration while it is switched off."""

    def write(ref: "AXIS_REF", name: str, new: float) -> Command[Any]:
        settings = ref.settings
        return settings.write(name, path, float(new), range_of(settings, bounds), off, unit)

    return Parameter(float, unit, text, lambda ref: ref.settings.value(path, off), write)


def switched(text: str, path: str, bounds: Bounds, off: float | None = None) -> Parameter:
    """Return what switches a monitor or a limit."""

    def write(ref: "AXIS_REF", name: str, new: bool) -> Command[Any]:
        settings = ref.settings
        return settings.switch(name, path, off, range_of(settings, bounds), on=bool(new))

    return Parameter(bool, "", text, lambda ref: ref.settings.is_on(path, off), write)


def range_of(settings: Settings, bounds: Bounds) -> Range:
    """Return the range of a value as it is now."""
    return bounds(settings.described, settings.axis.config)


def at_most(limit: float | None) -> Range:
    """Return the range of what is positive and bounded, or not bounded where the limit is None."""
    return Range(0.0, INF if limit is None else limit, low_open=True)


def up_to_maximum(name: str) -> Bounds:
    """Return the bounds of a maximum: that of the machine description."""
    return lambda described, _now: at_most(getattr(described.maximum, name))


def up_to_own_maximum(name: str) -> Bounds:
    """Return the bounds of a default: the maximum in force."""
    return lambda _described, now: at_most(getattr(now.maximum, name))


def up_to_monitor(name: str) -> Bounds:
    """Return the bounds of a window: that of the machine description, where it has one."""
    return lambda described, _now: at_most(getattr(described.monitor, name))


def below_maximum(_described: "AxisConfig", now: "AxisConfig") -> Range:
    """Velocities up to the largest in force."""
    return at_most(now.maximum.velocity)


def any_step(_described: "AxisConfig", _now: "AxisConfig") -> Range:
    """Everything positive."""
    return at_most(None)


def limit_high(described: "AxisConfig", now: "AxisConfig") -> Range:
    """From the minimum software limit in force up to the maximum one described."""
    return Range(now.limit_min, described.limit_max, low_open=True)


def limit_low(described: "AxisConfig", now: "AxisConfig") -> Range:
    """From the minimum software limit described up to the maximum one in force."""
    return Range(described.limit_min, now.limit_max, high_open=True)


def lag_time(described: "AxisConfig", _now: "AxisConfig") -> Range:
    """As long as described, where the lag is watched."""
    return Range(0.0, INF if described.monitor.lag is None else described.monitor.lag_time)


def target_time(described: "AxisConfig", _now: "AxisConfig") -> Range:
    """As long as described, or longer."""
    return Range(0.0 if described.monitor.target_window is None else described.monitor.target_time, INF)


def motion_window(described: "AxisConfig", _now: "AxisConfig") -> Range:
    """The wider the stricter: who moves by more in a cycle than a wide window has moved by more than a narrow one."""
    least = described.monitor.motion_window
    return Range(0.0 if least is None else least, INF, low_open=least is None)


def motion_time(described: "AxisConfig", _now: "AxisConfig") -> Range:
    """As long as described, where motion is watched."""
    return at_most(None if described.monitor.motion_window is None else described.monitor.motion_time)


def tolerance(_described: "AxisConfig", now: "AxisConfig") -> Range:
    """Up to the modulo period."""
    return Range(0.0, now.modulo.period)


def any_position(_described: "AxisConfig", _now: "AxisConfig") -> Range:
    """Every finite position."""
    return Range(-INF, INF)
