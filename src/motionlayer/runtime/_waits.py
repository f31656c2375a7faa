"""Waiting for time and for predicates: commands too, so that they combine with all others.

They end in the programs step before it is decided who is due, so that who awaits them, alone or in `any_of`, runs in
that very tick.

`run.sleep(1.0)` without `await` makes a wait and drops it. So those made in a turn of a program are kept until the turn
ends; what nobody awaits then and nobody else knows can have no effect any more. Ticks between turns cost nothing.
"""

import heapq
import sys
from collections.abc import Callable, Generator
from pathlib import Path
from types import CodeType, FrameType
from typing import Any, Final

from motionlayer.command import Command, ErrorId, Ledger, MotionError


class Sleep(Command[None]):
    """Wait until a tick; made by `run.sleep`."""

    def __init__(self, waits: "Waits", tick: int, seconds: float) -> None:
        super().__init__(f"sleep({seconds:g})")
        self.tick = tick
        self._waits = waits

    def on_end(self, listener: Callable[[], None], waiting: Callable[[], bool] = lambda: True) -> None:
        """Begin to count the time, with the first who waits."""
        if not self.awaited:
            self._waits.add_sleep(self)
        super().on_end(listener, waiting)


class Until(Command[None]):
    """Wait until a predicate holds; made by `run.until`. It is asked as long as somebody waits."""

    def __init__(self, waits: "Waits", predicate: Callable[[], bool], owner: Command[Any] | None) -> None:
        code = getattr(predicate, "__code__", None)
        # The name alone: the text reaches the hash of the run, which must not depend on where a file lies.
        where = f" at {Path(code.co_filename).name}:{code.co_firstlineno}" if code is not None else ""
        super().__init__(f"until(...){where}", owner=owner)
        self.predicate = predicate
        self._raised: Exception | None = None
        self._waits = waits

    def __await__(self) -> Generator[Command[Any], None, None]:
        if self.busy:
            yield self
        if self._raised is not None:
            raise self._raised
        return self.result

    def on_end(self, listener: Callable[[], None], waiting: Callable[[], bool] = lambda: True) -> None:
        """Begin to ask the predicate, with the first who waits."""
        if not self.awaited:
            self._waits.add_until(self)
        super().on_end(listener, waiting)

    def ask(self) -> bool:
        """Ask the predicate; tell whether there is nothing more to ask. What it raises comes up where it is awaited."""
        if not self.awaited or not self.busy:
            return True
        try:
            held = bool(self.predicate())
        except Exception as error:  # noqa: BLE001 - the program's own fault
            self._raised = error
            self.fail(MotionError(ErrorId.PROGRAM_FAILED, self.name, f"{type(error).__name__}: {error}"))
            return True
        if held:
            self.finish(None)
        return held


_DROPPED: Final = 3
"""References to a wait that nobody but `Waits.forgotten` knows: of the record, of its loop, of the question itself."""


class Waits:
    """All sleeps and predicates that somebody waits for.

    Args:
        ledger: its issuer names the program whose predicate is asked, for the watchdog.
    """

    def __init__(self, ledger: Ledger) -> None:
        self.asking = False
        """The waits of a tick are being ended: who hears of it is due in the same tick."""
        self._ledger = ledger
        self._sleeps: list[tuple[int, int, Sleep]] = []
        self._untils: list[Until] = []
        self._made: list[tuple[Sleep | Until, CodeType, int]] = []
        self._count = 0

    def made(self, wait: Sleep | Until, caller: FrameType) -> None:
        """Note a wait that a program made in its turn, and the line that did; not one of a predicate."""
        if self._ledger.issuer is not None and not self.asking:
            self._made.append((wait, caller.f_code, caller.f_lineno))

    def forgotten(self) -> list[tuple[str, str]]:
        """Return name and place of each wait of the turn that ends now which can have no effect any more."""
        if not self._made:
            return []
        made, self._made = self._made, []
        found = []
        for wait, code, line in made:
            if sys.getrefcount(wait) == _DROPPED and not wait.awaited:
                # The name alone: the text reaches the hash of the run, which must not depend on where a file lies.
                found.append(
                    (wait.name.partition(" at ")[0], f"{Path(code.co_filename).name}:{line} in {code.co_name}")
                )
        return found

    def add_sleep(self, sleep: Sleep) -> None:
        """End a sleep when its time has come."""
        self._count += 1
        heapq.heappush(self._sleeps, (sleep.tick, self._count, sleep))

    def add_until(self, until: Until) -> None:
        """Ask a predicate once per tick."""
        self._untils.append(until)

    def end(self, tick: int) -> None:
        """End what is over in this tick."""
        self.asking = True
        sleeps = self._sleeps
        while sleeps and sleeps[0][0] <= tick:
            sleep = heapq.heappop(sleeps)[2]
            if sleep.busy:
                sleep.finish(None)
        if self._untils:
            asked, self._untils = self._untils, []
            for until in asked:
                self._ledger.issuer = until.owner
                if not until.ask():
                    self._untils.append(until)
            self._ledger.issuer = None
        self.asking = False
