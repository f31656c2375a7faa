"""What the measured machines do: the same limits and targets for us and the peers."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from motionlayer.bench._row import Failed
from motionlayer.machine import Machine, Simulation
from motionlayer.nc import Axis
from motionlayer.runtime import Run

VELOCITY: Final = 1000.0
ACCELERATION: Final = 8000.0
JERK: Final = 1e5
"""Limits of every axis, mm and s; the same for braking, because ruckig knows no other."""

MOVE_TICKS: Final = 37
"""Between two commands: the axis moves, in most cases with an acceleration."""

BASE_CYCLE: Final = 1e-3
"""Seconds."""

LIMITS: Final = {"max_velocity": VELOCITY, "max_acceleration": ACCELERATION, "max_jerk": JERK}


def targets(count: int) -> list[float]:
    """Return positions to move to, in mm."""
    found: list[float] = np.random.default_rng(1).uniform(-500.0, 500.0, count).tolist()
    return found


def machine(
    axes: int, signals: tuple[str, ...] = ("*",), settings: Mapping[str, object] = MappingProxyType({})
) -> Machine:
    """Return a machine of equal axes, with these settings, that records these signals."""
    description: dict[str, Any] = {
        "format": 1,
        "name": "bench",
        "axis": {f"A{number}": {**LIMITS, **settings} for number in range(axes)},
        "trace": {"signals": list(signals)},
    }
    return Machine.from_dict(description)


def enabled(machine: Machine) -> Simulation:
    """Return a run without a trace whose axes are all enabled.

    Raises:
        Failed: one is not.
    """
    run = Simulation(machine, trace=None)
    _enable(run, run.axes)
    return run


def moving(machine: Machine) -> Simulation:
    """Return a run without a trace whose axes all move without end.

    Raises:
        Failed: one does not.
    """
    run = Simulation(machine, trace=None)
    set_off(run, run.axes)
    return run


def set_off(run: Run, axes: Mapping[str, Axis]) -> None:
    """Let all axes of a run move without end.

    Raises:
        Failed: one does not.
    """
    _enable(run, axes)
    commands = [axis.move_velocity(100.0 + number % 7) for number, axis in enumerate(axes.values())]
    run.step(500)
    if not all(command.in_velocity for command in commands):
        raise Failed("not all axes move")


def _enable(run: Run, axes: Mapping[str, Axis]) -> None:
    commands = [axis.enable() for axis in axes.values()]
    run.step(5)
    if not all(command.done for command in commands):
        raise Failed("the axes could not be enabled")
