"""ruckig as a second opinion on durations.

Its tolerances are absolute, so everything is scaled with L = V²/A and T = V/A; a long cruise is taken out of a
distance beyond 10^3 L and added to the time again.
"""

from collections.abc import Iterator

import ruckig

from motionlayer.profile import Limits

LONG = 1e3

NUDGES = ((0.0, 0.0), (1e-13, 0.0), (0.0, 1e-13), (0.0, -1e-13), (1e-13, 1e-13), (1e-13, -1e-13))
"""Relative changes of velocity limit and distance. In some problems whose phases just touch a limit ruckig misses the
best profile (28 to 80 % longer in small integers); the problem beside it is solved well."""


def position_times(v: float, a: float, distance: float, limits: Limits) -> Iterator[float]:
    """Give ruckig's shortest time to rest, of the problem itself, then of those beside it.

    The deceleration limit is a signed bound, so v must keep its sign if it differs from the acceleration limit.
    """
    for faster, farther in NUDGES:
        yield _position_time(v, a, distance * (1.0 + farther), limits, 1.0 + faster)


def _position_time(v: float, a: float, distance: float, limits: Limits, fastest: float) -> float:
    unit = limits.velocity / limits.acceleration
    length = limits.velocity * unit
    order = _order(ruckig.ControlInterface.Position, v, a, limits)
    order.max_velocity = [fastest]
    shortened = max(abs(distance) / length - LONG, 0.0)
    order.target_position = [distance / length - (shortened if distance > 0.0 else -shortened)]
    return (float(_trajectory(order).duration) + shortened) * unit


def passing_times(v: float, a: float, distance: float, u: float, limits: Limits) -> Iterator[float]:
    """Give ruckig's shortest time to pass a distance with the velocity u: of the problem, then of those beside it."""
    unit = limits.velocity / limits.acceleration
    length = limits.velocity * unit
    shortened = max(abs(distance) / length - LONG, 0.0)
    for faster, farther in NUDGES:
        order = _order(ruckig.ControlInterface.Position, v, a, limits)
        order.max_velocity = [1.0 + faster]
        order.target_position = [(distance / length - (shortened if distance > 0.0 else -shortened)) * (1.0 + farther)]
        order.target_velocity = [u / limits.velocity]
        yield (float(_trajectory(order).duration) + shortened) * unit


def velocity_time(v: float, a: float, target: float, target_a: float, limits: Limits) -> tuple[float, float]:
    """Return the shortest time from (v, a) to (target, target_a), and the distance on the way."""
    unit = limits.velocity / limits.acceleration
    order = _order(ruckig.ControlInterface.Velocity, v, a, limits)
    order.target_velocity = [target / limits.velocity]
    order.target_acceleration = [target_a / limits.acceleration]
    trajectory = _trajectory(order)
    end = trajectory.at_time(trajectory.duration)[0][0]
    return trajectory.duration * unit, end * limits.velocity * unit


def _order(interface: ruckig.ControlInterface, v: float, a: float, limits: Limits) -> ruckig.InputParameter:
    unit = limits.velocity / limits.acceleration
    order = ruckig.InputParameter(1)
    order.control_interface = interface
    order.current_velocity = [v / limits.velocity]
    order.current_acceleration = [a / limits.acceleration]
    order.max_velocity = [1.0]
    order.max_acceleration = [1.0]
    order.min_acceleration = [-limits.deceleration / limits.acceleration]
    order.max_jerk = [limits.jerk * unit / limits.acceleration]
    return order


def _trajectory(order: ruckig.InputParameter) -> ruckig.Trajectory:
    trajectory = ruckig.Trajectory(1)
    result = ruckig.Ruckig(1).calculate(order, trajectory)
    assert result in (ruckig.Result.Working, ruckig.Result.Finished), f"ruckig: {result}\n{order}"
    return trajectory
