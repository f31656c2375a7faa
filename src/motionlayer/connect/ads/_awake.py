"""`Awake`: to wait for an answer that comes soon without falling asleep.

A process that sleeps has to be woken up, and so does the core it slept on; between the processes of a run and of its
server that takes several times longer than what is asked. So who has been asked a moment ago looks for more for a
moment. While others need the cores that is a loss; it shows in that nothing comes in that moment, and then nobody stays
awake for a while.
"""

import os
import time
from collections.abc import Callable
from typing import Final

REST: Final = 0.02
"""Seconds without staying awake after that was in vain."""


class Awake:
    """Looks instead of sleeping, while that takes nothing from others.

    Args:
        cores: that this process may use; with one, whoever is waited for could not work meanwhile.
        now: returns seconds of some clock.
        give_way: lets others have the core.
    """

    def __init__(
        self,
        cores: int,
        now: Callable[[], float] = time.perf_counter,
        give_way: Callable[[], None] = os.sched_yield,
    ) -> None:
        self._now = now
        self._give_way = give_way
        self._from = now() if cores > 1 else float("inf")

    def until(self, come: Callable[[], object], end: float) -> bool:
        """Look until something has come.

        Args:
            come: tells whether it has.
            end: time of the clock at which to look no more.

        Returns:
            Whether it has come; if not, sleep until it does.
        """
        now = self._now()
        if now < self._from:
            return False
        while now < end:
            if come():
                return True
            self._give_way()
            now = self._now()
        self._from = now + REST
        return False
