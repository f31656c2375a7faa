"""From ticks to local time, as text."""

import time
from collections.abc import Callable
from datetime import UTC, datetime
from typing import Final, NamedTuple

Offset = Callable[[int], int]
"""Local time less UTC in seconds, at a time in seconds since 1970 UTC."""

DAY: Final = 86_400
FAR: Final = 3 * DAY
"""How long before a moment the midnights are gone through one by one: a jump of the offset shows in two of them."""

SECOND: Final = 1_000_000_000
MILLISECOND: Final = 1_000_000


def local_offset(second: int) -> int:
    """Return the offset that the time zone of the operating system has at a time."""
    return time.localtime(second).tm_gmtoff


class Shift(NamedTuple):
    """The local time jumped: its offset before and after, in seconds."""

    before: int
    after: int


class LocalTime:
    """The local time of ticks.

    The offset is looked up at the first tick and at each local midnight (motion-layer 8.3), so within a day the text
    never goes back. After a day in which daylight saving time ended, the hour from 23:00 comes twice.

    Args:
        epoch_ns: time of tick 0, ns since 1970 UTC.
        cycle_ns: length of a tick.
        offset: looks up the offset.

    Attributes:
        date: the local date of the last text, `YYYY_MM_DD`.
        midnights: counts up when one or more have passed; the date can only have changed when this has.
        shift: how the local time jumped with that; None if it did not.
    """

    def __init__(self, epoch_ns: int, cycle_ns: int, offset: Offset = local_offset) -> None:
        self.date = ""
        self.midnights = 0
        self.shift: Shift | None = None
        self._epoch = epoch_ns
        self._cycle = cycle_ns
        self._look_up = offset
        first = epoch_ns // SECOND
        self._offset = offset(first)
        self._midnight = first
        self._begin_day()
        self._tick = self._second = -1
        self._text = self._head = ""

    def text(self, tick: int) -> str:
        """Return the time of a tick as `YYYY-MM-DD-hh:mm:ss.xxx`, cut to whole milliseconds."""
        if tick != self._tick:
            second, rest = divmod(self._epoch + tick * self._cycle, SECOND)
            if second != self._second:
                self._turn(second)
            self._tick = tick
            self._text = f"{self._head}{rest // MILLISECOND:03d}"
        return self._text

    def slip(self, ns: int) -> None:
        """Let all ticks from now on be later by `ns`."""
        self._epoch += ns
        self._tick = -1

    def _turn(self, second: int) -> None:
        """Go on to another second, through the midnights before it; of many only the last ones matter."""
        if second >= self._midnight:
            before = self._offset
            if second - self._midnight > FAR:
                self._skip(second - FAR)
            while second >= self._midnight:
                self._offset = self._look_up(self._midnight)
                self._begin_day()
            self.midnights += 1
            self.shift = Shift(before, self._offset) if before != self._offset else None
        self._second = second
        self._head = datetime.fromtimestamp(second + self._offset, UTC).strftime("%Y-%m-%d-%H:%M:%S.")

    def _skip(self, second: int) -> None:
        """Go to a second as if all began there: decades lie between 1970 and the first tick of a real-time run."""
        self._offset = self._look_up(second)
        self._midnight = second
        self._begin_day()

    def _begin_day(self) -> None:
        """Set the date at what was the next midnight, and the midnight after it."""
        local = self._midnight + self._offset
        self.date = datetime.fromtimestamp(local, UTC).strftime("%Y_%m_%d")
        self._midnight += DAY - local % DAY
