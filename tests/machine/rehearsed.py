"""Rehearse a machine, then run it in every way; print the kernels that the rehearsal has not loaded."""

import contextlib
import sys
from collections.abc import Callable
from typing import Any

from motionlayer import Direction, Fault, Machine, Simulation, _kernel
from motionlayer.machine._rehearsal import rehearse
from motionlayer.nc import Axis, BufferMode, Calibration, HomingMode

Use = Callable[[Axis], object]

LIMITS: dict[str, Any] = {
    "max_velocity": 500.0,
    "max_acceleration": 5000.0,
    "max_jerk": 1e5,
    "software_limit_min": -200.0,
    "software_limit_max": 200.0,
}
SERVO = {"kind": "servo", "position_gain": 80.0, "time_constant": 0.002, "noise": 0.001}
SWITCH = {"mode": "switch", "switch": -50.0, "velocity": 40.0}
SIGNALS = {"pulse_period": 10.0, "turn": 8.0, "latch": -45.0, "latch_width": 0.5, "sync_velocity": 20.0}
INDEX = SWITCH | SIGNALS | {"mode": "index"}
MONITOR = {"lag": 5.0, "target_window": 0.1, "target_time": 0.01, "range_window": 1.0}

MACHINE = Machine.from_dict(
    {
        "format": 1,
        "name": "all",
        "axis": {
            "A": LIMITS,
            "B": LIMITS | {"drive": SERVO, "monitor": MONITOR},
            "C": LIMITS | {"drive": SERVO, "home": SWITCH},
            "D": LIMITS | {"home": SWITCH},
            "E": LIMITS | {"home": INDEX},
            "F": LIMITS | {"drive": SERVO, "home": INDEX},
        },
        "group": {"all": {"axes": list("ABCDEF"), "reaction": "stop"}},
    }
)


def loaded() -> set[tuple[str, str]]:
    """Return every kernel and signature that is in memory."""
    found = set()
    for module in [value for name, value in sys.modules.items() if name.startswith("motionlayer")]:
        for kernel in vars(module).values():
            found |= {(kernel.__name__, str(one)) for one in getattr(kernel, "signatures", ())}
    return found


def use(run: Simulation) -> None:
    axes = list(run.axes.values())
    for axis in axes:
        axis.enable()
    run.step(5)
    steps: list[Use] = [
        lambda axis: axis.move_absolute(100.0),
        lambda axis: axis.move_relative(-30.0, velocity=50.0, jerk=9e4),
        lambda axis: axis.move_velocity(100.0, Direction.NEGATIVE),
        lambda axis: axis.define_position(-1.0, relative=True),
        lambda axis: axis.set_override(0.3),
        lambda axis: axis.passes(axis.set_position - 1.0),
        lambda axis: axis.set_override(1.0),
        lambda axis: axis.move_continuous_relative(20.0, 50.0),
        lambda axis: axis.move_continuous_absolute(-90.0, -50.0),
        lambda axis: axis.move_absolute(0.0, buffer_mode=BufferMode.BLENDING_LOW),
        lambda axis: axis.move_absolute(10.0, buffer_mode=BufferMode.BUFFERED),
        lambda axis: axis.move_additive(1.0),
        lambda axis: axis.move_modulo(270.0),
        lambda axis: axis.halt(),
        lambda axis: axis.stop(),
        lambda axis: axis.jog(Direction.NEGATIVE),
        lambda axis: axis.halt(),
        lambda axis: axis.move_absolute(0.0),
        lambda axis: axis.home(),
        lambda axis: axis.stop(),
        lambda axis: axis.move_velocity(400.0),
    ]
    for step in steps:
        for axis in axes:
            step(axis)
        run.step(30)
    run.step(2000)
    home(run, axes)
    run.inject("B", Fault("drive_error"))
    run.step(100)
    for axis in axes:
        axis.reset()
    run.step(100)
    run.emergency_stop()
    for axis in axes:
        axis.disable()
    run.step(100)


def home(run: Simulation, axes: list[Axis]) -> None:
    """Home in every way that the drives have signals for; define positions at rest."""
    for axis in axes:
        axis.halt()
    run.step(500)
    for method in HomingMode:
        for axis in axes:
            axis.home(method=method, search_velocity=100.0)
        run.step(3000)
    for axis in axes:
        axis.define_position(10.0, clear_lag=True)
        axis.define_position(clear_offset=True)
        axis.home(mode=Calibration.DIRECT, clear_lag=True)


rehearse(MACHINE)
before = loaded()
with contextlib.closing(Simulation(MACHINE)) as run:
    use(run)
print(_kernel.MODE, len(before) > 5, sorted(loaded() - before))
