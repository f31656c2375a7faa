"""`Simulation`: a machine that runs faster than real time, without hardware."""

import hashlib
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Self

import numpy as np

from motionlayer.machine._build import build
from motionlayer.machine._machine import Machine
from motionlayer.machine._programs import Loaded, load_program, sources_of
from motionlayer.machine._tracing import Tracing
from motionlayer.record import Trace
from motionlayer.runtime import PATIENCE, Program, Run, Stage, Step

if TYPE_CHECKING:
    from motionlayer.nc import Axis


class Simulation(Run):
    """A run of a machine with simulated drives, deterministic and as fast as the computer allows.

    Args:
        machine: what runs.
        seed: of everything random; that of the machine description where left out.
        trace: True keeps the trace in memory, a path writes it to that file, False records nothing but the
            hash, None not even that.
        programs: started in tick 0, in order; those of the machine description where left out.
        patience: wall time in seconds after which a program that does not yield ends the run.

    Raises:
        ProgramError: a program of the machine description cannot be loaded.
        TraceError: the trace file cannot be written.
    """

    def __init__(
        self,
        machine: Machine,
        *,
        seed: int | None = None,
        trace: bool | str | os.PathLike[str] | None = True,
        programs: Sequence[Loaded] | None = None,
        patience: float = PATIENCE,
    ) -> None:
        loaded = [load_program(source) for source in sources_of(machine)] if programs is None else programs
        self.machine = machine
        self.seed = machine.description.seed if seed is None else seed
        parts = build(machine.description)
        self.axes: Mapping[str, Axis] = parts.axes
        """The axes by name."""
        self._tracing: Tracing | None = None
        stages = list(parts.stages)
        if trace is not None:
            path = None if isinstance(trace, bool) else Path(trace)
            self._tracing = Tracing(machine, parts, self.seed, loaded, path, keep=trace is not False)
            stages.append(Stage(Step.CAPTURE, "trace", self._tracing.capture))
        else:
            stages.append(Stage(Step.CAPTURE, "forget plans", lambda _tick: parts.store.forget_plans()))
        super().__init__(
            stages,
            base_cycle_ns=machine.description.base_cycle_ns,
            ledger=parts.ledger,
            events=parts.events,
            on_failure=self._abandon,
            patience=patience,
        )
        for program in loaded:
            self.start(program.function(self), program.name)

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
            raise ValueError("this run records nothing: give Simulation(..., trace=True)")
        return self._tracing.trace()

    def close(self) -> str:
        """End the recording; return the hash of the run, empty without a recording.

        Raises:
            TraceError: the trace could not be written.
        """
        return self._tracing.close() if self._tracing is not None else ""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _abandon(self, program: Program) -> None:
        for axis in self.axes.values():
            if axis.command is not None and axis.command.owner is program:
                axis.abandon()
