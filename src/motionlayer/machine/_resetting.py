"""Snapshots of a machine's run, and its way back to the beginning."""

import abc
from collections.abc import Iterable
from typing import NamedTuple

from motionlayer.drive import ServoDrives
from motionlayer.machine._logging import Logging
from motionlayer.machine._machine import Machine
from motionlayer.machine._tracing import Tracing
from motionlayer.record import Mark
from motionlayer.runtime import NotCopyable, Snapshot, SteppedRun


class _Kept(NamedTuple):
    """What a run of a machine keeps beside its tables: its seed, and where its recording was, if it can go back."""

    seed: int
    mark: Mark | None


class ResettableRun(SteppedRun, abc.ABC):
    """A run of a machine that can go back.

    Attributes:
        machine: what runs.
        seed: of everything random.
        log: the message files.
    """

    machine: Machine
    seed: int
    log: Logging
    _servos: ServoDrives
    _tracing: Tracing | None
    _first_seed: int
    _beginning: Snapshot | NotCopyable | None = None
    """Before the first tick, once that has come; or why there is none. A run that writes its trace to a file has no way
    back, and is spared the copy: tens of milliseconds with 1000 axes."""

    def restore(self, snapshot: Snapshot) -> None:
        """Go back, or forward, to a snapshot of this run; from there it goes on bit for bit as it did.

        Commands, axes and memories are the same objects as before. Programs that the snapshot does not know are closed.
        Inputs that have been posted and not yet applied stay; those applied since are gone. The trace in memory and the
        hash are those of a run that has never been elsewhere. In message files the time goes on.

        Args:
            snapshot: as often as wanted.

        Raises:
            RuntimeError: called in a program, or the recording has ended.
            TraceError: the trace is written to a file, which cannot be taken back.
            ValueError: it is a snapshot of another run.
        """
        self._require_way_back()
        ahead = self.tick - snapshot.tick
        super().restore(snapshot)
        self.log.slip(max(0, ahead) * self.base_cycle_ns)

    def reset(self, seed: int | None = None) -> None:
        """Go back to before the first tick: to all that had been set up by then, programs, commands and faults.

        Args:
            seed: of everything random from now on; that with which the run was made where left out.

        Raises:
            NotCopyable: a coroutine had been started by then, or a memory holds something that cannot be copied.
            RuntimeError: called in a program, or the recording has ended.
            TraceError: the trace is written to a file, which cannot be taken back.
        """
        self._require_way_back()
        beginning = self._beginning or self.snapshot()
        if isinstance(beginning, NotCopyable):
            raise NotCopyable(f"no way back to before the first tick: {beginning}")
        kept = beginning.kept._replace(seed=self._first_seed if seed is None else seed)
        self.restore(beginning._replace(kept=kept))

    def _require_way_back(self) -> None:
        """Make sure that the run can go back, whereto ever.

        Raises:
            RuntimeError: the recording has ended.
            TraceError: the trace is written to a file.
        """
        self._require_open()
        if self._tracing is not None:
            self._tracing.require_memory()

    def _set_off(self) -> None:
        self._require_open()
        recoverable = self._tracing is None or self._tracing.in_memory
        if self._beginning is None and self.tick == 0 and recoverable:
            try:
                self._beginning = self.snapshot()
            except NotCopyable as reason:
                self._beginning = reason
        super()._set_off()

    def _pinned(self) -> Iterable[object]:
        return *super()._pinned(), self.machine, self.log, self._tracing

    def _kept(self) -> _Kept:
        return _Kept(self.seed, self._tracing.mark() if self._tracing is not None else None)

    def _put_back(self, kept: _Kept) -> None:
        self.seed = kept.seed
        self._servos.reseed(kept.seed)
        if self._tracing is not None and kept.mark is not None:
            self._tracing.go_back(kept.mark, seed=kept.seed)

    @abc.abstractmethod
    def _require_open(self) -> None:
        """Make sure that the run can go on.

        Raises:
            RuntimeError: it has been closed.
        """
