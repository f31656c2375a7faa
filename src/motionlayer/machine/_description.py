"""The models of a machine description: keys, units, ranges and defaults of every table.

Each model checks its own table, also values against one another; `_relations` checks what spans several
tables. u is the unit of the axis.
"""

from typing import Literal

from pydantic import Field, field_validator
from pydantic_core import PydanticCustomError

from motionlayer.machine._ads_description import AdsDescription
from motionlayer.machine._axis_description import AxisDescription
from motionlayer.machine._drive_description import (
    FaultDescription,
    GroupDescription,
)
from motionlayer.machine._fields import Positive, Table, Text
from motionlayer.machine._layer_description import ControlDescription, LayerDescription
from motionlayer.machine._log_description import LogDescription
from motionlayer.machine._realtime_description import RealTimeDescription
from motionlayer.machine._task_description import TaskDescription

FORMATS = (1,)
"""Formats of the machine file that are understood."""

SIGNALS = (
    "set_position",
    "set_velocity",
    "set_acceleration",
    "set_jerk",
    "actual_position",
    "lag",
    "max_velocity",
    "max_acceleration",
    "max_deceleration",
    "max_jerk",
    "software_limit_min",
    "software_limit_max",
    "state",
    "override",
    "enable",
    "ready",
)
"""Names of the signals every axis has in a trace; the full name is `<axis>.<signal>`."""

IDENTIFIER = r"^(?!.*__)[A-Za-z_][A-Za-z0-9_]*$"
"""An IEC 61131-3 identifier."""


class ProgramDescription(Table):
    """A program started with the run: `[program.pick]`."""

    file: Text = Field(description="Python file, relative to the folder of the machine file; must exist.")
    function: Text = Field(
        default="main",
        description="Name of the function in the file: `async def f(run)` runs from wait to wait, `def f(run)` or "
        "`def f(run, memory)` is called in every cycle of its task.",
    )
    task: Text | None = Field(
        default=None, description='Name of the task that calls a function without `async`; default: "main".'
    )
    prefix: str = Field(
        default="",
        description="Handed to the function as `prefix`, if it has such a parameter: what the names of its axes begin "
        "with. A module that is included with a prefix puts its own before this one.",
    )

    @field_validator("function")
    @classmethod
    def _is_a_name(cls, function: str) -> str:
        if not function.isidentifier():
            raise PydanticCustomError("relation", "relation", {"allowed": "the name of a Python function"})
        return function


class TraceDescription(Table):
    """What a trace records: `[trace]`."""

    signals: tuple[str, ...] = Field(
        default=("*",),
        strict=False,  # TOML gives a list
        description="Glob patterns of the signals to record, over `<axis>.<signal>`; each must match one.",
    )
    resolution: dict[str, Positive] = Field(
        default_factory=dict,
        description="Glob pattern of signals to the resolution (> 0, in the unit of the signal) in which "
        "they are recorded; other signals are recorded without loss.",
    )


class Description(Table):
    """A checked machine description; made by `load_description` or `check_description`."""

    format: Literal[1] = Field(description="Format of the machine file: 1.")
    name: Text = Field(description="Name of the machine.")
    base_cycle_ns: int = Field(
        default=1_000_000,
        ge=50_000,
        le=100_000_000,
        description="Base cycle (ns), 50 000 to 100 000 000.",
        json_schema_extra={"x-unit": "ns"},
    )
    seed: int = Field(default=0, ge=0, le=2**63 - 1, description="Seed of everything random in a run.")
    axis: dict[str, AxisDescription] = Field(
        default_factory=dict,
        description="The axes by name, in the order they have everywhere. A name is an IEC 61131-3 "
        "identifier, unique without regard to case. At least one, but for a machine with `[control]`.",
        json_schema_extra={"propertyNames": {"pattern": IDENTIFIER}, "minProperties": 1},
    )
    group: dict[str, GroupDescription] = Field(
        default_factory=dict, description="Groups of axes of which one in error concerns the others, by name."
    )
    fault: tuple[FaultDescription, ...] = Field(
        default=(),
        strict=False,  # TOML gives a list
        description="What goes wrong during the run.",
    )
    task: dict[str, TaskDescription] = Field(
        default_factory=dict,
        description='Tasks that call cyclic programs, by name; "main" is always there, by default in every tick.',
    )
    program: dict[str, ProgramDescription] = Field(
        default_factory=dict, description="Programs started with the run, in this order."
    )
    persistent_file: Text | None = Field(
        default=None,
        description="File of the parameters that are written persistently, relative to the folder of the machine "
        "file; default: they cannot be.",
    )
    realtime: RealTimeDescription = Field(
        default_factory=RealTimeDescription, description="What a real-time run asks of the computer."
    )
    layer: LayerDescription | None = Field(
        default=None, description="The motion layer: Ctrl and State for all axes; none without this table."
    )
    control: ControlDescription | None = Field(
        default=None, description="Ctrl and State of the motion layer of another machine; not beside `[layer]`."
    )
    ads: AdsDescription | None = Field(
        default=None, description="The ADS server, by which other programs reach the symbols; none without this table."
    )
    log: LogDescription | None = Field(default=None, description="The message files; none without this table.")
    trace: TraceDescription = Field(default_factory=TraceDescription, description="What a trace records.")
