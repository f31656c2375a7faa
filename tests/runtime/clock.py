"""A clock that tests move by hand."""

from collections.abc import Callable

MS = 1_000_000
"""Nanoseconds."""


class FakeClock:
    """Every look at it costs a little time, and a sleep ends late by what `oversleep` says.

    Attributes:
        now: nanoseconds.
        reads: looks at it.
        sleeps: instants until which somebody slept.
    """

    def __init__(self, *, read_ns: int = 50, oversleep: Callable[[], int] = lambda: 0) -> None:
        self.now = 5_000 * MS
        self.reads = 0
        self.sleeps: list[int] = []
        self._read_ns = read_ns
        self._oversleep = oversleep

    def now_ns(self) -> int:
        self.now += self._read_ns
        self.reads += 1
        return self.now

    def sleep_until(self, instant: int) -> None:
        self.sleeps.append(instant)
        self.now = max(self.now, instant) + self._oversleep()

    def work(self, ns: int) -> None:
        """Let time pass, as a slow program or a suspended computer does."""
        self.now += ns
