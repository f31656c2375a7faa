"""The tables that put modules into a machine: `[[module]]`, and what a module file itself may hold."""

import re
from typing import Any

from pydantic import Field, field_validator
from pydantic_core import PydanticCustomError

from motionlayer.machine._fields import Table, Text

PREFIX = r"^([A-Za-z_][A-Za-z0-9_]*)?$"
"""The begin of an IEC 61131-3 identifier, or nothing."""


class ModuleDescription(Table):
    """A module file put into the machine: `[[module]]`."""

    file: Text = Field(description="TOML file, relative to the folder of the file that includes it.")
    prefix: str = Field(
        default="",
        description='What the names of its axes, groups, tasks and programs begin with here, such as "S1_".',
        json_schema_extra={"pattern": PREFIX},
    )
    set: dict[str, Any] = Field(
        default_factory=dict,
        description='Values in the place of those of the module: its key in quotes, such as "axis.X.max_velocity", to '
        "the value. Names are those of the module, without the prefix.",
    )

    @field_validator("prefix")
    @classmethod
    def _begins_a_name(cls, prefix: str) -> str:
        if not re.fullmatch(PREFIX, prefix):
            allowed = "letters, digits and underscores, not beginning with a digit"
            raise PydanticCustomError("relation", "relation", {"allowed": allowed})
        return prefix
