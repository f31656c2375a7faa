"""`Loop`: the ticks of a run, one after the other, until its end has come.

What a tick does is a list of stages; when it is due is the business of a pace, if there is one. A run that is held up
takes no ticks, but still takes up what comes from outside.

A run ends when its time is over or somebody stops it, at once. Otherwise it ends when no program is left, and not while
an axis brakes: what a failed program was moving, and what an emergency stop or an error brings to rest, comes to rest.
"""

import math
from collections.abc import Callable, Sequence
from threading import get_ident
from typing import TYPE_CHECKING

from motionlayer.command import Ledger
from motionlayer.event import Event, EventLog
from motionlayer.runtime._areas import Areas
from motionlayer.runtime._breakpoints import Breakpoints
from motionlayer.runtime._clock import SYSTEM
from motionlayer.runtime._cycle import Stage, Step, in_order
from motionlayer.runtime._gate import Gate
from motionlayer.runtime._mailbox import Mailbox
from motionlayer.runtime._meter import Meter
from motionlayer.runtime._program import Program
from motionlayer.runtime._scheduler import Scheduler
from motionlayer.runtime._statistics import Histogram, Statistics
from motionlayer.runtime._tasks import TaskConfig, Tasks
from motionlayer.runtime._watchdog import PATIENCE, Watchdog

if TYPE_CHECKING:
    from motionlayer.runtime._pace import Pace


class CycleFault(RuntimeError):  # noqa: N818 - the state, as a user would say it
    """A fault in a step of the runtime itself, not in a program; the run has ended. The cause is chained."""


class Loop:
    """Cycles in order.

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
        self._scheduler = Scheduler(ledger, events, self.tasks, on_failure, self._left_alone)
        self._arrange(stages)
        self.ending = "closed"
        """How the last `run()` ended, in words."""
        self._end = math.inf
        self._stopped = ""
        self._broken = False
        self._gate = Gate()
        self._breakpoints = Breakpoints(events)
        self._pace: Pace | None = None
        self._meter: Meter | None = None

    def _arrange(self, stages: Sequence[Stage]) -> None:
        """Let a tick do what these stages do, and what it does in every run; before the first tick."""
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

    @property
    def tick(self) -> int:
        """Number of ticks that have begun; the present one inside a program."""
        return self._ledger.tick

    @property
    def time(self) -> float:
        """Time of the run in seconds: tick times base cycle."""
        return self._ledger.tick * self.base_cycle_ns * 1e-9

    @property
    def idle(self) -> bool:
        """No program is left, and no axis brakes: `run()` would return."""
        return self._over()

    @property
    def ticking(self) -> bool:
        """A tick is under way, or several without anybody in between."""
        return self.mailbox.cycle_thread is not None

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
        self._end = math.inf if time is None else self.tick + self._ticks(call, time)
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
            self.ending = self._stopped or ("all programs ended" if self._over() else "time over")
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
        alone = not self._scheduler.programs and self._end < math.inf  # nothing but the time ends the run
        self._set_off()
        # Ticks take their time with a pace; who watches must not wait for many, and who looks for events for none.
        burst = 1 if self._pace is not None or met is not None else 256
        while (alone or not self._over()) and self.tick < (end := self._end):
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

    def _over(self) -> bool:
        """No program is left, and no axis brakes."""
        return not (self._scheduler.programs or self._braking())

    def _braking(self) -> bool:
        """Tell whether something comes to rest that the run does not end before; for who knows what moves."""
        return False

    def _left_alone(self) -> None:
        """Take up that the last program has ended, in the programs step; for who knows what moves."""

    def _stand(self) -> None:
        """Take up what comes from outside while the run is held up, and show what came of it; wait a little."""
        self.mailbox.cycle_thread = get_ident()
        self.mailbox.on_post = self._gate.stir
        try:
            self.mailbox.apply(self.tick)
            self._show(self.tick - 1)
            self.mailbox.acknowledge(self.tick)
        except Exception as error:
            raise self._fault(error) from error
        finally:
            self.mailbox.cycle_thread = None
        opened = self._gate.wait()
        self.mailbox.on_post = None
        if opened:
            self._set_off()

    def _show(self, tick: int) -> None:
        """Let the outside see what has changed while no tick ran; for who publishes more than areas.

        Args:
            tick: the last one that has ended.
        """
        self.areas.publish(tick)

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
        self.mailbox.cycle_thread = get_ident()
        try:
            for _ in range(ticks):
                if self._pace is not None:
                    self._pace.wait(self.tick)
                self._tick()
        except Exception as error:
            raise self._fault(error) from error
        finally:
            self.mailbox.cycle_thread = None

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

    def _ticks(self, call: str, seconds: float) -> int:
        """Return seconds in whole ticks, rounded up; a rounding error of a millionth tick is none.

        Raises:
            ValueError: negative, NaN or infinite; the message names the call.
        """
        if not 0.0 <= seconds < math.inf:
            raise ValueError(f"{call}({seconds}): must be finite and not negative, in seconds of the run")
        return math.ceil(seconds * 1e9 / self.base_cycle_ns - 1e-6)
