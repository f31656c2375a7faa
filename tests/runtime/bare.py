"""A run without a machine: cycle, programs, tasks, mailbox and areas alone."""

from collections.abc import Callable

from motionlayer.command import Ledger
from motionlayer.event import EventLog
from motionlayer.runtime import Program, Run, Stage, SteppedRun, TaskConfig

MILLISECOND = 1_000_000


def bare(*tasks: TaskConfig, stages: list[Stage] | None = None, failed: Callable[[Program], None] = print) -> Run:
    """Return a run with a base cycle of 1 ms in which nothing moves."""
    return Run(
        stages or [], base_cycle_ns=MILLISECOND, ledger=Ledger(), events=EventLog(), on_failure=failed, tasks=tasks
    )


def stepped(*tasks: TaskConfig) -> SteppedRun:
    """Return the same with pause, breakpoints and snapshots."""
    return SteppedRun([], base_cycle_ns=MILLISECOND, ledger=Ledger(), events=EventLog(), on_failure=print, tasks=tasks)


def noting(seen: list[tuple[int, str]], name: str) -> Callable[[Run], None]:
    """Return a cyclic function that notes when it is called."""

    def note(run: Run) -> None:
        seen.append((run.tick, name))

    return note
