"""`Snapshot`: the state of a run between two ticks."""

from typing import TYPE_CHECKING, Any, NamedTuple

from motionlayer.event import Input
from motionlayer.runtime._program import CoroutineProgram, Program
from motionlayer.runtime.copying import Copies, NotCopyable

if TYPE_CHECKING:
    from motionlayer.runtime._run import Run


class Snapshot(NamedTuple):
    """What a run was between two ticks; made by `run.snapshot`, for `restore` of the same run.

    Attributes:
        run: which run.
        tick: number of ticks that had begun.
        copies: of everything that changes.
        programs: those that had not ended.
        fed: recorded inputs whose ticks were still to come.
        kept: what the run keeps beside its tables, in its own words.
    """

    run: "Run"
    tick: int
    copies: Copies
    programs: tuple[Program, ...]
    fed: tuple[Input, ...]
    kept: Any

    def __repr__(self) -> str:
        return f"<Snapshot of tick {self.tick}>"


def refuse_coroutines(programs: list[Program]) -> None:
    """Make sure that the programs can be copied.

    Raises:
        NotCopyable: some are coroutines, whose place in the code cannot be; they are named.
    """
    names = [program.name for program in programs if isinstance(program, CoroutineProgram)]
    if names:
        raise NotCopyable(
            f"program {', '.join(names)}: a coroutine, and where it waits cannot be copied; wait until it has ended, "
            "or write a cyclic program instead"
        )


def has_ended(thing: object) -> bool:
    """Tell whether something is a program that has ended: it changes no more, whatever it returned."""
    return isinstance(thing, Program) and not thing.busy
