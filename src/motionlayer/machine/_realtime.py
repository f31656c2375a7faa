"""`RealTime`: a machine that runs in the time of a clock."""

import contextlib
from collections.abc import Callable, Coroutine, Iterator
from typing import Any, Final, Unpack

from motionlayer.event import Event
from motionlayer.machine._machine import Machine
from motionlayer.machine._machine_run import MachineRun
from motionlayer.machine._rehearsal import rehearse
from motionlayer.machine._run_keywords import RealTimeKeywords, require_call
from motionlayer.runtime import SYSTEM, Conditions, Meter, Pace, collect_young, late_input

REALTIME_PATIENCE: Final = 1.0
"""Seconds after which a program that does not yield ends the run: shorter than in simulation, axes are moving."""


class RealTime(MachineRun):
    """A run of a machine in the time of a clock.

    It is the run that `Simulation` makes of the same machine, tick by tick, and gives the same hash as long as no tick
    begins a whole tick late and no task exceeds its budget. What follows then is in `motionlayer.runtime` (`Pace`,
    `Lateness`, `Tasks`).

    Args:
        machine: what runs; its table `[realtime]` says what is asked of the computer.
        **keywords: see `RealTimeKeywords`.

    Raises:
        LogError: the message files cannot be written.
        MachineError: the file of persistent parameters means nothing.
        ProgramError: a program of the machine description cannot be loaded.
        ServerFailed: the ADS server cannot begin.
        TraceError: the trace file cannot be written.
        TypeError: it is no machine, or there is no such keyword.
        ValueError: the speed is out of range.
    """

    _pace: Pace
    _meter: Meter

    def __init__(self, machine: Machine, **keywords: Unpack[RealTimeKeywords]) -> None:
        require_call("RealTime", machine, RealTimeKeywords, keywords)
        clock = keywords.get("clock", SYSTEM)
        pace = Pace(
            machine.description.base_cycle_ns,
            clock,
            speed=keywords.get("speed", 1.0),
            report=self._late,
            slipped=self._slipped,
            idle=self._idle,
        )
        keywords.setdefault("patience", REALTIME_PATIENCE)
        super().__init__(machine, keywords, lossless=False)
        rehearse(machine)
        wishes = machine.description.realtime
        self._conditions = Conditions(wishes.priority, lock_memory=wishes.lock_memory)
        self._spin_ns = wishes.spin_us * 1000
        self._meter = self._measure(clock.now_ns)
        self.tasks.report(clock.now_ns, self._meter.note)
        self._pace = pace

    @property
    def refused(self) -> list[str]:
        """What the computer did not grant when the run began, and why; the run is later for it, not wrong."""
        return self._conditions.refused

    def run(
        self,
        program: Coroutine[Any, Any, Any] | None = None,
        *,
        time: float | None = None,
        watch: Callable[[int], None] | None = None,
    ) -> bool:
        """Run as `Run.run`, under the conditions of a real-time run; they are given back in the end."""
        with self._in_time():
            return super().run(program, time=time, watch=watch)

    def advance(self, time: float | None = None, *, watch: Callable[[int], None] | None = None) -> Event | None:
        """Run as `SteppedRun.advance`, under the same conditions."""
        with self._in_time():
            return super().advance(time, watch=watch)

    def advance_until(self, predicate: Callable[[], bool], time: float) -> bool:
        """Run as `SteppedRun.advance_until`, under the same conditions."""
        with self._in_time():
            return super().advance_until(predicate, time)

    @contextlib.contextmanager
    def _in_time(self) -> Iterator[None]:
        with self._conditions.held():
            self._pace.spin(0 if self._conditions.fifo else self._spin_ns)
            yield

    def _set_off(self) -> None:
        super()._set_off()
        self.log.align(self.tick)
        if self.serves_ads:
            self.ads.time.align(self.tick)

    def _idle(self, spare_ns: int) -> None:
        self._meter.forget()
        collect_young(spare_ns)

    def _slipped(self, ns: int) -> None:
        self.log.slip(ns)
        if self.serves_ads:
            self.ads.time.slip(ns)

    def _late(self, ticks: int) -> None:
        name, ns = self._meter.slowest()
        if 2 * ns < self.base_cycle_ns:
            why = "no part of the cycle was slow, but the computer itself: busy, or asleep"
        else:
            why = f"the slowest was {name}, {ns * 1e-6:.3f} ms"
        self.mailbox.feed([late_input(self.tick, ticks, why)])
