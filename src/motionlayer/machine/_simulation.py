"""`Simulation`: a machine that runs faster than real time, without hardware."""

import difflib
import hashlib
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, NoReturn, Self

import numpy as np

from motionlayer.command import Command, all_of
from motionlayer.drive import Fault
from motionlayer.machine._build import build
from motionlayer.machine._machine import Machine
from motionlayer.machine._programs import Loaded, load_program, sources_of
from motionlayer.machine._tracing import Tracing
from motionlayer.record import Trace
from motionlayer.runtime import PATIENCE, Program, Run, Stage, Step

if TYPE_CHECKING:
    from motionlayer.nc import Axis, AxisCommand


class Axes(dict[str, "Axis"]):
    """The axes of a machine by name."""

    def __missing__(self, name: str) -> NoReturn:
        near = difflib.get_close_matches(name, self, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise KeyError(f"no axis {name!r}; this machine has {', '.join(self)}{hint}")


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
        if not isinstance(machine, Machine):
            raise TypeError(f"Simulation({machine!r}): give a machine, as in Simulation(Machine.load({machine!r}))")
        loaded = [load_program(source) for source in sources_of(machine)] if programs is None else programs
        self.machine = machine
        self.seed = machine.description.seed if seed is None else seed
        parts = build(machine.description, self.seed)
        self.axes: Mapping[str, Axis] = Axes(parts.axes)
        """The axes by name."""
        self._servos = parts.servos
        self._closed = False
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
        self._servos.inject(list(self.axes).index(axis), fault, begin)

    def emergency_stop(self) -> Command[tuple[Any, ...]]:
        """Stop all axes with their maximum dynamics, also those that stop more gently already.

        What stands takes no command; an axis in error brakes by itself.

        Returns:
            A command that is done when all rest; until then they take no other motion.
        """
        return all_of(*[axis.emergency_stop() for axis in self.axes.values() if axis.command is not None])

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
        self._closed = True
        return self._tracing.trace()

    def step(self, ticks: int = 1) -> None:
        """Run a number of ticks, programs or not.

        Raises:
            RuntimeError: the recording has ended, by `trace` or `close`.
            CycleFault: a step of the runtime itself failed.
        """
        if self._closed:
            raise RuntimeError("the recording has ended, by run.trace or the end of its block: make a new Simulation")
        super().step(ticks)

    def close(self) -> str:
        """End the run; programs that have not ended are cancelled. Return its hash, empty without a recording.

        Raises:
            TraceError: the trace could not be written.
        """
        self._closed = True
        self._scheduler.cancel_all()
        return self._tracing.close() if self._tracing is not None else ""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _abandon(self, program: Program) -> None:
        """Halt what a failed program was moving; the run goes on until it rests."""
        owned = [axis for axis in self.axes.values() if axis.command is not None and axis.command.owner is program]
        brakes = [brake for brake in (axis.abandon() for axis in owned) if brake is not None]
        if brakes:
            self.start(_rest(brakes), f"halt after {program.name}")


async def _rest(brakes: "list[AxisCommand]") -> None:
    for brake in brakes:
        await brake.settled()
