"""The oriented stop of the NC ports: the next orientation, no faster than before, and never back."""

import struct

import numpy as np
import pytest
from tests.machines import LINEAR

from motionlayer import Machine, Simulation
from motionlayer.machine._ads_stops import oriented_stop
from motionlayer.nc import Direction
from motionlayer.verify import assert_valid

ENDLESS = {name: value for name, value in LINEAR.items() if not name.startswith("software")}
PERIOD, ORIENTATION = 20.0, 5.0
MACHINE = Machine.from_dict({"format": 1, "name": "m", "axis": {"X": {**ENDLESS, "modulo": {"period": PERIOD}}}})
MAX_DECELERATION, MAX_JERK = 6000.0, 1e5


@pytest.mark.parametrize("deceleration", [0.0, 1000.0, 150.0])
@pytest.mark.parametrize("velocity", [500.0, -200.0])
@pytest.mark.parametrize("override", [1.0, 0.5])
@pytest.mark.parametrize("reached", [0.1, 1.0])
def test_it_ends_in_the_next_orientation(deceleration: float, velocity: float, override: float, reached: float) -> None:
    """`reached`: the part of its velocity that the axis has, still accelerating below 1."""
    with Simulation(MACHINE) as run:
        axis, ref = run.axes["X"], run.axis_refs["X"]
        axis.enable()
        run.advance(0.1)
        axis.set_override(override)
        assert axis.move_velocity(abs(velocity), Direction.NEGATIVE if velocity < 0.0 else Direction.POSITIVE).busy
        while abs(axis.set_velocity) < 0.999 * reached * override * abs(velocity):
            run.step()
        start, command = run.tick, oriented_stop(ref, struct.pack("<3d", ORIENTATION, deceleration, 0.0))
        while command.busy:
            run.step()
        run.step()
        trace = run.trace
    assert_valid(trace)
    heading = np.sign(velocity)
    place, speed = heading * trace["X.set_position"][start:], heading * trace["X.set_velocity"][start:]
    assert heading * place[-1] % PERIOD == ORIENTATION
    assert speed.min() >= -1e-9
    risen = 0.5 * trace["X.set_acceleration"][start] ** 2 / MAX_JERK
    assert speed.max() <= speed[0] + risen + 1e-6
    braked = deceleration or MAX_DECELERATION
    stop = speed.max() * (0.5 * speed.max() / braked + braked / MAX_JERK + 0.1)  # a little more than it takes
    assert place[-1] - place[0] < stop + PERIOD
