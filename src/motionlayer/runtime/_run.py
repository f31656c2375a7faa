"""`Run`: time, programs and the loop over ticks."""

import contextlib
import math
from collections.abc import Callable, Coroutine, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from motionlayer.command import Ledger
from motionlayer.event import Event, EventLog
from motionlayer.runtime._breakpoints import Breakpoints
from motionlayer.runtime._clock import SYSTEM
from motionlayer.runtime._cycle import Stage, Step, in_order
from motionlayer.runtime._cyclic import CyclicProgram
from motionlayer.runtime._gate import Gate
from motionlayer.runtime._image import Areas
from motionlayer.runtime._mailbox import Mailbox
from motionlayer.runtime._meter import Meter
from motionlayer.runtime._program import CoroutineProgram, Deadline, Program
from motionlayer.runtime._scheduler import Scheduler
from motionlayer.runtime._statistics import Histogram, Statistics
from motionlayer.runtime._tasks import MAIN, TaskConfig, Tasks
from motionlayer.runtime._waits import Sleep, Until
from motionlayer.runtime._watchdog import PATIENCE, Watchdog

if TYPE_CHECKING:
    from motionlayer.runtime._pace import Pace


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
        tasks: what calls cyclic programs, beside the task "main".
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
        tasks: Sequence[TaskConfig] = (),
        patience: float = PATIENCE,
    ) -> None:
        self.events = events
        self.base_cycle_ns = base_cycle_ns
        self._ledger = ledger
        self._patience = patience
        self.mailbox = Mailbox(ledger, events)
        """What other threads post to; see `Mailbox`."""
        self.areas = Areas(self.mailbox, ledger)
        """Byte areas that programs share with the outside; see `Areas`."""
        self.tasks = Tasks(tasks, base_cycle_ns, SYSTEM.now_ns, self.mailbox, ledger, events)
        """The tasks by name: what calls cyclic programs, and what that costs."""
        self._scheduler = Scheduler(ledger, events, self.tasks, on_failure)
        self._stages = in_order(
            [
                Stage(Step.INPUTS, "mailbox", self.mailbox.apply),
                Stage(Step.PROGRAMS, "programs", self._scheduler.run),
                *stages,
                Stage(Step.OUTPUTS, "areas", self.areas.publish),
                Stage(Step.OUTPUTS, "receipts", self.mailbox.acknowledge),
            ]
        )
        self._calls = tuple(stage.run for stage in self._stages)
        self.ending = "closed"
        """How the last `run()` ended, in words."""
        self._end = math.inf
        self._stopped = ""
        self.ticking = False
        """A tick is under way, or several without anybody in between."""
        self._broken = False
        self._gate = Gate()
        self._breakpoints = Breakpoints(events)
        self._pace: Pace | None = None
        self._meter: Meter | None = None

    @property
    def tick(self) -> int:
        """Number of ticks that have begun; the present one inside a program."""
        return self._ledger.tick

    @property
    def time(self) -> float:
        """Time of the run in seconds: tick times base cycle."""
        return self._ledger.tick * self.base_cycle_ns * 1e-9

    @property
    def statistics(self) -> Statistics:
        """What was measured so far.

        Raises:
            ValueError: this run measures nothing.
        """
        if self._meter is None:
            raise ValueError(f"this run measures nothing: give {type(self).__name__}(..., statistics=True)")
        compute, stages, pace = self._meter.compute, self._meter.stages, self._pace
        if pace is None:
            return Statistics(compute, Histogram(), stages, overruns=0, slips=0, slipped=0.0)
        return Statistics(compute, pace.lateness, stages, pace.overruns, pace.slips, pace.slipped_ns * 1e-9)

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
        if not isinstance(program, CoroutineProgram):
            raise RuntimeError("fail_after() guards what a coroutine waits for: use it inside one")
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
                finished = not self._scheduler.programs
                self._scheduler.cancel_all()
        if main is not None and main.failure is not None:
            if main in self.failures:
                self.failures.remove(main)
            raise main.failure
        return finished

    def stop(self, cause: str) -> None:
        """End `run()` after the present tick, or as soon as it begins, as if its time were over; for any thread.

        Args:
            cause: for the record, in words.
        """
        self._stopped = cause
        self._end = 0

    def step(self, ticks: int = 1) -> None:
        """Run a number of ticks, programs or not.

        Raises:
            RuntimeError: called in a program.
            CycleFault: a step of the runtime itself failed.
        """
        if self._ledger.issuer is not None:
            raise RuntimeError("a program cannot run ticks itself: await run.sleep(seconds) or a command")
        self._set_off()
        self._advance(ticks)

    def _set_end(self, call: str, time: float | None) -> None:
        """Let the loop end after a time from now."""
        if time is not None:
            _check_seconds(call, time)
        self._end = math.inf if time is None else self.tick + self._ticks(time)
        if self._stopped:  # before it began; asked after the line above, `stop` cannot be missed
            self._end = 0

    def _watched(
        self,
        watchdog: Watchdog,
        watch: Callable[[int], None] | None,
        met: Callable[[], Event | None] | None = None,
    ) -> Event | None:
        """Run to the end, or to the tick after which `met` returns an event; note how it came."""
        event = None
        try:
            event = self._loop(watch, met)
            self.ending = self._stopped or ("time over" if self._scheduler.programs else "all programs ended")
        except KeyboardInterrupt as interrupt:
            self.ending = str(interrupt) or "interrupted"
            if watchdog.stuck is None:
                raise
        except SystemExit:
            self.ending = "sys.exit() in a program"
            raise
        finally:
            self._stopped = ""
        if watchdog.stuck is not None:
            self.ending = "a program did not yield"
            raise watchdog.stuck
        return event

    def _loop(self, watch: Callable[[int], None] | None, met: Callable[[], Event | None] | None) -> Event | None:
        programs = self._scheduler.programs
        alone = not programs  # nothing but the time ends the run
        self._set_off()
        # Ticks take their time with a pace; who watches must not wait for many, and who looks for events for none.
        burst = 1 if self._pace is not None or met is not None else 256
        while (programs or alone) and self.tick < (end := self._end):
            most = min(burst - self.tick % burst, end - self.tick) if alone else 1
            ticks = self._gate.take(int(most))
            if ticks:
                self._advance(ticks)
            else:
                self._stand()
            if watch is not None and (self.tick % burst == 0 or not ticks):
                watch(self.tick)
            event = met() if met is not None else None
            if event is not None:
                return event
        return None

    def _stand(self) -> None:
        """Take up what comes from outside while the run is held up, and show what came of it; wait a little."""
        self.ticking = True
        try:
            self.mailbox.apply(self.tick)
            self.areas.publish(self.tick - 1)
            self.mailbox.acknowledge(self.tick)
        except Exception as error:
            raise self._fault(error) from error
        finally:
            self.ticking = False
        if self._gate.wait():
            self._set_off()

    def _measure(self, now_ns: Callable[[], int]) -> Meter:
        """Measure from now on what the stages cost, with a clock that counts nanoseconds."""
        self._meter = Meter(self._stages, now_ns)
        return self._meter

    def _set_off(self) -> None:
        """Let the next tick be due now, where there is a pace."""
        if self._pace is not None:
            self._pace.start(self.tick)

    def _advance(self, ticks: int) -> None:
        """Run ticks, each in its time where there is a pace."""
        self.ticking = True
        try:
            for _ in range(ticks):
                if self._pace is not None:
                    self._pace.wait(self.tick)
                self._tick()
        except Exception as error:
            raise self._fault(error) from error
        finally:
            self.ticking = False

    def _fault(self, error: Exception) -> CycleFault:
        self.ending = "a fault of the runtime"
        return CycleFault(f"tick {self.tick}: {error}")

    def _tick(self) -> None:
        ledger = self._ledger
        tick = ledger.tick
        try:
            if self._meter is not None:
                self._meter.run(tick)
            else:
                for call in self._calls:
                    call(tick)
        except BaseException:
            self._broken = True  # for the record: what this tick has done cannot be repeated
            raise
        ledger.tick = ledger.turn = tick + 1

    def _ticks(self, seconds: float) -> int:
        """Return seconds in whole ticks, rounded up; a rounding error of a millionth tick is none."""
        return math.ceil(seconds * 1e9 / self.base_cycle_ns - 1e-6)


def _check_seconds(call: str, seconds: float) -> None:
    if not 0.0 <= seconds < math.inf:
        raise ValueError(f"{call}({seconds}): must be finite and not negative, in seconds of the run")
