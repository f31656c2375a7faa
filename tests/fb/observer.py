"""An observer of one block: checks the rules of PLCopen from inputs and outputs alone, call by call."""

from dataclasses import dataclass, field
from typing import Any


@dataclass
class Seen:
    """One call: Execute as given, and the outputs after it."""

    execute: bool
    busy: bool
    active: bool
    done: bool
    aborted: bool
    error: bool
    error_id: int


@dataclass
class Observer:
    """Watches the calls of one Execute block.

    Attributes:
        finish: name of the output that tells the end: `Done`.
        endless: the block stays busy after that output, until another command takes over.
    """

    finish: str = "Done"
    endless: bool = False
    calls: list[Seen] = field(default_factory=list)

    def look(self, block: Any) -> None:
        """Take in the outputs after a call, and check them against those of the calls before."""
        now = Seen(
            bool(block.Execute),
            block.Busy,
            block.Active,
            getattr(block, self.finish),
            block.CommandAborted,
            block.Error,
            block.ErrorID,
        )
        before = self.calls[-1] if self.calls else Seen(False, False, False, False, False, False, 0)
        self.calls.append(now)
        finishing = now.done + now.aborted + now.error
        assert finishing <= 1, now
        assert (now.error_id != 0) == now.error, now
        assert not now.active or now.busy, now
        if not self.endless:
            assert now.busy + finishing <= 1, now
            assert not (now.active and finishing), now
        edge = now.execute and not before.execute
        quiet = not before.busy
        if now.execute:
            assert now.busy or finishing, now
        if edge and quiet:
            assert now.busy or now.error, ("an edge is answered in the same call", now)
            assert not (now.done and not self.endless), ("done not before the call after the edge", now)
        if quiet and not edge:
            assert not now.busy, ("busy without an edge", before, now)
            if now.execute:
                assert self._finishing(now) == self._finishing(before), ("shown as long as Execute", before, now)
            else:
                assert not finishing, ("cleared by the falling edge", now)
        if not quiet and not now.busy:
            assert finishing == 1, ("a command ends in exactly one way", before, now)

    @staticmethod
    def _finishing(seen: Seen) -> tuple[bool, bool, bool, int]:
        return seen.done, seen.aborted, seen.error, seen.error_id
