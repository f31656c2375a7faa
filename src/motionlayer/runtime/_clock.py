"""The clock that paces a run. Nothing below the runtime's edge looks at it.

It counts nanoseconds from some beginning and is never set: neither a person nor a time server that corrects the time of
day moves it, forward or back. On Linux it goes on while the computer is suspended, so that a run learns that
time has passed.
"""

import time
from typing import Final, Protocol


class Clock(Protocol):
    """A clock that never goes back, and a way to wait on it."""

    def now_ns(self) -> int:
        """Return nanoseconds since some beginning."""

    def sleep_until(self, instant: int) -> None:
        """Give the core away until about an instant (ns of this clock); not before, as a rule later."""


class SystemClock:
    """The clock of the computer."""

    def __init__(self) -> None:
        self._id = getattr(time, "CLOCK_BOOTTIME", time.CLOCK_MONOTONIC)

    def now_ns(self) -> int:
        """Return nanoseconds since the computer started."""
        return time.clock_gettime_ns(self._id)

    def sleep_until(self, instant: int) -> None:
        """Give the core away until an instant."""
        remaining = instant - self.now_ns()
        if remaining > 0:
            time.sleep(remaining * 1e-9)


SYSTEM: Final[Clock] = SystemClock()
"""The clock of the computer; all runs share it."""
