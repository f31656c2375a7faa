"""The watchdog of programs that do not yield. It looks at wall time, which nothing below the runtime's edge does."""

import ctypes
import signal
import sys
import threading
import time
import traceback
from itertools import dropwhile
from pathlib import Path
from types import FrameType, TracebackType
from typing import Final, Self

from motionlayer.command import Command, Ledger

PATIENCE: Final = 10.0
"""Seconds of wall time after which a program that does not yield is taken to be stuck."""

AGAIN: Final = 1.0
"""Least seconds until a program that swallowed an interrupt gets another: who handles the first must have ended."""

SHOWN: Final = 6
"""Frames of a stack that are shown, the innermost ones."""

_SCHEDULER: Final = Path(__file__).with_name("_scheduler.py")
"""Through its functions programs are called."""


class ProgramStuck(RuntimeError):  # noqa: N818 - the state, as a user would say it
    """A program did not yield; the run has ended. The message holds its stack."""


class Watchdog:
    """Interrupt a program that keeps the cycle from going on.

    It changes nothing in a run whose programs yield: it only looks.

    Args:
        ledger: tells which program runs, and in which tick.
        patience: seconds of wall time; see `PATIENCE`.
    """

    def __init__(self, ledger: Ledger, patience: float = PATIENCE) -> None:
        self.stuck: ProgramStuck | None = None
        self._ledger = ledger
        self._patience = patience
        self._over = threading.Event()
        self._cycle_thread = threading.get_ident()
        self._thread = threading.Thread(target=self._watch, name="motionlayer watchdog", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        self._thread.join()

    def _watch(self) -> None:
        seen: tuple[int, Command[object] | None] = (-1, None)
        since = time.monotonic()
        while not self._over.wait(self._patience / 4):
            now = (self._ledger.tick, self._ledger.issuer)
            if now != seen or now[1] is None:
                seen, since = now, time.monotonic()
            elif time.monotonic() - since >= (max(self._patience, AGAIN) if self.stuck else self._patience):
                self._interrupt(now[1])
                since = time.monotonic()

    def _interrupt(self, program: Command[object]) -> None:
        frame = sys._current_frames().get(self._cycle_thread)  # noqa: SLF001 - the documented way to another stack
        stack = "".join(traceback.format_list(_of_the_program(frame))) if frame is not None else ""
        self.stuck = ProgramStuck(
            f"program {program.name} has not yielded for {self._patience:g} s in tick {self._ledger.tick}; "
            f"await run.sleep(...) or run.until(...) in its loops; a cyclic program returns. It is here:\n{stack}"
        )
        # A signal also ends a blocking call. Only the main thread takes one, and a job in the background may ignore it.
        if self._cycle_thread == threading.main_thread().ident and callable(signal.getsignal(signal.SIGINT)):
            signal.pthread_kill(self._cycle_thread, signal.SIGINT)
        else:
            ctypes.pythonapi.PyThreadState_SetAsyncExc(
                ctypes.c_ulong(self._cycle_thread), ctypes.py_object(KeyboardInterrupt)
            )


def _of_the_program(frame: FrameType) -> list[traceback.FrameSummary]:
    """Return the innermost frames, from where the scheduler has called the program: how it came there says nothing."""
    frames = traceback.extract_stack(frame)
    inside = dropwhile(lambda one: Path(one.filename) != _SCHEDULER, frames)
    own = list(dropwhile(lambda one: Path(one.filename).parent == _SCHEDULER.parent, inside))
    return (own or frames)[-SHOWN:]
