"""`MachineRun`: a machine that runs, whatever sets the pace."""

import functools
import hashlib
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Self

import numpy as np

from motionlayer.fb import AXIS_REF
from motionlayer.machine._axes import Axes
from motionlayer.machine._build import Parts, build
from motionlayer.machine._disturbing import DisturbedRun
from motionlayer.machine._logging import Logging
from motionlayer.machine._machine import Machine
from motionlayer.machine._persistence import Persistence, load_kept
from motionlayer.machine._programs import Loaded, load_program, sources_of
from motionlayer.machine._run_keywords import USUAL, RunKeywords
from motionlayer.machine._tracing import Tracing
from motionlayer.record import End, Trace
from motionlayer.runtime import LATE, Lateness, Program, Stage, Step, TaskConfig

if TYPE_CHECKING:
    from motionlayer.machine._ads_axes import AdsAxes
    from motionlayer.machine._ads_description import AdsDescription


class MachineRun(DisturbedRun):
    """A run of a machine; what `Simulation` and `RealTime` have in common, and raise when they are made.

    Args:
        machine: what runs.
        keywords: what the run was told; `USUAL` holds for the rest.
        lossless: the cycle waits for the writers of trace and messages; otherwise what finds no room is left out.

    Raises:
        LogError: the message files cannot be written.
        MachineError: the file of persistent parameters means nothing.
        ProgramError: a program of the machine description cannot be loaded.
        ServerFailed: the ADS server cannot begin.
        TraceError: the trace file cannot be written.
    """

    def __init__(self, machine: Machine, keywords: RunKeywords, *, lossless: bool) -> None:
        asked = USUAL | keywords
        description, seed, programs = machine.description, asked["seed"], asked["programs"]
        loaded = [load_program(source) for source in sources_of(machine)] if programs is None else programs
        self.machine = machine
        self.seed = self._first_seed = description.seed if seed is None else seed
        persistent = description.persistent_file
        kept = None if persistent is None else load_kept(machine.folder / persistent, description.axis)
        parts = build(description, self.seed)
        self.axes = Axes(parts.axes)
        self._stage = parts.stage
        self._servos = parts.servos
        self._closed = False
        self.log = Logging(machine, asked["log"], lossless=lossless)
        """The message files."""
        self._tracing = self._recorder(parts, loaded, asked["trace"], lossless=lossless)
        stages = [*parts.stages, self._capture(parts)]
        super().__init__(
            stages,
            base_cycle_ns=description.base_cycle_ns,
            ledger=parts.ledger,
            events=parts.events,
            on_failure=self._abandon,
            patience=asked["patience"],
            tasks=[TaskConfig(name, **dict(entry)) for name, entry in description.task.items()],
        )
        self._connect(parts)
        self._persistence = None if kept is None else Persistence(kept, lambda: self.axis_refs, self.mailbox)
        layer = self._add_layer(lambda: self.axis_refs, parts.stage)
        self._arrange([*stages, *layer, *self._open_ads(asked["ads"], own_process=not lossless)])
        for program in loaded:
            program.start(self)

    def _recorder(
        self,
        parts: Parts,
        programs: Sequence[Loaded],
        trace: bool | str | os.PathLike[str] | None,
        *,
        lossless: bool,
    ) -> Tracing | None:
        """Return what records the run, if anything does; without it the message files are closed again."""
        if trace is None:
            return None
        path = None if isinstance(trace, bool) else Path(trace)
        try:
            return Tracing(self.machine, parts, self.seed, programs, path, keep=trace is not False, lossless=lossless)
        except BaseException:
            self.log.close()
            raise

    def _ads_axes(self) -> "AdsAxes":
        from motionlayer.machine._ads_axes import AdsAxes  # noqa: PLC0415 - most runs have no clients

        return AdsAxes(self._known_symbols, lambda: self.axis_refs, lambda: self._stage.images, self._ledger)

    def _open_ads(self, choice: "AdsDescription | bool", *, own_process: bool) -> Sequence[Stage]:
        """Return the stages of the ADS server; if that cannot begin, the files are closed again."""
        try:
            return self._add_ads(choice, own_process=own_process)
        except BaseException:
            if self._tracing is not None:
                self._tracing.close(self._how_ended())
            self.log.close()
            raise

    def _capture(self, parts: Parts) -> Stage:
        """Return the stage that looks at the setpoints, or only forgets what nobody has looked at."""
        if self._tracing is not None:
            return Stage(Step.CAPTURE, "trace", self._tracing.capture)
        return Stage(Step.CAPTURE, "forget plans", lambda _tick: parts.store.forget_plans())

    def _connect(self, parts: Parts) -> None:
        """Let messages and trace follow the run, and the run take what comes from outside."""
        self.log.attach(parts.events, self.mailbox, parts.ledger)
        if self._tracing is not None:
            self._tracing.attach(self.mailbox)
        self.mailbox.register(LATE, Lateness(parts.ledger, parts.events, self._brake))
        self._take_disturbances()

    @functools.cached_property
    def axis_refs(self) -> Mapping[str, AXIS_REF]:
        """The axes by name, as function blocks know them."""
        images, keep = self._stage.images, self._persistence.keep if self._persistence is not None else None
        return Axes((name, AXIS_REF(axis, images, index, keep)) for index, (name, axis) in enumerate(self.axes.items()))

    def random(self, name: str) -> np.random.Generator:
        """Return a stream of random numbers of its own, keyed by the seed of the run and a name."""
        key = hashlib.blake2b(name.encode(), digest_size=8).digest()
        return np.random.Generator(np.random.PCG64([self.seed, int.from_bytes(key, "little")]))

    @property
    def trace(self) -> Trace:
        """Everything recorded so far; taking it ends the recording, and the run cannot go on.

        Raises:
            ValueError: the run was started without a trace.
            TraceError: it could not be written.
        """
        if self._tracing is None:
            raise ValueError(f"this run records nothing: give {type(self).__name__}(..., trace=True)")
        self._closed = True
        if self._ledger.issuer is None:
            self._scheduler.cancel_all()
        return self._tracing.trace(self._how_ended())

    def _advance(self, ticks: int) -> None:
        self._require_open()
        super()._advance(ticks)

    def _require_open(self) -> None:
        if self._closed:
            raise RuntimeError(
                f"the recording has ended, by run.trace or the end of its block: make a new {type(self).__name__}"
            )

    def close(self) -> str:
        """End the run; programs that have not ended are cancelled. Return its hash, empty without a recording.

        Raises:
            TraceError: the trace could not be written.
            LogError: the writer of messages failed.
        """
        self._closed = True
        self._scheduler.cancel_all()
        self.mailbox.close()
        self._close_ads()
        try:
            return self._tracing.close(self._how_ended()) if self._tracing is not None else ""
        finally:
            self.log.close()

    def _how_ended(self) -> End:
        return End(self.tick, self.ending, inside=self._broken or self.ticking)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self.machine.name} at {self.time:.9g} s>"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _abandon(self, program: Program) -> None:
        """Brake what a failed program was moving; the run goes on until it rests."""
        for axis in self.axes.values():
            if axis.command is not None and axis.command.owner is program:
                axis.abandon()

    def _braking(self) -> bool:
        return any(axis.braking for axis in self.axes.values())

    def _left_alone(self) -> None:
        for axis in self.axes.values():
            axis.left_alone()
