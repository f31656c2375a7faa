"""Machines with servo drives, for tests of monitors, faults and reactions."""

from typing import Any

from motionlayer import Machine, Simulation
from motionlayer.nc import Axis
from tests.machines import LINEAR

SERVO: dict[str, Any] = {
    "kind": "servo",
    "position_gain": 50.0,
    "time_constant": 0.002,
    "dead_time": 0.002,
    "brake_deceleration": 8000.0,
}


def servo_machine(
    names: str = "X",
    *,
    drive: dict[str, Any] | None = None,
    monitor: dict[str, Any] | None = None,
    top: dict[str, Any] | None = None,
    **changes: Any,
) -> Machine:
    """Return a machine whose axes are LINEAR with servo drives."""
    axis = LINEAR | {"drive": SERVO | (drive or {}), "monitor": monitor or {}} | changes
    return Machine.from_dict({"format": 1, "name": "servos", "axis": dict.fromkeys(names, axis)} | (top or {}))


def ready_servos(names: str = "X", **options: Any) -> tuple[Simulation, list[Axis]]:
    """Return a run with its axes in StandStill."""
    run = Simulation(servo_machine(names, **options))
    axes = list(run.axes.values())
    for axis in axes:
        axis.enable()
    run.step(2)
    return run, axes
