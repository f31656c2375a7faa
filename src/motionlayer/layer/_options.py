"""What the machine file says about the motion layer, as far as its engine is concerned."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from motionlayer.layer._constants import Features, Sizes

NAMESPACES: Final = ("axis", "functions", "nci", "cam", "saw")
"""In the order in which a cycle calls them (motion-layer 1.2)."""


@dataclass(frozen=True, slots=True)
class Schedule:
    """When a namespace is called: in the ticks n with n mod divisor = phase.

    Attributes:
        divisor: calls it in every so many ticks, from 1.
        phase: 0 to divisor - 1; namespaces with different phases spread their load.
    """

    divisor: int = 1
    phase: int = 0

    def __post_init__(self) -> None:
        if self.divisor < 1 or not 0 <= self.phase < self.divisor:
            given = f"divisor {self.divisor}, phase {self.phase}"
            raise ValueError(f"{given}: allowed are 1 <= divisor, 0 <= phase < divisor")

    def holds(self, tick: int) -> bool:
        """Tell whether the namespace is called in a tick."""
        return tick % self.divisor == self.phase


@dataclass(frozen=True, slots=True)
class LayerOptions:
    """How the layer works.

    Attributes:
        sizes: how many objects there are; `max_axis` is the number of axes.
        features: what is built in.
        timeout: longest time that switching on or off, or a reset, may take, s; then the command fails and `bTimeout`
            is set.
        schedule: when each of `NAMESPACES` is called; every tick where left out.
    """

    sizes: Sizes
    features: Features = field(default_factory=Features)
    timeout: float = 5.0
    schedule: Mapping[str, Schedule] = field(default_factory=dict)

    def __post_init__(self) -> None:
        unknown = [name for name in self.schedule if name not in NAMESPACES]
        if unknown:
            raise ValueError(f"no namespace {unknown[0]!r} to schedule; there are {', '.join(NAMESPACES)}")
