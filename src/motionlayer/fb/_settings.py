"""What can be set of an axis while it runs: values, the ranges they stay in, and monitors that are switched.

The machine description is the bound (record 31): a value can be written inside of what it allows, never beyond, so that
whatever was checked before the run stays true in it. A monitor or a limit can be switched off only if the description
does not have it on.
"""

import math
import operator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from motionlayer.command import Command, ErrorId

if TYPE_CHECKING:
    from motionlayer.nc import Axis, AxisConfig


class Range(NamedTuple):
    """Values that are allowed; infinite ones never are."""

    low: float
    high: float
    low_open: bool = False
    high_open: bool = False

    def __contains__(self, value: object) -> bool:
        if not isinstance(value, float) or not math.isfinite(value):
            return False
        above = value > self.low if self.low_open else value >= self.low
        below = value < self.high if self.high_open else value <= self.high
        return above and below

    def __str__(self) -> str:
        return f"{self.low} <{'' if self.low_open else '='} x <{'' if self.high_open else '='} {self.high}"


AT_REST: Final = ("limit_", "maximum.")
"""What running motions were planned with: written only while the axis has no job."""


@dataclass(slots=True)
class Settings:
    """The settings of one axis.

    Attributes:
        axis: whose.
        described: what the machine description says.
        idle: values of what is switched off, by path.
    """

    axis: "Axis"
    described: "AxisConfig"
    idle: dict[str, float] = field(default_factory=dict)

    def value(self, path: str, off: float | None) -> float:
        """Return a value, in force or not."""
        found = operator.attrgetter(path)(self.axis.config)
        return self.idle.get(path, 0.0) if found == off else float(found)

    def is_on(self, path: str, off: float | None) -> bool:
        """Tell whether something that can be switched is on."""
        return bool(operator.attrgetter(path)(self.axis.config) != off)

    def write(self, name: str, path: str, value: float, allowed: Range, off: float | None, unit: str) -> Command[Any]:
        """Set a value; one that is switched off is kept for when it is on."""
        if value not in allowed:
            return self._refuse(name, value, f"{allowed} {self._spelt(unit)}".rstrip())
        if off is not None and not self.is_on(path, off):
            self.idle[path] = value
            return self._put(name, path, operator.attrgetter(path)(self.axis.config), value)
        return self._put(name, path, value, value)

    def switch(self, name: str, path: str, off: float | None, allowed: Range, *, on: bool) -> Command[Any]:
        """Switch a monitor or a limit."""
        if on == self.is_on(path, off):
            return self._put(name, path, operator.attrgetter(path)(self.axis.config), on)
        if not on and operator.attrgetter(path)(self.described) != off:
            return self._refuse(name, on, "True, as the machine description has it")
        if on:
            value = self.value(path, off)
            return self._put(name, path, value, on) if value in allowed else self._refuse(name, on, str(allowed))
        self.idle[path] = self.value(path, off)
        return self._put(name, path, off, on)

    def _spelt(self, unit: str) -> str:
        """Return a unit of the tables with that of the axis in the place of u."""
        return self.axis.config.unit + unit[1:] if unit.startswith("u") else unit

    def _refuse(self, name: str, value: float, allowed: str) -> Command[Any]:
        return self.axis.refuse("write_parameter", ErrorId.PARAMETER, f"{name} = {value}, allowed: {allowed}")

    def _put(self, name: str, path: str, value: float | None, shown: float) -> Command[Any]:
        """Put a value in force."""
        axis = self.axis
        if path.startswith(AT_REST) and axis.command is not None:
            detail = f"{name} is written only while the axis has no job; it does {axis.command.name}"
            return axis.refuse("write_parameter", ErrorId.GROUP_BUSY, detail)
        return axis.configure(_fitting(_with(axis.config, path, value)), f"write_parameter({name}={shown})")


def _with(config: "AxisConfig", path: str, value: float | None) -> "AxisConfig":
    """Return a configuration with another value; a path is `limit_max` or `monitor.lag`."""
    part, _, leaf = path.rpartition(".")
    change: dict[str, Any] = {leaf: value}
    if part:
        change = {part: getattr(config, part)._replace(**change)}
    return config._replace(**change)


def _fitting(config: "AxisConfig") -> "AxisConfig":
    """Let values that may not be above a maximum follow it down."""
    most, manual = config.maximum, config.manual
    usual = type(most)(*(min(pair) for pair in zip(config.default, most, strict=True)))
    slower = manual._replace(slow=min(manual.slow, most.velocity), fast=min(manual.fast, most.velocity))
    home = config.home._replace(
        velocity=min(config.home.velocity, most.velocity), sync_velocity=min(config.home.sync_velocity, most.velocity)
    )
    return config._replace(default=usual, manual=slower, home=home)
