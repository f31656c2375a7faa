"""`Loopback`: machines in one process whose images are wired to one another, as a fieldbus or a shared memory would.

In each cycle the controllers run first; what they have written reaches the motion machine in the same cycle, and what
that answers reaches them in their next one. Commands are carried from the end of the first start-up on. Everything
happens in one thread and in the order of the cycle, so that the runs are as repeatable as one alone. What is carried is
an input of the area that it is carried to: each machine can be replayed from its own trace.
"""

from collections.abc import Coroutine, Mapping
from typing import Any, Final, NamedTuple

from motionlayer.layer import ORIGINAL, START, ControlSide
from motionlayer.machine._machine_run import MachineRun
from motionlayer.runtime import Area


class _Wire:
    """Carries one output area to one input area."""

    def __init__(self, source: Area, target: Area) -> None:
        self._source = source
        self._target = target

    def carry(self) -> None:
        """Post what is not there yet."""
        data = bytes(self._source.view)
        if not self._target.written or data != bytes(self._target.view):
            self._target.post(data)


class _Control(NamedTuple):
    """A control machine, and what it is wired by."""

    run: MachineRun
    side: ControlSide
    commands: list[_Wire]
    states: list[_Wire]


class Loopback:
    """A motion machine and the control machines that command it.

    Args:
        motion: a run with `[layer]`.
        controls: a run with `[control]`, which commands what a map of all objects holds; or several by the names of the
            maps that they command.

    Raises:
        TypeError: one of the runs is not of that kind.
        ValueError: an image has no partner or one of another size, or the base cycles differ; the message names both.
    """

    def __init__(self, motion: MachineRun, controls: MachineRun | Mapping[str, MachineRun]) -> None:
        self._motion = motion
        named = {ORIGINAL: controls} if isinstance(controls, MachineRun) else controls
        sides = {prefix: _require_pair(motion, control) for prefix, control in named.items()}
        self._controls: Final = [_wired(motion, named[prefix], side, prefix) for prefix, side in sides.items()]

    def step(self, ticks: int = 1) -> None:
        """Run a number of cycles of all machines.

        Raises:
            CycleFault: a step of the runtime itself failed.
        """
        for _ in range(ticks):
            for one in self._controls:
                one.run.step()
            for one in self._controls:
                if one.side.given is not None:
                    for wire in one.commands:
                        wire.carry()
            self._motion.step()
            for one in self._controls:
                for wire in one.states:
                    wire.carry()

    def run(self, program: Coroutine[Any, Any, Any] | None = None, *, time: float | None = None) -> bool:
        """Run until all programs of all machines have ended and no axis brakes, or the time is over.

        Args:
            program: started first, on the first control machine; an exception that leaves it is raised here.
            time: seconds from now; without end where left out.

        Returns:
            True if all programs ended by themselves.

        Raises:
            CycleFault: a step of the runtime itself failed.
        """
        motion = self._motion
        main = self._controls[0].run.start(program) if program is not None else None
        end = None if time is None else motion.time + time
        runs = [*(one.run for one in self._controls), motion]
        while not all(run.idle for run in runs) and (end is None or motion.time < end - 0.5e-9 * motion.base_cycle_ns):
            self.step()
        if main is not None and main.failure is not None:
            raise main.failure
        return all(run.idle for run in runs)


def _require_pair(motion: MachineRun, control: MachineRun) -> ControlSide:
    """Return the control side; refuse runs that cannot be wired.

    Raises:
        TypeError: one is not of its kind.
        ValueError: their base cycles differ.
    """
    if motion.machine.description.layer is None:
        raise TypeError(f"{motion.machine.name} has no motion layer: its machine file needs [layer]")
    if control.machine.description.control is None or not isinstance(control.layer, ControlSide):
        raise TypeError(f"{control.machine.name} is no control side: its machine file needs [control]")
    if motion.base_cycle_ns != control.base_cycle_ns:
        raise ValueError(
            f"base_cycle_ns: {motion.base_cycle_ns} in {motion.machine.name}, {control.base_cycle_ns} in "
            f"{control.machine.name}; machines that are stepped together have the same"
        )
    return control.layer


def _wired(motion: MachineRun, control: MachineRun, side: ControlSide, prefix: str) -> _Control:
    """Return a control machine with the wires between it and a map."""
    here, there = f"{prefix}_", f"{ORIGINAL}_"
    commands = {name: name.replace(there, here, 1) for name in control.areas if name.startswith(f"{there}out.")}
    states = {name: name.replace(there, here, 1) for name in control.areas if name.startswith(f"{there}in.")}
    down = [(name, partner.replace("_out.", "_in.", 1)) for name, partner in commands.items()]
    up = [(name, partner.replace("_in.", "_out.", 1)) for name, partner in states.items()] + [(START, START)]
    for name, partner in (*down, *up):
        _require_partner(motion, control, name, partner)
    return _Control(
        control,
        side,
        [_Wire(control.areas[name], motion.areas[partner]) for name, partner in down],
        [_Wire(motion.areas[partner], control.areas[name]) for name, partner in up],
    )


def _require_partner(motion: MachineRun, control: MachineRun, name: str, partner: str) -> None:
    """Refuse an image without a partner of its size.

    Raises:
        ValueError: names both.
    """
    who, whose = control.machine.name, motion.machine.name
    if partner not in motion.areas:
        mapped = ", ".join(motion.areas) or "none"
        raise ValueError(f"{who}: the image {name} has no partner {partner} in {whose}, which has {mapped}")
    sizes = control.areas[name].size, motion.areas[partner].size
    if sizes[0] != sizes[1]:
        raise ValueError(
            f"{who}: the image {name} has {sizes[0]} bytes, its partner {partner} in {whose} {sizes[1]}; "
            "number of axes, and sizes, must be those of the map"
        )
