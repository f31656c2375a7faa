"""Tasks: when cyclic programs are called, and how long that takes.

A task runs in every tick n with n ≡ phase (mod every). In one tick the coroutines run first, then the tasks, the more
frequent ones before the rarer ones, those alike in the order in which they were given; the programs of a task in
order of start. Nothing is pre-empted: what a program reads cannot change while it runs.

Two tasks with cycles e and f and phases p and q meet in some tick exactly if p ≡ q modulo gcd(e, f). So where the phase
is left open, the task takes the first one in which it meets the least: the load spreads over the ticks, and the choice
follows from the machine alone, never from measured time.
"""

import math
import struct
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Final, NamedTuple

from motionlayer.command import Ledger
from motionlayer.event import Device, Event, EventLog, Kind, Level
from motionlayer.runtime._cyclic import CyclicProgram
from motionlayer.runtime._mailbox import Mailbox, MailboxFull
from motionlayer.runtime._statistics import Histogram

MAIN: Final = "main"
"""The task of a cyclic program that names none; it runs in every tick unless the machine says otherwise."""

BUDGET: Final = 0.5
"""Share of the base cycle that a task has where the machine gives it no budget."""

CHANNEL: Final = "tasks.over_budget"
_REPORT: Final = struct.Struct("<iq")  # index of the task, compute time in ns

_PHASES: Final = 1024
"""Phases that are tried where the phase is left open; among so many there is one as good as any."""


class TaskConfig(NamedTuple):
    """How a task is set up.

    Attributes:
        name: what programs call it by.
        every: ticks from one cycle of it to the next.
        phase: the first tick in which it runs, below `every`; None lets the load spread.
        budget: compute time of a cycle in seconds; None for a share of the base cycle, `BUDGET`.
    """

    name: str
    every: int = 1
    phase: int | None = None
    budget: float | None = None


class Task:
    """A task, its programs, and what its cycles have cost.

    Attributes:
        name: see `TaskConfig`; so `every` and `phase`, which is settled here.
        label: its name in messages.
        budget_ns: compute time of a cycle that is still in order, in nanoseconds.
        programs: what it calls, in order of start.
        compute: compute times of its cycles, in nanoseconds.
        over_budget: cycles that took longer than the budget.
    """

    def __init__(self, name: str, every: int, phase: int, budget_ns: int) -> None:
        self.name = name
        self.label = f"task {name}"
        self.every = every
        self.phase = phase
        self.budget_ns = budget_ns
        self.programs: list[CyclicProgram] = []
        self.compute = Histogram()
        self.over_budget = 0
        self._over = False

    def __repr__(self) -> str:
        return f"<Task {self.name}: every {self.every} ticks, {len(self.programs)} programs>"

    def measured(self, ns: int) -> bool:
        """Take in the compute time of a cycle; tell whether it is the first over the budget in a row."""
        self.compute.add(ns)
        before, self._over = self._over, ns > self.budget_ns
        self.over_budget += self._over
        return self._over and not before


class Tasks(Mapping[str, Task]):
    """The tasks of a run by name.

    Args:
        configs: the tasks; `MAIN` is added where it is missing.
        base_cycle_ns: length of a tick in nanoseconds.
        now_ns: the clock of the statistics.
        mailbox: takes the report of a cycle over its budget, as something from outside: measured time is no part of
            what a run computes.
        ledger: tells the tick.
        events: where that report is told.
    """

    def __init__(
        self,
        configs: Sequence[TaskConfig],
        base_cycle_ns: int,
        now_ns: Callable[[], int],
        mailbox: Mailbox,
        ledger: Ledger,
        events: EventLog,
    ) -> None:
        known = [config.name for config in configs]
        configs = [*configs, *([TaskConfig(MAIN)] if MAIN not in known else [])]
        phases, share = spread(configs), BUDGET * base_cycle_ns
        budgets = {one.name: round(share if one.budget is None else one.budget * 1e9) for one in configs}
        self._tasks = {one.name: Task(one.name, one.every, phases[one.name], budgets[one.name]) for one in configs}
        self._order = sorted(self._tasks.values(), key=lambda task: task.every)
        self._used: tuple[Task, ...] = ()
        self._now_ns = now_ns
        self._note: Callable[[str, int], None] = lambda _name, _ns: None
        self._reporting = False
        self._mailbox = mailbox
        self._ledger = ledger
        self._events = events
        mailbox.register(CHANNEL, self._told)

    def __getitem__(self, name: str) -> Task:
        if name not in self._tasks:
            raise KeyError(f"no task {name!r}; this run has {', '.join(self._tasks)}")
        return self._tasks[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._tasks)

    def __len__(self) -> int:
        return len(self._tasks)

    def report(self, now_ns: Callable[[], int], note: Callable[[str, int], None] = lambda _name, _ns: None) -> None:
        """Let cycles over their budget be warnings, once for each row of them; for real time, where they matter.

        Args:
            now_ns: the clock of the run, by which they are measured from now on.
            note: called with label and compute time (ns) of every cycle of a task.
        """
        self._reporting, self._now_ns, self._note = True, now_ns, note

    def add(self, task: Task, program: CyclicProgram) -> None:
        """Let a task call a program, after those that it calls already."""
        task.programs.append(program)
        self._use()

    def remove(self, program: CyclicProgram) -> None:
        """Let a program be called no more."""
        for task in self._used:
            if program in task.programs:
                task.programs.remove(program)
        self._use()

    def look_again(self) -> None:
        """Take up what tasks call now: the run has gone back to a tick at which it was so."""
        self._use()

    def run(self, tick: int, turn: Callable[[CyclicProgram], None]) -> None:
        """Run the tasks that are due; `turn` gives a program its turn."""
        for task in self._used:
            if tick % task.every != task.phase:
                continue
            began = self._now_ns()
            self._ledger.turn = tick // task.every
            for program in tuple(task.programs):
                if program.since <= tick and program.busy:
                    turn(program)
            took = self._now_ns() - began
            self._note(task.label, took)
            if task.measured(took) and self._reporting:
                self._report(task, took)
        self._ledger.turn = tick

    def _use(self) -> None:
        self._used = tuple(task for task in self._order if task.programs)

    def _report(self, task: Task, ns: int) -> None:
        try:
            self._mailbox.post(CHANNEL, _REPORT.pack(self._order.index(task), ns))
        except MailboxFull:
            return  # counted there, and in the statistics of the task

    def _told(self, payload: bytes) -> None:
        index, ns = _REPORT.unpack(payload)
        task = self._order[index]
        text = f"over its budget: {ns * 1e-6:.3f} ms of {task.budget_ns * 1e-6:.3f} ms; give its programs less to do"
        tick, main = self._ledger.tick, Device.Device_Main
        self._events.add(Event(tick, Level.WARNING, Kind.MESSAGE, task.label, text, device=main))


def spread(configs: Sequence[TaskConfig]) -> dict[str, int]:
    """Return the phase of every task: its own, or the first in which it meets the least of those before it.

    The more frequent a task, the earlier it chooses; those with a phase of their own come first of all.
    """
    placed: list[tuple[int, int]] = []
    phases: dict[str, int] = {}
    for config in sorted(configs, key=lambda one: (one.phase is None, one.every)):
        phase = config.phase
        if phase is None:
            phase = min(range(min(config.every, _PHASES)), key=lambda p: _meets(config.every, p, placed))
        phases[config.name] = phase
        placed.append((config.every, phase))
    return phases


def heaviest(configs: Sequence[TaskConfig]) -> list[TaskConfig]:
    """Return the tasks that share the tick with the largest sum of budgets; a task without one counts as 0.

    Tasks of which every two meet all meet in one tick (the Chinese remainder theorem for any cycles), so it is enough
    to look at pairs. A branch of the search ends where what is left cannot exceed the best found so far.
    """
    phases = spread(configs)
    best: list[TaskConfig] = []

    def grow(together: list[TaskConfig], rest: list[TaskConfig]) -> None:
        nonlocal best
        if _load(together) > _load(best):
            best = together
        for index, one in enumerate(rest):
            if _load(together) + _load(rest[index:]) <= _load(best):
                return
            grow([*together, one], [other for other in rest[index + 1 :] if meet(one, other)])

    def meet(one: TaskConfig, other: TaskConfig) -> bool:
        return (phases[one.name] - phases[other.name]) % math.gcd(one.every, other.every) == 0

    grow([], list(configs))
    return best


def _load(configs: Sequence[TaskConfig]) -> float:
    return math.fsum(one.budget or 0.0 for one in configs)


def _meets(every: int, phase: int, placed: Sequence[tuple[int, int]]) -> float:
    """Return how many placed tasks run, in the mean, in a tick in which this one runs."""
    total = 0.0
    for other, at in placed:
        common = math.gcd(every, other)
        if (phase - at) % common == 0:
            total += common / other  # this share of our ticks is also one of theirs
    return total
