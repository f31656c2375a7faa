"""What a command asked for, read from the text of the event that accepted it.

The text is the call: `move_absolute(position=300.0, velocity=20.0, buffer_mode=BLENDING_LOW)`. Dynamics that are those
of the axis by default, and `buffer_mode=ABORTING`, are left out. Numbers are written so that they read back exactly.
"""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Final

CALL: Final = re.compile(r"(\w+)\((.*)\)", re.DOTALL)

TO_POSITION: Final = ("move_absolute", "move_relative", "move_additive", "move_modulo")
CONTINUOUS: Final = ("move_continuous_absolute", "move_continuous_relative")
BRAKES: Final = ("halt", "stop", "emergency_stop")
MOTIONS: Final = (*TO_POSITION, *CONTINUOUS, *BRAKES, "move_velocity", "jog", "home")
"""Every command that plans serve."""


@dataclass(frozen=True)
class Request:
    """A call; empty where the text is none.

    Attributes:
        name: of the method.
        values: its arguments as they were written.
    """

    name: str
    values: Mapping[str, str]

    def number(self, name: str) -> float:
        """Return an argument that is a number; nan where it is missing or none."""
        try:
            return float(self.values[name])
        except (KeyError, ValueError):
            return math.nan

    def flag(self, name: str) -> bool:
        """Tell whether an argument is True."""
        return self.values.get(name) == "True"

    @property
    def mode(self) -> str:
        """When it begins: the buffer mode."""
        return self.values.get("buffer_mode", "ABORTING")

    @property
    def blends(self) -> bool:
        """Whether the running command is handed over without rest."""
        return self.mode.startswith("BLENDING_")

    @property
    def monitored(self) -> bool:
        """Whether the end of a positioning waits for a window of the actual position, where the axis has one."""
        return self.values.get("position_monitoring") != "False"

    @property
    def steps(self) -> bool:
        """Whether it is a jog by a step."""
        return self.name == "jog" and self.values.get("mode", "").startswith("INCHING")

    @property
    def to_position(self) -> bool:
        """Whether it ends at a position that it tells."""
        return self.name in TO_POSITION or self.steps

    @property
    def endless(self) -> bool:
        """Whether it goes on without end."""
        return self.name in CONTINUOUS or self.name == "move_velocity" or (self.name == "jog" and not self.steps)


@cache
def request(text: str) -> Request:
    """Read a call."""
    match = CALL.fullmatch(text)
    if match is None:
        return Request("", {})
    pairs = (argument.partition("=") for argument in match.group(2).split(", ") if argument)
    return Request(match.group(1), {name: value for name, _, value in pairs})
