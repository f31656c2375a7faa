"""Jobs are tables (motion-layer 5.4).

A job is called with Execute. FALSE prepares it: it stands at its first step, and nothing has happened. TRUE takes it
on:

- of the rows of the present step the first whose condition holds is taken: its action is done, its next step entered;
- a next step that stands later in the order of the steps is gone through in the same call, an earlier one, or the
  same again, waits for the next call;
- where no row holds the job stays where it is.

Steps are values of `Progress`, in the order in which they first appear in the rows; that order is the job's own, and
not that of the numbers. What a call returns is what is published: the step, or what the table shows in its place.
"""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Final, Generic, NamedTuple, TypeVar

from motionlayer.command import Ledger
from motionlayer.layer.types._progress import Progress

J = TypeVar("J", bound="Job")

ENDS: Final = frozenset({Progress.DONE, Progress.ERROR})
"""Where a job usually ends."""


class Transition(NamedTuple, Generic[J]):
    """One row.

    Attributes:
        step: in which it is looked at.
        when: condition; it changes nothing.
        do: action, called when the condition holds.
        next: the step entered, or an end.
    """

    step: Progress
    when: Callable[[J], bool]
    do: Callable[[J], object]
    next: Progress


class _Row(NamedTuple):
    """A row as a call uses it: `goes_on` tells that the next step is gone through in the same call."""

    when: Callable[[Any], bool]
    do: Callable[[Any], object]
    next: Progress
    goes_on: bool


def always(_job: "Job") -> bool:
    """Condition: none."""
    return True


def a_call_later(job: "Job") -> bool:
    """Condition: the step was not entered in this tick, so that it shows for one call at least."""
    return job.ledger.tick > job.since


def nothing(_job: "Job") -> None:
    """Action: none."""


class JobTable(Generic[J]):
    """The rows of a job, checked; they are data, from which diagrams are drawn as well.

    Args:
        name: for messages and diagrams, `MOVE_POS`.
        rows: see `Transition`.
        prepare: called when the job is prepared, for what is latched with the command.
        shows: what is published in place of a step, where the job is part of another one.
        run_through: later steps are gone through in the same call; False for one row in a call.
        ends: steps that nothing follows.

    Attributes:
        first: the step of a prepared job.
        steps: all steps in their order.
        rows: as given.
        shown: what is published, by step and end.

    Raises:
        ValueError: the rows are no job: a step that no row leads to, or one that leads nowhere.
    """

    def __init__(
        self,
        name: str,
        rows: Iterable[Transition[J]],
        *,
        prepare: Callable[[J], object] = nothing,
        shows: Mapping[Progress, Progress] | None = None,
        run_through: bool = True,
        ends: frozenset[Progress] = ENDS,
    ) -> None:
        self.name: Final = name
        self.rows: Final = tuple(rows)
        self.prepare: Final[Callable[[Any], object]] = prepare
        self.ends: Final = ends
        self.steps: Final = tuple(dict.fromkeys(row.step for row in self.rows))
        self._check()
        self.first: Final = self.steps[0]
        self.shown: Final = {step: (shows or {}).get(step, step) for step in (*self.steps, *sorted(ends))}
        later = {step: set(self.steps[place + 1 :]) for place, step in enumerate(self.steps)}
        self.by_step: Final[Mapping[Progress, tuple[_Row, ...]]] = {
            step: tuple(
                _Row(row.when, row.do, row.next, run_through and row.next in later[step])
                for row in self.rows
                if row.step is step
            )
            for step in self.steps
        } | dict.fromkeys(ends, ())

    def _check(self) -> None:
        if not self.steps:
            raise ValueError(f"{self.name}: a job needs at least one row")
        nexts = {row.next for row in self.rows}
        lost = [step.name for step in self.steps[1:] if step not in nexts]
        if lost:
            raise ValueError(f"{self.name}: no row leads to the step {', '.join(lost)}")
        open_ = [step.name for step in sorted(nexts) if step not in self.steps and step not in self.ends]
        if open_:
            raise ValueError(f"{self.name}: no row leads on from {', '.join(open_)}, which is no end either")
        endless = [step.name for step in self.steps if step in self.ends]
        if endless:
            raise ValueError(f"{self.name}: {', '.join(endless)} is an end, and has rows")

    def __repr__(self) -> str:
        return f"<JobTable {self.name}>"


NOTHING: Final[JobTable[Any]] = JobTable("NULL", [Transition(Progress.INIT, always, nothing, Progress.DONE)])
"""What stands in a memory before the first command."""


class Job:
    """What one caller remembers of a job: which it is, and its step. Conditions and actions are given the job.

    Args:
        table: the job to begin with.
        ledger: the present tick.

    Attributes:
        table: the job.
        step: the present one.
        since: the tick in which it was entered.
        ledger: the present tick.
    """

    # Read in every cycle of a job; a snapshot, which looks into dictionaries, would slow those of an instance down.
    __slots__ = ("ledger", "since", "step", "table")

    def __init__(self, table: JobTable[Any], ledger: Ledger) -> None:
        self.ledger = ledger
        self.table = table
        self.step = table.first
        self.since = ledger.tick

    def take(self, table: JobTable[Any]) -> Progress:
        """Take a job up: prepare it, and return what it shows."""
        self.table = table
        return self.call(execute=False)

    def call(self, *, execute: bool) -> Progress:
        """Prepare the job or take it on; see the head of this file.

        Returns:
            What is published of it.
        """
        table = self.table
        if not execute:
            self._enter(table.first)
            table.prepare(self)
            return table.shown[self.step]
        goes_on = True
        while goes_on:
            for when, do, after, goes_on in table.by_step[self.step]:  # noqa: B007 - read by the loop around
                if when(self):
                    do(self)
                    self._enter(after)
                    break
            else:
                break
        return table.shown[self.step]

    def _enter(self, step: Progress) -> None:
        self.step = step
        self.since = self.ledger.tick
