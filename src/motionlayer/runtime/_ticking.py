"""`Ticking`: what a tick of a run does, and how one is taken.

What a tick does is a list of stages; when it is due is the business of a pace, if there is one. A run that is held up
takes no ticks, but still takes up what comes from outside.
"""

from collections.abc import Callable, Sequence
from threading import get_ident
from typing import TYPE_CHECKING

from motionlayer.command import Ledger
from motionlayer.event import EventLog
from motionlayer.runtime._areas import Areas
from motionlayer.runtime._breakpoints import Breakpoints
from motionlayer.runtime._clock import SYSTEM
from motionlayer.runtime._cycle import Stage, Step, in_order
from motionlayer.runtime._gate import Gate
from motionlayer.runtime._mailbox import Mailbox
from motionlayer.runtime._meter import Meter
from motionlayer.runtime._program import Program
from motionlayer.runtime._scheduler import Scheduler
from motionlayer.runtime._source import Source
from motionlayer.runtime._statistics import Histogram, Statistics
from motionlayer.runtime._tasks import TaskConfig, Tasks
from motionlayer.runtime._watchdog import PATIENCE

if TYPE_CHECKING:
    from motionlayer.runtime._pace import Pace


class CycleFault(RuntimeError):  # noqa: N818 - the state, as a user would say it
    """A fault in a step of the runtime itself, not in a program; the run has ended. The cause is chained."""


class Ticking:
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

    def _attach(self, source: Source) -> None:
        """Fetch inputs from a source from now on; a run that is held up sleeps as it does."""
        self.mailbox.attach(source)
        self._gate.sleeper = source

    @property
    def tick(self) -> int:
        """Number of ticks that have begun; the present one inside a program."""
        return self._ledger.tick

    @property
    def time(self) -> float:
        """Time of the run in seconds: tick times base cycle."""
        return self._ledger.tick * self.base_cycle_ns * 1e-9

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
            return Statistics(compute, Histogram(), stages, overruns=0, slips=0, slipped=0.0, brakes=0)
        slipped = pace.slipped_ns * 1e-9
        return Statistics(compute, pace.lateness, stages, pace.overruns, pace.slips, slipped, pace.brakes)

    def _left_alone(self) -> None:
        """Take up that the last program has ended, in the programs step; for who knows what moves."""

    def _stand(self) -> None:
        """Take up what comes from outside while the run is held up, and show what came of it; wait a little."""
        self.mailbox.cycle_thread = get_ident()
        try:
            self.mailbox.apply(self.tick)
            self._show(self.tick - 1)
            self.mailbox.acknowledge(self.tick)
        except Exception as error:
            raise self._fault(error) from error
        finally:
            self.mailbox.cycle_thread = None
        self.mailbox.on_post = self._gate.stir  # asked for what waits after that: no post is missed
        opened = self._gate.wait() if self.mailbox.empty else not self._gate.closed
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
