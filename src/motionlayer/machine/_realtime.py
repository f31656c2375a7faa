"""`RealTime`: a machine that runs in the time of a clock."""

import contextlib
import os
from collections.abc import Callable, Coroutine, Iterator, Sequence
from typing import Any, Final

from motionlayer.event import Event
from motionlayer.machine._log_description import LogDescription
from motionlayer.machine._machine import Machine
from motionlayer.machine._machine_run import MachineRun, require_machine
from motionlayer.machine._programs import Loaded
from motionlayer.machine._rehearsal import rehearse
from motionlayer.runtime import SYSTEM, Clock, Conditions, Meter, Pace, collect_young, late_input

REALTIME_PATIENCE: Final = 1.0
"""Seconds after which a program that does not yield ends the run: shorter than in simulation, axes are moving."""


class RealTime(MachineRun):
    """A run of a machine in the time of a clock.

    It is the run that `Simulation` makes of the same machine, tick by tick, and gives the same hash as long as no tick
    begins a whole tick late and no task exceeds its budget. What follows then is in `motionlayer.runtime` (`Pace`,
    `Lateness`, `Tasks`).

    Args:
        machine: what runs; its table `[realtime]` says what is asked of the computer.
        speed: seconds of the run in a second of the clock, 0.01 to 1000.
        seed: of everything random; that of the machine description where left out.
        trace: as in `Simulation`; a writer that does not keep up leaves a gap and never delays a tick.
        programs: started in tick 0, in order; those of the machine description where left out.
        patience: wall time in seconds after which a program that does not yield ends the run.
        log: as in `Simulation`; messages that find no room are left out, and counted in the file.
        clock: paces the run; that of the computer where left out.

    Raises:
        LogError: the message files cannot be written.
        ProgramError: a program of the machine description cannot be loaded.
        TraceError: the trace file cannot be written.
        ValueError: the speed is out of range.
    """

    _pace: Pace
    _meter: Meter

    def __init__(
        self,
        machine: Machine,
        *,
        speed: float = 1.0,
        seed: int | None = None,
        trace: bool | str | os.PathLike[str] | None = True,
        programs: Sequence[Loaded] | None = None,
        patience: float = REALTIME_PATIENCE,
        log: LogDescription | bool = True,
        clock: Clock = SYSTEM,
    ) -> None:
        require_machine(machine, type(self).__name__)
        pace = Pace(
            machine.description.base_cycle_ns,
            clock,
            speed=speed,
            report=self._late,
            slipped=self._slipped,
            idle=self._idle,
        )
        super().__init__(machine, seed=seed, trace=trace, programs=programs, patience=patience, log=log, lossless=False)
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

    @contextlib.contextmanager
    def _in_time(self) -> Iterator[None]:
        with self._conditions.held():
            self._pace.spin(0 if self._conditions.fifo else self._spin_ns)
            yield

    def _set_off(self) -> None:
        super()._set_off()
        self.log.align(self.tick)

    def _idle(self, spare_ns: int) -> None:
        self._meter.forget()
        collect_young(spare_ns)

    def _slipped(self, ns: int) -> None:
        self.log.slip(ns)

    def _late(self, ticks: int) -> None:
        name, ns = self._meter.slowest()
        if 2 * ns < self.base_cycle_ns:
            why = "no part of the cycle was slow, but the computer itself: busy, or asleep"
        else:
            why = f"the slowest was {name}, {ns * 1e-6:.3f} ms"
        self.mailbox.feed([late_input(self.tick, ticks, why)])
