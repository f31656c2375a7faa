"""Kinds of values that the tables of a machine description are made of."""

from typing import Annotated, TypeAlias

from pydantic import BaseModel, ConfigDict, Field

Text: TypeAlias = Annotated[str, Field(min_length=1)]
Position: TypeAlias = Annotated[float, Field(allow_inf_nan=False, json_schema_extra={"x-unit": "u"})]
Positive: TypeAlias = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative: TypeAlias = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Width: TypeAlias = Annotated[NotNegative, Field(json_schema_extra={"x-unit": "u"})]
Window: TypeAlias = Annotated[Positive, Field(json_schema_extra={"x-unit": "u"})]
Seconds: TypeAlias = Annotated[NotNegative, Field(json_schema_extra={"x-unit": "s"})]
Duration: TypeAlias = Annotated[Positive, Field(json_schema_extra={"x-unit": "s"})]
Velocity: TypeAlias = Annotated[Positive, Field(json_schema_extra={"x-unit": "u/s"})]
Acceleration: TypeAlias = Annotated[Positive, Field(json_schema_extra={"x-unit": "u/s²"})]
Jerk: TypeAlias = Annotated[Positive, Field(json_schema_extra={"x-unit": "u/s³"})]


class Table(BaseModel):
    """A table of the machine file."""

    # strict: an integer is a number, but "1" and true are not.
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)
