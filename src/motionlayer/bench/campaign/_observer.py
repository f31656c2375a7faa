"""An observer of one block: checks the rules of PLCopen from inputs and outputs alone, call by call."""

from dataclasses import dataclass
from typing import Any, Final, NamedTuple


class RuleBroken(AssertionError):  # noqa: N818 - the state, as a user would say it
    """A block broke a rule of PLCopen; the message holds the outputs."""


def must(holds: bool, *what: object) -> None:
    """Raise `RuleBroken` if a rule does not hold."""
    if not holds:
        raise RuleBroken(*what)


class Seen(NamedTuple):
    """One call: Execute as given, and the outputs after it."""

    execute: bool
    busy: bool
    active: bool
    done: bool
    aborted: bool
    error: bool
    error_id: int


NOTHING: Final = Seen(False, False, False, False, False, False, 0)
"""Before the first call."""


@dataclass
class Observer:
    """Watches the calls of one Execute block.

    Attributes:
        finish: name of the output that tells the end: `Done`.
        endless: the block stays busy after that output, until another command takes over.
    """

    finish: str = "Done"
    endless: bool = False
    last: Seen = NOTHING

    def look(self, block: Any) -> None:  # noqa: ANN401 - any Execute block
        """Take in the outputs after a call, and check them against those of the call before.

        Raises:
            RuleBroken: they contradict the rules, or one another.
        """
        now = Seen(
            bool(block.Execute),
            block.Busy,
            block.Active,
            getattr(block, self.finish),
            block.CommandAborted,
            block.Error,
            block.ErrorID,
        )
        before, self.last = self.last, now
        finishing = now.done + now.aborted + now.error
        must(finishing <= 1, now)
        must((now.error_id != 0) == now.error, now)
        must(not now.active or now.busy, now)
        if not self.endless:
            must(now.busy + finishing <= 1, now)
            must(not (now.active and finishing > 0), now)
        edge = now.execute and not before.execute
        quiet = not before.busy
        if now.execute:
            must(now.busy or finishing > 0, now)
        if edge and quiet:
            must(now.busy or now.error, "an edge is answered in the same call", now)
            must(not (now.done and not self.endless), "done not before the call after the edge", now)
        if quiet and not edge:
            must(not now.busy, "busy without an edge", before, now)
            if now.execute:
                must(self._finishing(now) == self._finishing(before), "shown as long as Execute", before, now)
            else:
                must(finishing == 0, "cleared by the falling edge", now)
        if not quiet and not now.busy:
            must(finishing == 1, "a command ends in exactly one way", before, now)

    @staticmethod
    def _finishing(seen: Seen) -> tuple[bool, bool, bool, int]:
        return seen.done, seen.aborted, seen.error, seen.error_id
