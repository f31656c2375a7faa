"""Faults that can be put upon a simulated drive, and when they take effect."""

import enum
import heapq
import math
from dataclasses import dataclass
from typing import Final, NamedTuple


class FaultKind(enum.StrEnum):
    """What can go wrong with a servo drive; see `FAULTS`."""

    DRIVE_ERROR = "drive_error"
    ENCODER_JUMP = "encoder_jump"
    LOST_ENABLE = "lost_enable"
    LOST_COMMUNICATION = "lost_communication"
    BLOCKED = "blocked"


class FaultText(NamedTuple):
    """What a kind does, how long where no duration is given (s), and whether it takes a value."""

    effect: str
    duration: float
    takes_value: bool = False


FAULTS: Final[dict[FaultKind, FaultText]] = {
    FaultKind.DRIVE_ERROR: FaultText(
        "the drive switches itself off and brakes; a reset clears it once the duration is over", 0.0
    ),
    FaultKind.ENCODER_JUMP: FaultText("the encoder is off by `value` from now on", 0.0, takes_value=True),
    FaultKind.LOST_ENABLE: FaultText("the enable input opens: no power, the drive brakes", math.inf),
    FaultKind.LOST_COMMUNICATION: FaultText(
        "actual values are stale; the drive goes on with its last velocity, after its patience it brakes", math.inf
    ),
    FaultKind.BLOCKED: FaultText("the mechanics are stuck: nothing moves, whatever the drive does", math.inf),
}
"""Per kind: what happens."""


@dataclass(frozen=True, slots=True)
class Fault:
    """Something that goes wrong with a servo drive.

    Args:
        kind: one of `FaultKind`, or its text.
        value: of an encoder jump, u; no other kind takes one.
        duration: seconds, rounded up to whole cycles, at least one; where left out see `FAULTS`. An encoder jump
            takes none: it stays.

    Raises:
        ValueError: no such kind; value or duration missing, not finite, negative, or given where there is none.
    """

    kind: FaultKind | str
    value: float | None = None
    duration: float | None = None

    def __post_init__(self) -> None:
        known = ", ".join(FaultKind)
        if self.kind not in list(FaultKind):
            raise ValueError(f"fault {self.kind!r}: possible are {known}")
        object.__setattr__(self, "kind", FaultKind(self.kind))
        if FAULTS[FaultKind(self.kind)].takes_value:
            if self.value is None or not math.isfinite(self.value):
                raise ValueError(f"fault {self.kind}: value = {self.value}, must be a finite number")
            if self.duration is not None:
                raise ValueError(f"fault {self.kind}: takes no duration, it stays")
        elif self.value is not None:
            raise ValueError(f"fault {self.kind}: takes no value")
        if self.duration is not None and not self.duration > 0.0:
            raise ValueError(f"fault {self.kind}: duration = {self.duration}, must be greater than 0")

    def ticks(self, dt: float) -> float:
        """Return the duration in whole cycles of `dt` seconds; infinite without an end."""
        seconds = FAULTS[FaultKind(self.kind)].duration if self.duration is None else self.duration
        return seconds if seconds in {0.0, math.inf} else float(max(1, math.ceil(seconds / dt - 1e-6)))


class Agenda:
    """Faults in order of their ticks; those of one tick in the order in which they were added."""

    def __init__(self) -> None:
        self._entries: list[tuple[int, int, int, Fault]] = []
        self._added = 0
        self.next = math.inf
        """Tick of the next fault; infinite without one."""

    def add(self, tick: int, drive: int, fault: Fault) -> None:
        """Let a drive have a fault at a tick."""
        heapq.heappush(self._entries, (tick, self._added, drive, fault))
        self._added += 1
        self.next = self._entries[0][0]

    def take(self, tick: int) -> list[tuple[int, Fault]]:
        """Return (drive, fault) of all that are due at `tick`, and forget them."""
        due = []
        while self._entries and self._entries[0][0] <= tick:
            _, _, drive, fault = heapq.heappop(self._entries)
            due.append((drive, fault))
        self.next = self._entries[0][0] if self._entries else math.inf
        return due
