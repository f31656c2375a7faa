"""The tables that concern drives: the drive itself, what is watched on it, what goes wrong, and who else stops."""

from typing import Any, Literal

from pydantic import Field, SerializerFunctionWrapHandler, ValidationInfo, field_validator, model_serializer
from pydantic_core import PydanticCustomError

from motionlayer.machine._fields import Acceleration, Duration, Positive, Seconds, Table, Text, Velocity, Width, Window

MOST_CYCLES = 1000
"""Most cycles of a dead time, a ready delay or a patience."""


class DriveDescription(Table):
    """The drive of an axis: `[axis.X.drive]`. All keys but `kind` are of the servo drive alone."""

    kind: Literal["ideal", "servo"] = Field(
        default="ideal",
        description='"ideal": the actual position is the set position, without lag; "servo": a simulated drive with '
        "loops and mechanics.",
    )
    position_gain: Positive | None = Field(
        default=None,
        validate_default=True,
        description='Gain Kv of the position loop (1/s), > 0; needed for kind "servo". What the loop bears depends on '
        "base cycle and time constant.",
        json_schema_extra={"x-unit": "1/s"},
    )
    velocity_feed_forward: float = Field(
        default=0.0, ge=0, le=1, description="Share of the set velocity that is fed forward, 0 to 1."
    )
    time_constant: Seconds = Field(
        default=0.0, description="Time constant of the velocity loop (s); 0: it follows at once."
    )
    dead_time: Seconds = Field(
        default=0.0, description="Time from set position to drive and back (s), a whole number of base cycles."
    )
    max_acceleration: Acceleration | None = Field(
        default=None,
        description="What the torque allows (u/s²), > 0; default: anything.",
        json_schema_extra={"x-unit": "u/s²"},
    )
    backlash: Width = Field(default=0.0, description="Play between motor and load (u).")
    encoder_resolution: Width = Field(default=0.0, description="Step of the encoder (u); 0: none.")
    noise: Width = Field(default=0.0, description="Standard deviation of the encoder (u).")
    brake_deceleration: Acceleration | None = Field(
        default=None,
        description="Deceleration without power (u/s²), > 0; default: max_deceleration of the axis.",
        json_schema_extra={"x-unit": "u/s²"},
    )
    ready_delay: Seconds = Field(default=0.0, description="Time from request to readiness beyond one cycle (s).")
    patience: int = Field(
        default=3, ge=0, le=MOST_CYCLES, description="Base cycles without communication that are borne."
    )

    @field_validator("position_gain")
    @classmethod
    def _gain_for_kind(cls, gain: float | None, info: ValidationInfo) -> float | None:
        if gain is None and info.data.get("kind") == "servo":
            raise PydanticCustomError("missing", "missing", {"hint": 'kind = "servo" needs it'})
        return gain

    @model_serializer(mode="wrap")
    def _what_applies(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        data: dict[str, Any] = handler(self)
        return data if self.kind == "servo" else {"kind": self.kind}


class MonitorDescription(Table):
    """What is watched on an axis: `[axis.X.monitor]`. A window that is left out is not watched."""

    lag: Window | None = Field(
        default=None,
        description="Largest position lag (u), > 0; more of it for longer than lag_time is an error.",
        json_schema_extra={"x-unit": "u"},
    )
    lag_time: Seconds = Field(default=0.0, description="For how long the lag may be larger (s).")
    range_window: Window | None = Field(
        default=None,
        description="InPositionArea: largest distance of the actual position from the target (u), > 0.",
        json_schema_extra={"x-unit": "u"},
    )
    target_window: Window | None = Field(
        default=None,
        description="InTargetPosition: the same, for target_time; a positioning is done only then (u), > 0.",
        json_schema_extra={"x-unit": "u"},
    )
    target_time: Seconds = Field(default=0.0, description="Time inside target_window without interruption (s).")
    target_timeout: Duration | None = Field(
        default=None,
        description="Time after the arrival of the setpoint within which that must be reached (s), > 0; needs "
        "target_window.",
        json_schema_extra={"x-unit": "s"},
    )
    software_limits: bool = Field(
        default=False, description="Watch the actual position against the software limits, with `lag` as margin."
    )
    velocity_lag: Velocity | None = Field(
        default=None,
        description="Largest velocity lag (u/s), > 0; more of it for longer than velocity_lag_time is an error.",
        json_schema_extra={"x-unit": "u/s"},
    )
    velocity_lag_time: Seconds = Field(
        default=0.0, description="For how long the velocity lag may be larger (s); a single cycle never counts."
    )
    motion_window: Window | None = Field(
        default=None,
        description="While the setpoint moves, the actual position changes by more than this (u), > 0, in at least "
        "one cycle of every motion_time; else it is an error.",
        json_schema_extra={"x-unit": "u"},
    )
    motion_time: Duration = Field(
        default=0.5, description="Longest time without a cycle of motion (s), > 0; see motion_window."
    )

    @field_validator("target_timeout")
    @classmethod
    def _needs_window(cls, timeout: float | None, info: ValidationInfo) -> float | None:
        if timeout is not None and info.data.get("target_window", 0.0) is None:
            raise PydanticCustomError("relation", "relation", {"allowed": "left out without target_window"})
        return timeout


class GroupDescription(Table):
    """Axes of which one in error concerns the others: `[group.NAME]`."""

    axes: tuple[str, ...] = Field(
        strict=False,  # TOML gives a list
        min_length=1,
        description="Names of the axes.",
    )
    reaction: Literal["none", "halt", "stop"] = Field(
        default="none",
        description='What the others do: nothing; "halt": brake with the dynamics of their motion; "stop": with their '
        "maximum.",
    )


class FaultDescription(Table):
    """Something that goes wrong with a servo drive: `[[fault]]`."""

    axis: Text = Field(description="Name of the axis; its drive is a servo.")
    kind: Literal["drive_error", "encoder_jump", "lost_enable", "lost_communication", "blocked"] = Field(
        description="What goes wrong."
    )
    tick: int | None = Field(default=None, ge=0, le=2**53, description="Tick of its begin; this or `time`.")
    time: Seconds | None = Field(
        default=None,
        description="Time of its begin (s), rounded up to a tick; this or `tick`.",
        json_schema_extra={"x-unit": "s"},
    )
    value: float | None = Field(
        default=None,
        allow_inf_nan=False,
        description="What the encoder is off (u); of an encoder_jump, which needs it.",
    )
    duration: Duration | None = Field(
        default=None,
        description="How long it lasts (s), > 0; default: a drive_error until it is reset, an encoder_jump always (it "
        "takes none), others to the end of the run.",
        json_schema_extra={"x-unit": "s"},
    )
