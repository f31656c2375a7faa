"""Kinds of values that the tables of a machine description are made of."""

from typing import Annotated, TypeAlias

from pydantic import AfterValidator, BaseModel, ConfigDict, Field
from pydantic_core import PydanticCustomError

from motionlayer.profile import RANGES


def _plannable(value: float) -> float:
    """Return a velocity, an acceleration or a jerk inside the ranges of planning."""
    if RANGES.smallest <= value <= RANGES.largest:
        return value
    raise PydanticCustomError("relation", "relation", {"allowed": f"from {RANGES.smallest} to {RANGES.largest}"})


def _reachable(value: float) -> float:
    """Return a position inside the ranges of planning."""
    if abs(value) <= RANGES.largest:
        return value
    raise PydanticCustomError("relation", "relation", {"allowed": f"from {-RANGES.largest} to {RANGES.largest}"})


Text: TypeAlias = Annotated[str, Field(min_length=1)]
Position: TypeAlias = Annotated[
    float, Field(allow_inf_nan=False, json_schema_extra={"x-unit": "u"}), AfterValidator(_reachable)
]
Positive: TypeAlias = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative: TypeAlias = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Width: TypeAlias = Annotated[NotNegative, Field(json_schema_extra={"x-unit": "u"})]
Window: TypeAlias = Annotated[Positive, Field(json_schema_extra={"x-unit": "u"})]
Seconds: TypeAlias = Annotated[NotNegative, Field(json_schema_extra={"x-unit": "s"})]
Duration: TypeAlias = Annotated[Positive, Field(json_schema_extra={"x-unit": "s"})]
Velocity: TypeAlias = Annotated[Positive, Field(json_schema_extra={"x-unit": "u/s"}), AfterValidator(_plannable)]
Acceleration: TypeAlias = Annotated[Positive, Field(json_schema_extra={"x-unit": "u/s²"}), AfterValidator(_plannable)]
Jerk: TypeAlias = Annotated[Positive, Field(json_schema_extra={"x-unit": "u/s³"}), AfterValidator(_plannable)]


class Table(BaseModel):
    """A table of the machine file."""

    # strict: an integer is a number, but "1" and true are not.
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)
