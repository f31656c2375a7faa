"""Ctrl-C: at once in a program, between two ticks elsewhere.

Interrupted in the middle of a step, a run could not be trusted to end its trace in order. Programs, on the other
hand, must be interrupted where they are: the watchdog sends the same signal to one that does not yield.
"""

import contextlib
import signal
from collections.abc import Callable, Iterator
from types import FrameType
from typing import Final

from motionlayer.runtime import Program

SWALLOWED: Final = 2
"""Interrupts that a program may swallow (`except BaseException`) before it is given up."""


class Interrupts:
    """The handler of SIGINT during a run.

    Args:
        give_up: called when a program swallows every interrupt; must not return.
    """

    def __init__(self, give_up: Callable[[], None]) -> None:
        self._give_up = give_up
        self._pending = False
        self._thrown = 0

    def check(self, tick: int) -> None:  # noqa: ARG002 - called as the watch of a run
        """Raise KeyboardInterrupt if one is waiting; called between ticks."""
        if self._pending:
            raise KeyboardInterrupt

    def handle(self, number: int, frame: FrameType | None) -> None:  # noqa: ARG002 - as signal has it
        """Handle a SIGINT."""
        if _in_program(frame):
            self._thrown += 1
            if self._thrown > SWALLOWED:
                self._give_up()
        elif not self._pending:  # the second one means now: a predicate may never return
            self._pending = True
            return
        raise KeyboardInterrupt


def _in_program(frame: FrameType | None) -> bool:
    while frame is not None:
        if frame.f_code is Program.resume.__code__:
            return True
        frame = frame.f_back
    return False


@contextlib.contextmanager
def orderly(give_up: Callable[[], None]) -> Iterator[Callable[[int], None]]:
    """Handle SIGINT within the block; yields what has to be called between ticks."""
    interrupts = Interrupts(give_up)
    before = signal.signal(signal.SIGINT, interrupts.handle)
    try:
        yield interrupts.check
    finally:
        signal.signal(signal.SIGINT, before)
