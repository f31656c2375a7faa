"""`Machine`: a checked description and where it came from."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from motionlayer.machine._description import Description
from motionlayer.machine._load import check_description, load_description


@dataclass(frozen=True, slots=True)
class Machine:
    """A machine that has passed every check and can be run any number of times.

    Attributes:
        description: all values, defaults filled in.
        folder: what relative paths in it start from.
    """

    description: Description
    folder: Path

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> "Machine":
        """Read a machine file.

        Raises:
            MachineError: it cannot be read or describes no valid machine; names every problem with its line.
        """
        return cls(load_description(path), Path(path).parent)

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> "Machine":
        """Take a machine description as data; relative paths start from the working directory.

        Raises:
            MachineError: it describes no valid machine; names every problem.
        """
        return cls(check_description(data), Path())

    def __repr__(self) -> str:
        return f"<Machine {self.name}: {len(self.description.axis)} axes>"

    @property
    def name(self) -> str:
        """Name of the machine."""
        return self.description.name
