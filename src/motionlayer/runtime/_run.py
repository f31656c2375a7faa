"""`Run`: what programs and their maker do with a run."""

import contextlib
import sys
from collections.abc import Callable, Coroutine, Iterator
from typing import Any

from motionlayer.runtime._cyclic import CyclicProgram
from motionlayer.runtime._guest import Guest
from motionlayer.runtime._loop import Loop
from motionlayer.runtime._program import CoroutineProgram, Deadline, Issuer, Program
from motionlayer.runtime._tasks import MAIN
from motionlayer.runtime._waits import Sleep, Until
from motionlayer.runtime._watchdog import Watchdog


class Run(Loop):
    """Cycles in order, and the programs in them; the arguments are those of `Ticking`."""

    @property
    def failures(self) -> list[Issuer]:
        """Programs that failed and that nobody awaited, and guests whose call has failed."""
        return self._scheduler.failures

    def guest(self, name: str) -> Guest:
        """Return what names code of the user's that is called outside of the programs step."""
        return Guest(name, self._ledger, self._scheduler)

    def start(self, coroutine: Coroutine[Any, Any, Any], name: str | None = None) -> Program:
        """Start a program; it first runs in the next programs step.

        Args:
            coroutine: `program()` of an `async def program()`.
            name: for messages; the function's name where left out.

        Raises:
            TypeError: it is not a coroutine.
        """
        return self._scheduler.start(coroutine, name or str(getattr(coroutine, "__name__", "program")))

    def cyclic(self, function: Callable[..., None], *, task: str = MAIN, name: str | None = None) -> CyclicProgram:
        """Start a cyclic program: a function that its task calls in each of its cycles, from the next programs step on.

        It goes on until `cancel()`, or until an exception leaves it.

        Args:
            function: `def function(run)`, or `def function(run, memory)` to keep something between the calls.
            task: what calls it, see `tasks`.
            name: for messages; the function's name where left out.

        Raises:
            KeyError: there is no such task.
            TypeError: it is no such function.
        """
        return self._scheduler.cyclic(function, self, name or str(getattr(function, "__name__", "program")), task)

    @property
    def program(self) -> Program:
        """The program that runs now.

        Raises:
            RuntimeError: none does.
        """
        program = self._ledger.issuer
        if not isinstance(program, Program):
            raise RuntimeError("run.program: no program runs now; ask for it inside one")
        return program

    def sleep(self, seconds: float) -> Sleep:
        """Wait, in a program, for a time of the run, rounded up to whole ticks; at least until the next tick.

        Raises:
            ValueError: negative, NaN or infinite.
        """
        waits = self._scheduler.waits
        sleep = Sleep(waits, self.tick + max(1, self._ticks("sleep", seconds)), seconds)
        waits.made(sleep, sys._getframe(1))  # noqa: SLF001 - the cheap way to the line, for who forgets to await
        return sleep

    def until(self, predicate: Callable[[], bool]) -> Until:
        """Wait, in a program, until `predicate()` holds; it is asked once per tick before programs run.

        Raises:
            TypeError: it cannot be called.
        """
        if not callable(predicate):
            raise TypeError(f"until({predicate!r}): give a function, as in until(lambda: axis.set_position > 100)")
        waits = self._scheduler.waits
        until = Until(waits, predicate, self._ledger.issuer)
        waits.made(until, sys._getframe(1))  # noqa: SLF001
        return until

    @contextlib.contextmanager
    def fail_after(self, seconds: float) -> Iterator[None]:
        """Raise TimeoutError in the program where it waits, once `seconds` of the run have passed in the block.

        Raises:
            RuntimeError: not called in a program.
            TimeoutError: the time has passed; the message names what was awaited.
            ValueError: negative, NaN or infinite.
        """
        ticks = max(1, self._ticks("fail_after", seconds))
        program = self._ledger.issuer
        if not isinstance(program, CoroutineProgram):
            raise RuntimeError("fail_after() guards what a coroutine waits for: use it inside one")
        deadline = Deadline(self.tick + ticks, seconds)
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
        """Run until all programs have ended and no axis brakes, or the time is over; what runs then is cancelled.

        Args:
            program: started first; an exception that leaves it is raised here in the end.
            time: seconds of the run, from now; without end where left out.
            watch: called with the tick now and then, for a progress bar; in real time after every tick.

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
        self._set_end("run", time)
        with Watchdog(self._ledger, self._patience) as watchdog:
            try:
                self._watched(watchdog, watch)
            finally:
                finished = self._over()
                self._scheduler.cancel_all()
        if main is not None and main.failure is not None:
            if main in self.failures:
                self.failures.remove(main)
            raise main.failure
        return finished
