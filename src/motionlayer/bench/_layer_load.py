"""What the group `layer` measures: machines with a motion layer and without, and what their axes do."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from time import perf_counter_ns
from typing import Any, Final

from motionlayer.bench import _load
from motionlayer.bench._row import Failed
from motionlayer.bench._timing import WARM_UP, quiet
from motionlayer.layer import AxisCommand, AxisObject, MotionLayer, Progress
from motionlayer.machine import Machine, Simulation
from motionlayer.nc import Axis, Direction

AXES: Final = 64
FAR: Final = 1e7
"""Target that no axis comes to while it is measured, mm."""

STARTING: Final = 20_000
"""Ticks in which a layer must have brought its axes up."""

TURN: Final = 40
"""Cycles after which the other run has its turn; all phases come equally often."""

ENDLESS: Final = (AxisCommand.MOVE_POS, AxisCommand.SEND_TO_POS, AxisCommand.MOVE_BUFFER, AxisCommand.MOVE_BUFFER_VELO)
"""What the axes of a busy layer do, in turns; none of them ends by itself on such a way."""


def layered_run(changes: Mapping[str, Any]) -> Simulation:
    """Return a run whose layer has brought its axes up and switched them on.

    Raises:
        Failed: it has not.
    """
    run = Simulation(_machine({"layer": changes}), trace=None)
    for _ in range(STARTING):
        if run.layer.ready:
            break
        run.step()
    for axis in run.axes.values():
        axis.enable()
    run.step(5)
    if not all(axis.enabled for axis in run.axes.values()):
        raise Failed("the axes could not be brought up")
    return run


def _machine(top: Mapping[str, Any]) -> Machine:
    axes = {f"A{number}": dict(_load.LIMITS) for number in range(AXES)}
    return Machine.from_dict({"format": 1, "name": "bench", "axis": axes, **top})


@contextmanager
def pair(changes: Mapping[str, Any]) -> Iterator[tuple[Simulation, Simulation]]:
    """Yield runs of the same machine with a layer and without, all axes at rest."""
    with layered_run(changes) as layered, _load.enabled(_machine({})) as bare:
        yield layered, bare


def layer_of(run: Simulation) -> MotionLayer:
    """Return the motion layer of a run.

    Raises:
        Failed: it has none of its own.
    """
    layer = run.layer
    if not isinstance(layer, MotionLayer):
        raise Failed("the machine commands a motion layer and has none")
    return layer


def set_off(layered: Simulation, bare: Simulation) -> None:
    """Give every axis a job, and the same axis without a layer the motion that belongs to it."""
    for number, (one, axis) in enumerate(zip(layer_of(layered).axis, bare.axes.values(), strict=True)):
        command = ENDLESS[number % len(ENDLESS)]
        _drop(one, command)
        endless(axis, command)
    layered.step(500)
    bare.step(500)
    require_jobs(layered)


def _drop(one: AxisObject, command: AxisCommand) -> None:
    one.data.position, one.data.velocity, one.options.distance = FAR, 100.0, FAR
    one.ctrl.cmd = command


def endless(axis: Axis, command: AxisCommand) -> None:
    """Let an axis move as a command of the layer lets it."""
    if command is AxisCommand.MOVE_BUFFER_VELO:
        axis.move_velocity(100.0, Direction.POSITIVE)
    else:
        axis.move_absolute(FAR, velocity=100.0)


def require_jobs(run: Simulation) -> None:
    """Raise `Failed` if a job has ended."""
    ended = [one.name for one in layer_of(run).axis if one.state.split().progress in (Progress.DONE, Progress.ERROR)]
    if ended:
        raise Failed(f"{len(ended)} of {AXES} jobs have ended, that of {ended[0]} first")


def differences(
    one: Simulation, other: Simulation, samples: int, before: Callable[[], object] = lambda: None
) -> list[float]:
    """Step two runs in turns; return by how much each cycle of the first takes longer, µs.

    Args:
        one: with the layer.
        other: without it.
        samples: cycles that count.
        before: called before each cycle of the first, untimed.
    """
    costs = []
    turns = 1 + int(WARM_UP * samples / TURN) + -(-samples // TURN)
    with quiet():
        for _ in range(turns):
            longer, shorter = (_turn(run, what) for run, what in ((one, before), (other, _nothing)))
            costs += [(long - short) / 1e3 for long, short in zip(longer, shorter, strict=True)]
    return costs[-samples:]


def _nothing() -> None:
    """Do nothing."""


def _turn(run: Simulation, before: Callable[[], object]) -> list[int]:
    """Step a run for a while; return how long each cycle took, ns."""
    times = []
    for _ in range(TURN):
        before()
        start = perf_counter_ns()
        run.step()
        times.append(perf_counter_ns() - start)
    return times
