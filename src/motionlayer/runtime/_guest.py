"""`Guest`: code of the user's that is called outside of the programs step, as the jobs of an object are."""

from types import TracebackType
from typing import Self

from motionlayer.command import Ledger
from motionlayer.runtime._program import Issuer
from motionlayer.runtime._scheduler import Scheduler


class Guest(Issuer):
    """What somebody else than the scheduler calls, again and again, each time inside of `with guest:`.

    It has no end. A failure is noted for the end of the run, and whoever calls it decides what becomes of it.

    Args:
        name: for messages.
        ledger: that names it while it runs.
        scheduler: of the run, which notes failures.
    """

    advice = "a job cannot wait; let a condition of its table hold later"

    def __init__(self, name: str, ledger: Ledger, scheduler: Scheduler) -> None:
        super().__init__(name, number=0, owner=None)
        self._ledger = ledger
        self._scheduler = scheduler

    def __enter__(self) -> Self:
        self._ledger.issuer = self
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._ledger.issuer = None
        self._scheduler.tell_forgotten(self)

    def note(self, failure: Exception) -> None:
        """Note what has left it; the first failure is that of the run."""
        if self.failure is None:
            self.failure = failure
            self._scheduler.failures.append(self)
