"""What a run said, counted while it runs: the log of events itself keeps only the last ones."""

from collections import Counter
from typing import Final

from motionlayer.event import Digest, Event, Kind

KEPT: Final = 5
"""Errors and warnings that are listed: the last ones, errors first."""

_ENDS: Final = {Kind.DONE: "ended", Kind.ABORTED: "cancelled", Kind.ERROR: "failed"}


class Tally:
    """A listener of events.

    Attributes:
        said: errors and warnings, without the ends of programs.
        ends: number of programs by name and the way they ended, in order.
    """

    def __init__(self) -> None:
        self.said = Digest(KEPT)
        self.ends: Counter[tuple[str, str]] = Counter()

    def __call__(self, event: Event) -> None:
        """Take in an event."""
        _, is_program, name = event.source.partition("program ")
        if is_program and event.kind in _ENDS:
            self.ends[name, _ENDS[event.kind]] += 1
        else:
            self.said(event)
