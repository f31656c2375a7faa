"""The gate between two ticks, at which a run is held up: pause, go on, go on for some ticks."""

import math
import threading
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from motionlayer.runtime._source import Sleeper

LOOK: Final = 0.01
"""Seconds after which a run that is held up looks again at what has come from outside."""


class Latch:
    """Sleeps on a latch; a run that fetches nothing from outside needs no more."""

    def __init__(self) -> None:
        self._stirred = threading.Event()

    def sleep(self, seconds: float) -> None:
        """Return after a time, or when somebody stirs."""
        self._stirred.wait(seconds)
        self._stirred.clear()

    def stir(self) -> None:
        """Let who sleeps look at once."""
        self._stirred.set()


class Gate:
    """Lets ticks through; any thread may close and open it.

    An open gate costs the cycle one comparison. Only one that counts takes a lock, which nobody keeps for long: whoever
    counts ticks is not in a hurry.

    Attributes:
        sleeper: how the cycle waits at the gate.
    """

    def __init__(self) -> None:
        self._left = math.inf
        self._lock = threading.Lock()
        self.sleeper: Sleeper = Latch()

    @property
    def closed(self) -> bool:
        """No tick is let through."""
        return self._left == 0

    def close(self) -> None:
        """Let no further tick through."""
        with self._lock:
            self._left = 0

    def open(self, ticks: float = math.inf) -> None:
        """Let ticks through, and close after so many of them."""
        with self._lock:
            self._left = ticks
        self.stir()

    def take(self, ticks: int) -> int:
        """Return how many of these ticks may run now; for the cycle."""
        if self._left == math.inf:
            return ticks
        with self._lock:
            taken = int(min(ticks, self._left))
            self._left -= taken
        return taken

    def stir(self) -> None:
        """Let who waits look at once; for any thread."""
        self.sleeper.stir()

    def wait(self) -> bool:
        """Wait for a short time, until somebody stirs or until it opens; tell whether it is open."""
        self.sleeper.sleep(LOOK)
        return not self.closed
