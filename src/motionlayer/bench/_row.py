"""`Row`: one thing that is measured, and what measuring it can come to."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

from motionlayer.bench._environment import Environment


class Skipped(Exception):  # noqa: N818 - nothing is wrong
    """The row cannot be measured here; its value stays empty."""


class Failed(Exception):  # noqa: N818 - the measurement, not the caller
    """What was to be measured did not work; the value stays empty and the exit code tells."""


class Effort(NamedTuple):
    """How much is measured.

    Attributes:
        samples: calls inside the process, >= 1.
        runs: processes started, >= 1.
        peers: where the peers are.
    """

    samples: int = 2000
    runs: int = 5
    peers: Environment = Environment()


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
    """What a row is compared with, in the same unit.

    Attributes:
        package: key of `PINS`.
        what: of it is measured.
        job: of the peers' script; one that several rows share is done once.
        work: returns what the job is given.
    """

    package: str
    what: str
    job: str
    work: Callable[[Effort], dict[str, Any]]


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
