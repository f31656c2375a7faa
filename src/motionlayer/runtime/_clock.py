"""The wall clock, and the watchdog that needs it. Nothing below the runtime's edge looks at either."""

import ctypes
import signal
import sys
import threading
import time
import traceback
from types import TracebackType
from typing import Final, Self

from motionlayer.command import Command, Ledger

PATIENCE: Final = 10.0
"""Seconds of wall time after which a program that does not yield is taken to be stuck."""


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
            elif time.monotonic() - since >= self._patience:
                self._interrupt(now[1])
                since = time.monotonic()

    def _interrupt(self, program: Command[object]) -> None:
        frame = sys._current_frames().get(self._cycle_thread)  # noqa: SLF001 - the documented way to another stack
        stack = "".join(traceback.format_stack(frame)[-6:]) if frame is not None else ""
        self.stuck = ProgramStuck(
            f"program {program.name} has not yielded for {self._patience:g} s in tick {self._ledger.tick}; "
            f"await run.sleep(...) or run.until(...) in its loops. It is here:\n{stack}"
        )
        # A signal also ends a blocking call. Only the main thread takes one, and a job in the background may ignore it.
        if self._cycle_thread == threading.main_thread().ident and callable(signal.getsignal(signal.SIGINT)):
            signal.pthread_kill(self._cycle_thread, signal.SIGINT)
        else:
            ctypes.pythonapi.PyThreadState_SetAsyncExc(
                ctypes.c_ulong(self._cycle_thread), ctypes.py_object(KeyboardInterrupt)
            )
