"""`SteppedRun`: a run that is held up, taken on step by step, and taken back."""

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from motionlayer.event import Event, Kind, Level
from motionlayer.runtime._breakpoints import Breakpoint
from motionlayer.runtime._run import Run
from motionlayer.runtime._snapshot import Snapshot, has_ended, refuse_coroutines
from motionlayer.runtime._watchdog import Watchdog
from motionlayer.runtime.copying import Copies


class SteppedRun(Run):
    """A run with pause, breakpoints and snapshots; the arguments are those of `Run`."""

    @property
    def paused(self) -> bool:
        """Somebody has paused the run; it stands as soon as the present tick has ended."""
        return self._gate.closed

    def pause(self) -> None:
        """Hold `run` and `advance` up before the next tick; any thread may call this, and never waits.

        Time stands still. What comes from outside is applied and published all the same. Nothing else resumes the run:
        a single thread that pauses itself waits for ever, or for Ctrl-C.
        """
        self._gate.close()

    def resume(self, ticks: int | None = None) -> None:
        """Let a paused run go on; any thread may call this.

        Args:
            ticks: pause again after so many of them.

        Raises:
            ValueError: ticks is not a whole number from 1 on.
        """
        if ticks is not None and (type(ticks) is not int or ticks < 1):
            raise ValueError(f"resume({ticks!r}): ticks must be a whole number from 1 on")
        self._gate.open(math.inf if ticks is None else ticks)

    def breakpoint(
        self,
        predicate: Callable[[Event], bool] | None = None,
        *,
        source: str | None = None,
        level: Level | None = None,
        kind: Kind | None = None,
    ) -> Breakpoint:
        """Let `advance` return at the end of a tick in which an event happens; all conditions given have to hold.

        Args:
            predicate: called with the event, after the tick.
            source: the object that the event speaks of, `X` or `program pick`.
            level: as grave as this, or graver.
            kind: a message, or a step in the life of a command.

        Returns:
            The breakpoint, to be removed some time.
        """
        return self._breakpoints.add(predicate, source, level, kind)

    def advance(self, time: float | None = None, *, watch: Callable[[int], None] | None = None) -> Event | None:
        """Run until a breakpoint is met, the time is over, or no program is left and no axis brakes.

        Programs stay as they are.

        Args:
            time: seconds of the run, from now; without end where left out.
            watch: see `run`.

        Returns:
            The first event at which a breakpoint stopped, None without; at once if there is neither program nor time.

        Raises:
            ProgramStuck: a program did not yield.
            CycleFault: a step of the runtime itself failed.
            RuntimeError: called in a program.
            ValueError: the time is negative, NaN or infinite.
        """
        self._require_no_program("run ticks")
        if time is None and self._over():
            return None
        self._set_end("advance", time)
        self._breakpoints.arm(on=True)
        try:
            with Watchdog(self._ledger, self._patience) as watchdog:
                return self._watched(watchdog, watch, self._breakpoints.met)
        finally:
            self._breakpoints.arm(on=False)

    def advance_until(self, predicate: Callable[[], bool], time: float) -> bool:
        """Run until a condition holds, or for a time at most; programs or not, they stay as they are.

        Args:
            predicate: asked now, and at the end of every tick.
            time: seconds of the run, from now.

        Returns:
            Whether the condition holds.

        Raises:
            ProgramStuck: a program did not yield.
            CycleFault: a step of the runtime itself failed.
            RuntimeError: called in a program.
            TypeError: the predicate cannot be called.
            ValueError: the time is negative, NaN or infinite.
        """
        self._require_no_program("run ticks")
        if not callable(predicate):
            raise TypeError(f"advance_until({predicate!r}): give a function, as in advance_until(lambda: …, time=5.0)")
        self._set_end("advance_until", time)
        with Watchdog(self._ledger, self._patience) as watchdog:
            while not predicate() and self.tick < self._end:  # once more where it returned as all programs had ended
                self._watched(watchdog, None, lambda: True if predicate() else None)
        return predicate()

    def snapshot(self) -> Snapshot:
        """Copy all that the next ticks depend on: tables, axes, drives, commands, cyclic programs and their memory.

        Areas and the events kept are part of it, what was measured is not. Of programs the memory is copied, and, where
        a method is the program, its object; not what they keep in globals or closures.

        Raises:
            NotCopyable: a coroutine has not ended, or a memory holds something that cannot be copied.
            RuntimeError: called in a program.
        """
        self._require_no_program("take a snapshot")
        refuse_coroutines(self._scheduler.programs)
        copies = Copies(self._roots(), self._pinned(), has_ended)
        programs = tuple(self._scheduler.programs)
        return Snapshot(self, self.tick, copies, programs, self.mailbox.fed, self._kept())

    def restore(self, snapshot: Snapshot) -> None:
        """Go back, or forward, to a snapshot of this run; from there it goes on bit for bit as it did.

        Commands, axes and memories are the same objects as before. Programs that the snapshot does not know are closed.
        Inputs that have been posted and not yet applied stay; those applied since are gone.

        Args:
            snapshot: as often as wanted.

        Raises:
            RuntimeError: called in a program.
            ValueError: it is a snapshot of another run.
        """
        self._require_no_program("restore a snapshot")
        if snapshot.run is not self:
            raise ValueError(f"{snapshot!r} is of another run: restore it there")
        self._scheduler.keep_only(snapshot.programs)
        snapshot.copies.put_back()
        self.tasks.look_again()
        self.mailbox.feed_again(snapshot.fed)
        self._broken = False
        self._put_back(snapshot.kept)
        self._show(self.tick - 1)

    def _roots(self) -> Iterator[tuple[str, object]]:
        """Yield where all that changes can be found; what belongs to a program comes first, to be named after it."""
        for program in self._scheduler.programs:
            yield f"program {program.name}", program
        yield "commands", self._ledger
        yield "events", self.events.ring
        yield "scheduler", self._scheduler
        for task in self.tasks.values():
            yield task.label, task.programs
        for area in self.areas.values():
            yield f"area {area.name}", area
        for stage in self._stages:
            yield stage.name, stage.run

    def _pinned(self) -> Iterable[object]:
        """Return what stays as it is: the run, the ways to the outside, and what is measured."""
        return self, self.events, self.mailbox, self.areas, self.tasks

    def _kept(self) -> object:
        """Return what is kept beside, for `_put_back`."""
        return None

    def _put_back(self, kept: Any) -> None:  # noqa: ANN401 - what `_kept` has returned
        """Put it back, after all the rest."""

    def _require_no_program(self, action: str) -> None:
        if self._ledger.issuer is not None:
            raise RuntimeError(f"a program cannot {action} itself: that is for who made the run, between two ticks")
