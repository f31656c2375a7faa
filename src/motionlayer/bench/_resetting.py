"""The row `reset.time`: the way back to the beginning, as a training loop takes it after every episode."""

from collections.abc import Mapping
from statistics import median
from types import MappingProxyType
from typing import Final

from motionlayer.bench import _load
from motionlayer.bench._row import Effort, Failed, Figure
from motionlayer.bench._timing import times_us
from motionlayer.machine import MachineRun, Simulation
from motionlayer.nc import AxisState

AXES: Final = 100

EPISODE: Final = 20
"""Ticks between two resets; all axes move in the last ones."""

SHARE: Final = 20
"""One reset is measured for so many samples, because of the episode before it."""

SERVO: Final[Mapping[str, object]] = MappingProxyType(
    {"drive": {"kind": "servo", "position_gain": 40.0, "time_constant": 0.003, "noise": 0.001}}
)


def reset(effort: Effort) -> Figure:
    """Time `run.reset(seed)` of a machine with ideal drives that a cyclic program leads; the note tells servo drives.

    Raises:
        Failed: the axes did not move before, or do not stand where they began after a reset.
    """
    ideal, servo = _reset({}, effort), _reset(SERVO, effort)
    return Figure(ideal, f"{servo:.2g} with servo drives; the trace is kept in memory")


def _reset(settings: Mapping[str, object], effort: Effort) -> float:
    run = Simulation(_load.machine(AXES, settings=settings))
    run.cyclic(_lead)
    _episode(run)
    seeds = iter(range(1 << 62))
    samples = max(3, effort.samples // SHARE)
    time = median(times_us(lambda: run.reset(next(seeds)), samples, between=lambda: _episode(run)))
    run.reset()
    if run.tick or any(axis.set_position != 0.0 or axis.enabled for axis in run.axes.values()):
        raise Failed("a reset run does not stand where it began")
    run.close()
    return time / 1e3


def _lead(run: MachineRun) -> None:
    for axis in run.axes.values():
        if run.tick == 0:
            axis.enable()
        elif run.tick == EPISODE // 2:
            axis.move_absolute(100.0)


def _episode(run: MachineRun) -> None:
    run.step(EPISODE)
    if not all(axis.state is AxisState.DISCRETE_MOTION for axis in run.axes.values()):
        raise Failed("not all axes move")
