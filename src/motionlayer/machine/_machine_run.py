"""`MachineRun`: a machine that runs, whatever sets the pace."""

import difflib
import functools
import hashlib
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, NoReturn, Self, TypeVar

import numpy as np

from motionlayer.command import Command, all_of
from motionlayer.drive import Fault
from motionlayer.fb import AXIS_REF
from motionlayer.machine._ads_axes import AdsAxes
from motionlayer.machine._ads_description import AdsDescription
from motionlayer.machine._ads_run import ServedRun
from motionlayer.machine._build import Parts, build
from motionlayer.machine._logging import Logging
from motionlayer.machine._machine import Machine
from motionlayer.machine._outside import EMERGENCY_STOP, INJECT, pack_fault, unpack_fault
from motionlayer.machine._persistence import Persistence, load_kept
from motionlayer.machine._programs import Loaded, load_program, sources_of
from motionlayer.machine._run_keywords import USUAL, RunKeywords
from motionlayer.machine._tracing import Tracing
from motionlayer.record import End, Trace
from motionlayer.runtime import LATE, Lateness, Program, Stage, Step, TaskConfig

if TYPE_CHECKING:
    from motionlayer.nc import Axis


V = TypeVar("V")


class Axes(dict[str, V]):
    """The axes of a machine, or their interfaces, by name."""

    def __missing__(self, name: str) -> NoReturn:
        near = difflib.get_close_matches(name, self, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise KeyError(f"no axis {name!r}; this machine has {', '.join(self) or 'none'}{hint}")


class MachineRun(ServedRun):
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
        self.axes: Mapping[str, Axis] = Axes(parts.axes)
        """The axes by name."""
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
        self._arrange([*stages, *layer, self._open_ads(asked["ads"], own_process=not lossless)])
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

    def _open_ads(self, choice: AdsDescription | bool, *, own_process: bool) -> Stage:
        """Return the stage of the ADS server; if that cannot begin, the files are closed again."""
        try:
            axes = AdsAxes(self._known_symbols, lambda: self.axis_refs, lambda: self._stage.images, self._ledger)
            return self._add_ads(choice, axes, own_process=own_process)
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
        self.mailbox.register(INJECT, self._injected)
        self.mailbox.register(EMERGENCY_STOP, self._emergency_stopped)

    @functools.cached_property
    def axis_refs(self) -> Mapping[str, AXIS_REF]:
        """The axes by name, as function blocks know them."""
        images, keep = self._stage.images, self._persistence.keep if self._persistence is not None else None
        return Axes((name, AXIS_REF(axis, images, index, keep)) for index, (name, axis) in enumerate(self.axes.items()))

    def inject(self, axis: str, fault: Fault, tick: int | None = None) -> None:
        """Let something go wrong with the servo drive of an axis.

        Args:
            axis: name of the axis.
            fault: what.
            tick: in whose inputs it shows first; the next tick where left out.

        Raises:
            KeyError: no such axis.
            ValueError: its drive is ideal, or the tick has passed.
        """
        if self.machine.description.axis[self.axes[axis].name].drive.kind != "servo":
            raise ValueError(f'{axis}: its drive is ideal, and never has a fault; set kind = "servo"')
        earliest = self.tick + 1 if self._ledger.issuer is not None else self.tick
        begin = earliest if tick is None else tick
        if begin < earliest:
            raise ValueError(
                f"{axis}: a fault at tick {begin}, and tick {earliest} is the next whose inputs can show it"
            )
        self._note(INJECT, pack_fault(axis, fault, begin))
        self._servos.inject(list(self.axes).index(axis), fault, begin)

    def _injected(self, payload: bytes) -> None:
        axis, fault, tick = unpack_fault(payload)
        self._servos.inject(list(self.axes).index(axis), fault, tick)

    def emergency_stop(self) -> Command[tuple[Any, ...]]:
        """Stop all axes with their maximum dynamics, also those that stop more gently already.

        What stands takes no command; an axis in error brakes by itself.

        Returns:
            A command that is done when all rest; until then they take no other motion.
        """
        self._note(EMERGENCY_STOP)
        return self._brake()

    def _emergency_stopped(self, _payload: bytes) -> None:
        self._brake()

    def _brake(self) -> Command[tuple[Any, ...]]:
        return all_of(*[axis.emergency_stop() for axis in self.axes.values() if axis.command is not None])

    def _note(self, channel: str, payload: bytes = b"") -> None:
        """Record what is done to the run from outside; what programs do follows from them."""
        if self._ledger.issuer is None and not self.ticking:
            self.mailbox.note(channel, payload)

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
        self.ads.close()
        try:
            return self._tracing.close(self._how_ended()) if self._tracing is not None else ""
        finally:
            self.log.close()

    def _how_ended(self) -> End:
        return End(self.tick, self.ending, inside=self._broken or self.ticking)

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
