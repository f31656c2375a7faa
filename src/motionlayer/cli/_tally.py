"""What a run said, counted while it runs: the log of events itself keeps only the last ones."""

from collections import Counter, deque
from typing import Final

from motionlayer.event import Event, Kind, Level

KEPT: Final = 5
"""Warnings and errors that are shown in full: the last ones."""

_ENDS: Final = {Kind.DONE: "ended", Kind.ABORTED: "cancelled", Kind.ERROR: "failed"}


class Tally:
    """A listener of events.

    Attributes:
        levels: number of warnings and errors by level, without the ends of programs.
        last: the last of them.
        ends: number of programs by name and the way they ended, in order.
    """

    def __init__(self) -> None:
        self.levels: Counter[Level] = Counter()
        self.last: deque[Event] = deque(maxlen=KEPT)
        self.ends: Counter[tuple[str, str]] = Counter()

    def __call__(self, event: Event) -> None:
        """Take in an event."""
        _, is_program, name = event.source.partition("program ")
        if is_program and event.kind in _ENDS:
            self.ends[name, _ENDS[event.kind]] += 1
        elif event.level <= Level.WARNING:
            self.levels[event.level] += 1
            self.last.append(event)
