"""The gate between two ticks, at which a run is held up: pause, go on, go on for some ticks."""

import math
import threading
from typing import Final

LOOK: Final = 0.01
"""Seconds after which a run that is held up looks again at what has come from outside."""


class Gate:
    """Lets ticks through; any thread may close and open it.

    An open gate costs the cycle one comparison. Only one that counts takes a lock, which nobody keeps for long: whoever
    counts ticks is not in a hurry.
    """

    def __init__(self) -> None:
        self._left = math.inf
        self._lock = threading.Lock()
        self._stirred = threading.Event()

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
        self._stirred.set()

    def wait(self) -> bool:
        """Wait for a short time, until somebody stirs or until it opens; tell whether it is open."""
        self._stirred.wait(LOOK)
        self._stirred.clear()
        return not self.closed
