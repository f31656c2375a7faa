"""Small machines, and ways to run them, for tests that move something."""

from collections.abc import Callable, Coroutine
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motionlayer import AxisState, Machine, Simulation
from motionlayer.command import ErrorId
from motionlayer.nc import Axis, AxisCommand

PER_TICK = 0.001
"""Base cycle in seconds."""

LINEAR: dict[str, Any] = {
    "max_velocity": 500.0,
    "max_acceleration": 5000.0,
    "max_deceleration": 6000.0,
    "max_jerk": 1e5,
    "software_limit_min": -100.0,
    "software_limit_max": 400.0,
}
"""A linear axis whose every full move reaches its velocity and both accelerations."""

SWITCH = {"mode": "switch", "switch": -50.0, "velocity": 40.0, "position": 7.0}
"""Homing to a switch that is on at and below -50."""


def machine(count: int = 1, **changes: Any) -> Machine:
    """Return a machine with the first `count` of the axes X, Y, Z, all alike."""
    return Machine.from_dict({"format": 1, "name": "test", "axis": dict.fromkeys("XYZ"[:count], LINEAR | changes)})


def one_axis(**changes: Any) -> tuple[Simulation, Axis]:
    """Return a run and its axis X, without power."""
    run = Simulation(machine(**changes))
    return run, run.axes["X"]


def ready(**changes: Any) -> tuple[Simulation, Axis]:
    """Return a run and its axis X in StandStill."""
    run, axis = one_axis(**changes)
    axis.enable()
    run.step(2)
    return run, axis


def play(run: Simulation, program: Callable[[], Coroutine[Any, Any, Any]], time: float = 20.0) -> None:
    """Run a program to its end; a test that hangs fails after `time` seconds of the run."""
    start = run.tick
    run.run(program(), time=time)
    assert run.tick < start + round(time / PER_TICK), "the program did not end"


def finish(run: Simulation, command: AxisCommand, ticks: int = 20_000) -> int:
    """Step until a command has ended; return how many ticks it took."""
    start = run.tick
    while command.busy:
        assert run.tick < start + ticks, f"{command.name} did not end"
        run.step()
    return run.tick - start


def state_of(axis: Axis) -> AxisState:
    """Return the state; a type checker does not know that the attribute changes between two lines."""
    return axis.state


def error_of(command: AxisCommand) -> ErrorId | None:
    """Return the error id of a command, None without."""
    return command.error.id if command.error is not None else None


def full_move_time(distance: float, velocity: float = 500.0) -> float:
    """Return the time of a move of LINEAR from rest to rest, in closed form.

    Each ramp is symmetric in time: to v with a and j in v/a + a/j, at half the velocity in the mean.
    """
    a, d, j = 5000.0, 6000.0, 1e5
    assert velocity >= max(a, d) ** 2 / j, "the ramps do not reach their accelerations"
    up, down = velocity / a + a / j, velocity / d + d / j
    assert distance >= velocity * (up + down) / 2, "the move does not reach its velocity"
    return distance / velocity + (up + down) / 2


def follow(run: Simulation, axis: Axis, command: AxisCommand, ticks: int = 20_000) -> NDArray[np.float64]:
    """Step until a command has ended; return p, v, a of every tick, shape (n, 3), and check that they are smooth."""
    rows = [(axis.set_position, axis.set_velocity, axis.set_acceleration)]
    while command.busy:
        assert len(rows) <= ticks, f"{command.name} did not end"
        run.step()
        rows.append((axis.set_position, axis.set_velocity, axis.set_acceleration))
    array = np.array(rows)
    assert_smooth(array)
    return array


def assert_smooth(rows: NDArray[np.float64]) -> None:
    """Check p, v, a of successive ticks of LINEAR against its maxima: an own evaluation, from the samples alone."""
    p, v, a = rows.T
    dt, jerk = PER_TICK, 1e5 * (1.0 + 1e-9)
    assert np.all(np.abs(v) <= 500.0 * (1.0 + 1e-9))
    assert np.all(np.abs(a)[v * a > 0.0] <= 5000.0 * (1.0 + 1e-9))
    assert np.all(np.abs(a)[v * a < 0.0] <= 6000.0 * (1.0 + 1e-9))
    assert np.all(np.abs(np.diff(a)) <= jerk * dt + 1e-7)
    assert np.all(np.abs(np.diff(v) - a[:-1] * dt) <= jerk * dt**2 / 2.0 + 1e-10)
    assert np.all(np.abs(np.diff(p) - (v[:-1] + a[:-1] * dt / 2.0) * dt) <= jerk * dt**3 / 6.0 + 1e-11)
