"""How an axis finds its reference, and the simulated signals for it: `[axis.X.home]`."""

from typing import Any, Final, Literal

from pydantic import ConfigDict, Field, ValidationInfo, field_validator
from pydantic_core import PydanticCustomError

from motionlayer.machine._fields import Position, Table, Velocity, Width, Window

LATCH_KEYS: Final = {
    "index": "pulse_period",
    "software_sync": "turn",
    "latch_positive": "latch",
    "latch_negative": "latch",
    "soft_latch_positive": "latch",
    "soft_latch_negative": "latch",
}
"""The modes of a homing whose reference the drive latches, each with the key that gives the drive the signal."""


def _velocity_is_optional(schema: dict[str, Any]) -> None:
    """Correct the JSON schema: the axis adds the search velocity where the file leaves it out."""
    schema["required"].remove("velocity")
    if not schema["required"]:
        del schema["required"]


class HomeDescription(Table):
    """How an axis finds its reference: `[axis.X.home]`."""

    model_config = ConfigDict(json_schema_extra=_velocity_is_optional)

    mode: Literal[
        "direct",
        "switch",
        "cam",
        "index",
        "software_sync",
        "latch_positive",
        "latch_negative",
        "soft_latch_positive",
        "soft_latch_negative",
    ] = Field(
        default="direct",
        description='"direct": the present position becomes `position`; "switch": search the edge of the switch; '
        '"cam": search it, turn, and take the edge at which the axis leaves it. The others take what comes behind that '
        'edge: "index": the zero pulse; "software_sync": the overflow of the encoder\'s count; "latch_positive", '
        '"latch_negative": the rising or falling edge of the latch input; "soft_latch_positive", '
        '"soft_latch_negative": the same as the program of the drive sees it, up to a cycle later.',
    )
    position: Position = Field(default=0.0, description="Reference position, of the edge or of what is latched (u).")
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
    turn: Window | None = Field(
        default=None,
        validate_default=True,
        description="From one overflow of the encoder's count to the next (u), > 0: the reference mask and one, in "
        'increments; one is at drive position 0. Needed for mode "software_sync".',
    )
    latch: Position | None = Field(
        default=None,
        validate_default=True,
        description="Drive position from which on the simulated latch input is on (u); needed for the modes that "
        "latch its edges.",
        json_schema_extra={"x-unit": "u"},
    )
    latch_width: Window | None = Field(
        default=None, description="How far it is on (u), > 0. Default: up to the end of the way."
    )
    pulse_distance: Width = Field(
        default=0.0,
        description="Least distance of what is latched from the edge of the cam (u); nearer it is an error.",
    )

    @field_validator("switch", "pulse_period", "turn", "latch")
    @classmethod
    def _needed_for_mode(cls, value: float | None, info: ValidationInfo) -> float | None:
        mode = info.data.get("mode", "direct")
        needed = mode != "direct" if info.field_name == "switch" else LATCH_KEYS.get(mode) == info.field_name
        if value is None and needed:
            raise PydanticCustomError("missing", "missing", {"hint": f'mode = "{mode}" needs it'})
        return value

    @field_validator("latch_width")
    @classmethod
    def _width_of_something(cls, width: float | None, info: ValidationInfo) -> float | None:
        if width is not None and info.data.get("latch", 0.0) is None:
            raise PydanticCustomError("relation", "relation", {"allowed": "left out without latch"})
        return width
