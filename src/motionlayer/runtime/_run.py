"""`Run`: time, programs and the loop over ticks."""

import contextlib
import math
from collections.abc import Callable, Coroutine, Iterator
from typing import Any

from motionlayer.command import Ledger
from motionlayer.event import EventLog
from motionlayer.runtime._clock import PATIENCE, Watchdog
from motionlayer.runtime._cycle import Stage, Step, in_order
from motionlayer.runtime._program import Deadline, Program
from motionlayer.runtime._scheduler import Scheduler
from motionlayer.runtime._waits import Sleep, Until


class CycleFault(RuntimeError):  # noqa: N818 - the state, as a user would say it
    """A fault in a step of the runtime itself, not in a program; the run has ended. The cause is chained."""


class Run:
    """Cycles in order, and the programs in them.

    Args:
        stages: what a tick does.
        base_cycle_ns: length of a tick in nanoseconds.
        ledger: numbers and owners of commands.
        events: what happens.
        on_failure: called with a program that failed and that nobody awaits.
        patience: see `PATIENCE`.
    """

    def __init__(
        self,
        stages: list[Stage],
        *,
        base_cycle_ns: int,
        ledger: Ledger,
        events: EventLog,
        on_failure: Callable[[Program], None],
        patience: float = PATIENCE,
    ) -> None:
        self.events = events
        self.base_cycle_ns = base_cycle_ns
        self._ledger = ledger
        self._patience = patience
        self._scheduler = Scheduler(ledger, events, on_failure)
        self._calls = in_order([Stage(Step.PROGRAMS, "programs", self._scheduler.run), *stages])

    @property
    def tick(self) -> int:
        """Number of ticks that have begun; the present one inside a program."""
        return self._ledger.tick

    @property
    def time(self) -> float:
        """Time of the run in seconds: tick times base cycle."""
        return self._ledger.tick * self.base_cycle_ns * 1e-9

    @property
    def failures(self) -> list[Program]:
        """Programs that failed and that nobody awaited."""
        return self._scheduler.failures

    def start(self, coroutine: Coroutine[Any, Any, Any], name: str | None = None) -> Program:
        """Start a program; it first runs in the next programs step.

        Args:
            coroutine: `program()` of an `async def program()`.
            name: for messages; the function's name where left out.

        Raises:
            TypeError: it is not a coroutine.
        """
        return self._scheduler.start(coroutine, name or str(getattr(coroutine, "__name__", "program")))

    def sleep(self, seconds: float) -> Sleep:
        """Wait, in a program, for a time of the run, rounded up to whole ticks; at least until the next tick.

        Raises:
            ValueError: negative, NaN or infinite.
        """
        _check_seconds("sleep", seconds)
        return Sleep(self._scheduler.waits, self.tick + max(1, self._ticks(seconds)), seconds)

    def until(self, predicate: Callable[[], bool]) -> Until:
        """Wait, in a program, until `predicate()` holds; it is asked once per tick before programs run.

        Raises:
            TypeError: it cannot be called.
        """
        if not callable(predicate):
            raise TypeError(f"until({predicate!r}): give a function, as in until(lambda: axis.set_position > 100)")
        return Until(self._scheduler.waits, predicate, self._ledger.issuer)

    @contextlib.contextmanager
    def fail_after(self, seconds: float) -> Iterator[None]:
        """Raise TimeoutError in the program where it waits, once `seconds` of the run have passed in the block.

        Raises:
            RuntimeError: not called in a program.
            TimeoutError: the time has passed; the message names what was awaited.
            ValueError: negative, NaN or infinite.
        """
        _check_seconds("fail_after", seconds)
        program = self._ledger.issuer
        if not isinstance(program, Program):
            raise RuntimeError("fail_after() guards what a program waits for: use it inside one")
        deadline = Deadline(self.tick + max(1, self._ticks(seconds)), seconds)
        program.deadlines.append(deadline)
        try:
            yield
        finally:
            program.deadlines.remove(deadline)

    def run(
        self,
        program: Coroutine[Any, Any, Any] | None = None,
        *,
        time: float | None = None,
        watch: Callable[[int], None] | None = None,
    ) -> bool:
        """Run until all programs have ended or the time is over; what still runs then is cancelled.

        Args:
            program: started first; an exception that leaves it is raised here in the end.
            time: seconds of the run, from now; without end where left out.
            watch: called with the tick now and then, for a progress bar.

        Returns:
            True if all programs ended by themselves, False if the time cut them off.

        Raises:
            ProgramStuck: a program did not yield.
            CycleFault: a step of the runtime itself failed.
            ValueError: the time is negative, NaN or infinite, or neither a program nor a time was given, so that
                the run would never end.
        """
        main = self.start(program) if program is not None else None
        if main is None and not self._scheduler.programs and time is None:
            raise ValueError("run() without a program never ends: give a program or a time")
        if time is not None:
            _check_seconds("run", time)
        end = math.inf if time is None else self.tick + self._ticks(time)
        with Watchdog(self._ledger, self._patience) as watchdog:
            try:
                self._loop(end, watch)
            except KeyboardInterrupt:
                if watchdog.stuck is not None:
                    raise watchdog.stuck from None
                raise
            finally:
                finished = not self._scheduler.programs
                self._scheduler.cancel_all()
        if main is not None and main.failure is not None:
            if main in self.failures:
                self.failures.remove(main)
            raise main.failure
        return finished

    def step(self, ticks: int = 1) -> None:
        """Run a number of ticks, programs or not.

        Raises:
            RuntimeError: called in a program.
            CycleFault: a step of the runtime itself failed.
        """
        if self._ledger.issuer is not None:
            raise RuntimeError("a program cannot run ticks itself: await run.sleep(seconds) or a command")
        try:
            for _ in range(ticks):
                self._tick()
        except Exception as error:
            raise CycleFault(f"tick {self.tick}: {error}") from error

    def _loop(self, end: float, watch: Callable[[int], None] | None) -> None:
        programs = self._scheduler.programs
        alone = not programs  # nothing but the time ends the run
        while (programs or alone) and self.tick < end:
            self.step(256 if alone and self.tick + 256 < end else 1)
            if watch is not None and self.tick % 256 == 0:
                watch(self.tick)

    def _tick(self) -> None:
        ledger = self._ledger
        tick = ledger.tick
        for call in self._calls:
            call(tick)
        ledger.tick = tick + 1

    def _ticks(self, seconds: float) -> int:
        """Return seconds in whole ticks, rounded up; a rounding error of a millionth tick is none."""
        return math.ceil(seconds * 1e9 / self.base_cycle_ns - 1e-6)


def _check_seconds(call: str, seconds: float) -> None:
    if not 0.0 <= seconds < math.inf:
        raise ValueError(f"{call}({seconds}): must be finite and not negative, in seconds of the run")
