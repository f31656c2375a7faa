"""The model of a task."""

from pydantic import Field, ValidationInfo, field_validator
from pydantic_core import PydanticCustomError

from motionlayer.machine._fields import Duration, Table
from motionlayer.runtime import BUDGET


class TaskDescription(Table):
    """A task that calls cyclic programs: `[task.fast]`."""

    every: int = Field(
        default=1,
        ge=1,
        le=1_000_000,
        description="Base cycles from one call of its programs to the next, 1 to 1 000 000.",
    )
    phase: int | None = Field(
        default=None,
        ge=0,
        description="The first tick in which it runs, 0 to every - 1; by default chosen so that the tasks spread over "
        "the ticks.",
    )
    budget: Duration | None = Field(
        default=None,
        description="Compute time of all its programs together (s), at most the base cycle; more is counted, and a "
        f"warning in real time. Default: {BUDGET:g} of the base cycle.",
        json_schema_extra={"x-unit": "s"},
    )

    @field_validator("phase")
    @classmethod
    def _below_every(cls, phase: int | None, info: ValidationInfo) -> int | None:
        every = info.data.get("every")
        if phase is not None and every is not None and phase >= every:
            raise PydanticCustomError("relation", "relation", {"allowed": f"from 0 to every - 1 = {every - 1}"})
        return phase
