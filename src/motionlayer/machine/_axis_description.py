"""The table of an axis and what it holds beside its drive: reference, modulo view, manual motion."""

from collections.abc import Callable
from typing import Any, Literal

from pydantic import ConfigDict, Field, ValidationInfo, field_validator
from pydantic_core import PydanticCustomError

from motionlayer.machine._drive_description import DriveDescription, MonitorDescription
from motionlayer.machine._fields import Acceleration, Jerk, Position, Table, Text, Velocity, Width, Window


def _same_as(field: str) -> Callable[[dict[str, Any]], Any]:
    """Return a default: the value of a field before. Not used when that field is wrong itself."""
    return lambda data: data.get(field)


def _no_keys() -> Any:  # noqa: ANN401 - validated into the model of the field
    return {}


def _velocity_is_optional(schema: dict[str, Any]) -> None:
    """Correct the JSON schema: the axis adds the search velocity where the file leaves it out."""
    schema["required"].remove("velocity")
    if not schema["required"]:
        del schema["required"]


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


class HomeDescription(Table):
    """How an axis finds its reference: `[axis.X.home]`."""

    model_config = ConfigDict(json_schema_extra=_velocity_is_optional)

    mode: Literal["direct", "switch", "cam", "index"] = Field(
        default="direct",
        description='"direct": the present position becomes `position`; "switch": search the edge of the switch; '
        '"cam": search it, turn, and take the edge at which the axis leaves it; "index": take the zero pulse behind.',
    )
    position: Position = Field(default=0.0, description="Reference position, of the edge or the pulse (u).")
    switch: Position | None = Field(
        default=None,
        validate_default=True,
        description='Drive position of the simulated switch (u); needed but for mode "direct". The switch is on '
        'at or below it for direction "negative", at or above it for "positive".',
        json_schema_extra={"x-unit": "u"},
    )
    direction: Literal["negative", "positive"] = Field(
        default="negative", description="Direction of the search for the switch."
    )
    velocity: Velocity = Field(
        description="Search velocity (u/s), > 0 and at most max_velocity; default: a tenth of max_velocity."
    )

    sync_velocity: Velocity | None = Field(
        default=None,
        description="Velocity off the cam (u/s), > 0 and at most max_velocity; default: that of the search.",
    )
    sync_direction: Literal["negative", "positive"] | None = Field(
        default=None, description="Direction off the cam; default: the opposite of that of the search."
    )
    switch_width: Window | None = Field(
        default=None,
        description="Width of the simulated switch (u), > 0: of a cam. Default: on up to the end of the way.",
    )
    travel: Window | None = Field(
        default=None,
        description="Longest way of each search (u), > 0; behind it is an error. Default: twice the span of the "
        "software limits; without both of them what takes ten minutes with `velocity`.",
    )
    pulse: Position = Field(default=0.0, description="Drive position of one of the simulated zero pulses (u).")
    pulse_period: Window | None = Field(
        default=None,
        validate_default=True,
        description='From one zero pulse to the next (u), > 0; needed for mode "index".',
    )
    pulse_distance: Width = Field(
        default=0.0, description="Least distance of the zero pulse from the edge of the cam (u); nearer it is an error."
    )

    @field_validator("switch")
    @classmethod
    def _switch_for_mode(cls, switch: float | None, info: ValidationInfo) -> float | None:
        mode = info.data.get("mode")
        if switch is None and mode in ("switch", "cam", "index"):
            raise PydanticCustomError("missing", "missing", {"hint": f'mode = "{mode}" needs it'})
        return switch

    @field_validator("pulse_period")
    @classmethod
    def _pulse_for_mode(cls, period: float | None, info: ValidationInfo) -> float | None:
        if period is None and info.data.get("mode") == "index":
            raise PydanticCustomError("missing", "missing", {"hint": 'mode = "index" needs it'})
        return period


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

    @field_validator("velocity", "acceleration", "deceleration", "jerk")
    @classmethod
    def _at_most_maximum(cls, value: float, info: ValidationInfo) -> float:
        name = f"max_{info.field_name}"
        maximum = info.data.get(name)
        if maximum is not None and value > maximum:
            raise PydanticCustomError("relation", "relation", {"allowed": f"at most {name} = {maximum}"})
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
