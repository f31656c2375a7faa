"""`Row`: one thing that is measured, and what measuring it can come to."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, NamedTuple


class Skipped(Exception):  # noqa: N818 - nothing is wrong
    """The row cannot be measured here; its value stays empty."""


class Failed(Exception):  # noqa: N818 - the measurement, not the caller
    """What was to be measured did not work; the value stays empty and the exit code tells."""


class Effort(NamedTuple):
    """How much is measured.

    Attributes:
        samples: calls inside the process, >= 1.
        runs: processes started, >= 1.
    """

    samples: int = 2000
    runs: int = 5


class Figure(NamedTuple):
    """A measured value in the unit of its row, and what has to be said with it."""

    value: float
    note: str = ""


@dataclass(frozen=True, slots=True)
class Goal:
    """A bound: at most, or at least."""

    bound: float
    at_least: bool = False

    def met(self, value: float) -> bool:
        """Tell whether a value keeps the bound."""
        return value >= self.bound if self.at_least else value <= self.bound

    def __str__(self) -> str:
        return f"{'≥' if self.at_least else '≤'} {self.bound:g}"


class Peer(NamedTuple):
    """What a row is compared with: a package in `PINS`, and what of it is measured. Same unit as the row."""

    package: str
    what: str


@dataclass(frozen=True, slots=True)
class Row:
    """One thing that is measured.

    Attributes:
        name: `group of things.what`.
        unit: of the value, the goal and the peer's value.
        goal: what is promised.
        measure: measures; raises `Skipped` or `Failed`.
        peer: who does something comparable.
    """

    name: str
    unit: str
    goal: Goal
    measure: Callable[[Effort], Figure]
    peer: Peer | None = None


MICRO: Final = "µs"
