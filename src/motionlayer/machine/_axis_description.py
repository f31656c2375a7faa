"""The table of an axis and what it holds beside its drive and its homing: modulo view, manual motion."""

from collections.abc import Callable
from typing import Any, Final

from pydantic import Field, ValidationInfo, field_validator
from pydantic_core import PydanticCustomError

from motionlayer.machine._drive_description import DriveDescription, MonitorDescription
from motionlayer.machine._fields import Acceleration, Jerk, Position, Table, Text, Velocity, Width, Window
from motionlayer.machine._home_description import HomeDescription
from motionlayer.profile import RANGES


def _same_as(field: str) -> Callable[[dict[str, Any]], Any]:
    """Return a default: the value of a field before. Not used when that field is wrong itself."""
    return lambda data: data.get(field)


def _no_keys() -> Any:  # noqa: ANN401 - validated into the model of the field
    return {}


class ModuloDescription(Table):
    """The modulo view of the position: `[axis.X.modulo]`. Linear axes may be seen so too."""

    period: Window = Field(default=360.0, description="Modulo period (u), > 0.")
    tolerance: Width = Field(
        default=0.0,
        description="Half width of the window around the target (u) in which move_modulo() from rest takes the nearest "
        "way, also against the direction.",
    )


class ManualDescription(Table):
    """Manual motion: `[axis.X.manual]`."""

    slow: Velocity | None = Field(
        default=None,
        description="Slow manual velocity (u/s), > 0 and at most max_velocity; default: a twentieth of max_velocity.",
    )
    fast: Velocity | None = Field(
        default=None,
        description="Fast manual velocity (u/s), > 0 and at most max_velocity; default: 0.3 of max_velocity.",
    )
    forward: Window = Field(default=1.0, description="Step of inching in positive direction (u), > 0.")
    backward: Window = Field(default=1.0, description="Step of inching in negative direction (u), > 0.")


SEARCH_TIME: Final = 600.0
"""Seconds of a homing's search that bound its way where nothing else does."""


class AxisDescription(Table):
    """One axis: `[axis.X]`."""

    unit: Text = Field(default="mm", description="Unit of positions, u in all other units.")
    max_velocity: Velocity = Field(description="Largest velocity (u/s), > 0.")
    max_acceleration: Acceleration = Field(description="Largest acceleration while |v| grows (u/s²), > 0.")
    max_deceleration: Acceleration = Field(
        default_factory=_same_as("max_acceleration"),
        description="Largest deceleration, while |v| falls (u/s²), > 0; default: max_acceleration.",
    )
    max_jerk: Jerk = Field(description="Largest jerk (u/s³), > 0.")
    velocity: Velocity = Field(
        default_factory=_same_as("max_velocity"),
        description="Velocity of a command that names none (u/s), > 0 and at most max_velocity, its default.",
    )
    acceleration: Acceleration = Field(
        default_factory=_same_as("max_acceleration"),
        description="Acceleration of a command that names none (u/s²), > 0 and at most max_acceleration, its default.",
    )
    deceleration: Acceleration = Field(
        default_factory=_same_as("max_deceleration"),
        description="Deceleration of a command that names none (u/s²), > 0 and at most max_deceleration, its default.",
    )
    jerk: Jerk = Field(
        default_factory=_same_as("max_jerk"),
        validate_default=True,
        description="Jerk of a command that names none (u/s³), > 0 and at most max_jerk, its default.",
    )
    software_limit_min: Position | None = Field(
        default=None,
        description="Lowest position of a command (u); default: none.",
        json_schema_extra={"x-unit": "u"},
    )
    software_limit_max: Position | None = Field(
        default=None,
        description="Highest position of a command (u), above software_limit_min; default: none.",
        json_schema_extra={"x-unit": "u"},
    )
    start_position: Position = Field(
        default=0.0, description="Where the simulated drive stands at the beginning of a run (u)."
    )
    home: HomeDescription = Field(
        default_factory=_no_keys,
        validate_default=True,
        description="How the axis finds its reference.",
    )
    modulo: ModuloDescription | None = Field(
        default=None, description="The modulo view of the position; an axis without it has one of 360 u."
    )
    manual: ManualDescription = Field(default_factory=ManualDescription, description="Manual motion.")
    drive: DriveDescription = Field(default_factory=DriveDescription, description="The drive of the axis.")
    monitor: MonitorDescription = Field(
        default_factory=MonitorDescription, description="What is watched on the axis; nothing by default."
    )

    @property
    def longest_search(self) -> float:
        """The longest way of a homing's search, u; a switch may lie outside the software limits."""
        if self.home.travel is not None:
            return self.home.travel
        if self.software_limit_min is None or self.software_limit_max is None:
            return SEARCH_TIME * self.home.velocity
        return 2.0 * (self.software_limit_max - self.software_limit_min)

    @property
    def weak_torque(self) -> float | None:
        """What the torque of the drive allows, u/s², where the axis may ask for more; None where it may not."""
        torque, asked = self.drive.max_acceleration, max(self.max_acceleration, self.max_deceleration)
        return torque if torque is not None and torque < asked else None

    @field_validator("velocity", "acceleration", "deceleration", "jerk")
    @classmethod
    def _at_most_maximum(cls, value: float, info: ValidationInfo) -> float:
        name = f"max_{info.field_name}"
        maximum = info.data.get(name)
        if maximum is not None and value > maximum:
            raise PydanticCustomError("relation", "relation", {"allowed": f"at most {name} = {maximum}"})
        return value

    @field_validator("max_jerk", "jerk")
    @classmethod
    def _phases_side_by_side(cls, value: float, info: ValidationInfo) -> float:
        own = "max_" if info.field_name == "max_jerk" else ""
        names = ("max_velocity", f"{own}acceleration", f"{own}deceleration")
        if any(info.data.get(name) is None for name in names):
            return value
        velocity, acceleration, deceleration = (info.data[name] for name in names)
        weakest = min(acceleration, deceleration)
        most = RANGES.phases * weakest * weakest / velocity  # V/A over A/J, as every command is asked
        if value > most:
            allowed = f"at most {most:.6g} beside {names[0]} = {velocity} and the weaker acceleration {weakest}"
            raise PydanticCustomError("relation", "relation", {"allowed": allowed})
        return value

    @field_validator("manual")
    @classmethod
    def _manual_at_most_maximum(cls, manual: ManualDescription, info: ValidationInfo) -> ManualDescription:
        maximum = info.data.get("max_velocity")
        fastest = max(manual.slow or 0.0, manual.fast or 0.0)
        if maximum is not None and fastest > maximum:
            raise PydanticCustomError("relation", "relation", {"allowed": f"at most max_velocity = {maximum}"})
        return manual

    @field_validator("software_limit_max")
    @classmethod
    def _above_minimum(cls, value: float | None, info: ValidationInfo) -> float | None:
        minimum = info.data.get("software_limit_min")
        if value is not None and minimum is not None and value <= minimum:
            allowed = f"greater than software_limit_min = {minimum}"
            raise PydanticCustomError("relation", "relation", {"allowed": allowed})
        return value

    @field_validator("home", mode="before")
    @classmethod
    def _add_search_velocity(cls, home: object, info: ValidationInfo) -> object:
        if isinstance(home, dict) and "velocity" not in home:
            # Any number will do if max_velocity is wrong: the axis is refused for that alone.
            return {**home, "velocity": info.data.get("max_velocity", 1.0) / 10}
        return home
