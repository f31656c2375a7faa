"""Signals that end a run: at once in the wait for a tick, elsewhere after the tick.

Interrupted in the middle of a step, a run could not be trusted to end its trace in order; interrupted in a program, it
could not be replayed, because nobody knows how far the program had come. But a program may never yield: it is
interrupted where it is if it still runs after `GRACE`, or when another signal comes.

======= ================================ ====
signal  who sends it                     exit
======= ================================ ====
SIGINT  Ctrl-C                           130
SIGTERM a service manager, `kill`        143
SIGHUP  a terminal that has been closed  129
======= ================================ ====

All three end the run in the same order: programs cancelled, trace and logs closed. A SIGHUP that was ignored when the
command began, as under `nohup`, stays ignored.
"""

import contextlib
import signal
from collections.abc import Callable, Iterator
from types import CodeType, FrameType
from typing import Final, NoReturn

from motionlayer.cli._exit import ExitCode
from motionlayer.runtime import Pace, Program, Run

SWALLOWED: Final = 2
"""Interrupts that a program may swallow (`except BaseException`) before it is given up."""

GRACE: Final = 0.25
"""Seconds of wall time that a program has for coming to its next wait."""

SIGNALS: Final = {
    signal.SIGINT: (ExitCode.INTERRUPTED, "interrupted"),
    signal.SIGTERM: (ExitCode.TERMINATED, "terminated"),
    signal.SIGHUP: (ExitCode.HUNG_UP, "the terminal was closed"),
}
"""How a run ends for each signal, and what is said."""


class Interrupts:
    """The handler of the signals during a run.

    Args:
        run: what they end.
        give_up: called when a program swallows every interrupt; must not return.

    Attributes:
        first: the signal that ended the run, None where none came.
    """

    def __init__(self, run: Run, give_up: Callable[[], None]) -> None:
        self.first: signal.Signals | None = None
        self._run = run
        self._give_up = give_up
        self._thrown = 0

    @property
    def ending(self) -> tuple[ExitCode, str]:
        """Exit code and what is said; that of Ctrl-C if no signal came, but an interrupt all the same."""
        return SIGNALS[self.first or signal.SIGINT]

    def handle(self, number: int, frame: FrameType | None) -> None:
        """Handle a signal."""
        another = self.first is not None
        if not another:
            self.first = signal.Signals(number)
        if another or _inside(frame, Pace.wait.__code__):  # the second one means now: a predicate may never return
            self._interrupt(frame)
        self._run.stop(self.ending[1])
        signal.setitimer(signal.ITIMER_REAL, GRACE, GRACE)

    def insist(self, _number: int, frame: FrameType | None) -> None:
        """Interrupt a program that has not yielded since the first signal; handles that of the timer."""
        if self._run.ticking and _inside(frame, Program.resume.__code__):
            self._interrupt(frame)

    def _interrupt(self, frame: FrameType | None) -> NoReturn:
        if _inside(frame, Program.resume.__code__):
            self._thrown += 1
            if self._thrown > SWALLOWED:
                self._give_up()
        raise KeyboardInterrupt(self.ending[1])


def _inside(frame: FrameType | None, code: CodeType) -> bool:
    while frame is not None:
        if frame.f_code is code:
            return True
        frame = frame.f_back
    return False


@contextlib.contextmanager
def orderly(run: Run, give_up: Callable[[], None]) -> Iterator[Interrupts]:
    """Let the signals end a run within the block."""
    interrupts = Interrupts(run, give_up)
    before = {number: signal.getsignal(number) for number in (*SIGNALS, signal.SIGALRM)}
    ours = [number for number in before if number is not signal.SIGHUP or before[number] is not signal.SIG_IGN]
    for number in ours:
        signal.signal(number, interrupts.insist if number is signal.SIGALRM else interrupts.handle)
    try:
        yield interrupts
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        for number in ours:
            signal.signal(number, before[number])
