"""How much memory the process holds, and how that grows while it runs."""

import gc
import os
import resource
import sys
from pathlib import Path
from typing import Final, NamedTuple

SAMPLES: Final = 1000
"""Times that it is looked at in a run."""

_STATM: Final = Path("/proc/self/statm")


def resident() -> int:
    """Return the resident memory of this process in bytes; where the system does not tell, the most it ever was."""
    if _STATM.exists():
        return int(_STATM.read_bytes().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


class Growth(NamedTuple):
    """How memory grew.

    Attributes:
        first: tick from which it counts.
        last: tick of the last look.
        start: resident memory at the first, in bytes.
        end: at the last one, in bytes.
        most: the most that was seen between the two, in bytes.
    """

    first: int
    last: int
    start: int
    end: int
    most: int

    @property
    def per_million(self) -> float:
        """Bytes in a million cycles; 0 without cycles."""
        return (self.end - self.start) * 1e6 / max(1, self.last - self.first)


class MemoryWatch:
    """Looks at the memory of the process now and then; call it with the tick, between ticks.

    Args:
        warm_up: what is before this tick does not count: caches fill, rings reach their length.
        cycles: ticks of the run.
        collect: collect garbage before the first look that counts; in real time that would make a tick late.
    """

    def __init__(self, warm_up: int, cycles: int, *, collect: bool) -> None:
        self._period = max(1, cycles // SAMPLES)
        self._next = warm_up
        self._collect = collect
        self._seen: list[int] = []
        self._first = self._last = 0

    def __call__(self, tick: int) -> None:
        """Look, if it is time."""
        if tick < self._next:
            return
        if not self._seen:
            self._first = tick
            if self._collect:
                gc.collect()
        self._next = tick + self._period
        self._last = tick
        self._seen.append(resident())

    def growth(self, tick: int) -> Growth | None:
        """Look for the last time; return what was seen, None if the run ended before its warm-up."""
        if not self._seen:
            return None
        gc.collect()
        end = resident()
        return Growth(self._first, tick, self._seen[0], end, max(*self._seen, end))
