"""A progress bar for runs that take longer than a moment."""

import itertools
import time
from collections.abc import Callable, Iterable
from typing import Any, Final, Self, TextIO

import click

DELAY: Final = 0.5
"""Seconds of wall time before anything is shown."""

PERIOD: Final = 0.1
"""Seconds of wall time between two updates."""


class Progress:
    """Shows how far a run is, on a terminal and nowhere else. Call it with the tick now and then.

    Args:
        ticks: ticks of the run; None where only its programs know.
        base_cycle: s.
        stream: the terminal.
        clock: wall time in seconds.
    """

    def __init__(
        self, ticks: int | None, base_cycle: float, stream: TextIO, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._ticks = ticks
        self._base_cycle = base_cycle
        self._stream = stream
        self._clock = clock
        self._next = clock() + DELAY if stream.isatty() else float("inf")
        self._bar: Any = None
        self._shown = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.render_finish()

    def __call__(self, tick: int) -> None:
        now = self._clock()
        if now < self._next:
            return
        self._next = now + PERIOD
        if self._bar is None:
            self._bar = self._start()
        self._bar.update(tick - self._shown, f"{tick * self._base_cycle:.1f} s of the run")
        self._shown = tick

    def _start(self) -> Any:  # noqa: ANN401 - click does not export the type
        endless: Iterable[str] | None = itertools.repeat("") if self._ticks is None else None
        return click.progressbar(
            endless, length=self._ticks, label="simulating", item_show_func=lambda text: text, file=self._stream
        )
