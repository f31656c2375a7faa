"""Homing: direct, and to the reference switch from both of its sides."""

import pytest

from motionlayer import AxisState
from motionlayer.command import ErrorId
from motionlayer.nc import Axis
from motionlayer.store import Q
from motionlayer.verify import assert_valid
from tests.effort import thinned
from tests.machines import error_of, finish, play, ready, state_of


def test_direct_homing_defines_the_present_position() -> None:
    run, x = ready(start_position=12.0, home={"mode": "direct", "position": -3.0})

    async def program() -> None:
        tick = run.tick
        command = x.home()
        assert command.done
        assert x.homed
        await command
        assert run.tick == tick
        assert state_of(x) is AxisState.STANDSTILL
        assert x.set_position == x.actual_position == -3.0
        assert x.home(99.0).done
        assert x.set_position == x.actual_position == 99.0
        await x.move_absolute(100.0)
        assert x.actual_position == 100.0

    play(run, program)
    assert drive_position(x) == 13.0


def drive_position(x: Axis) -> float:
    """Return where the drive is told to be in its own coordinate, which homing does not touch."""
    return float(x._store.table[Q.SET_P, 0] - x._store.table[Q.SHIFT, 0])


@pytest.mark.parametrize("direction", ["negative", "positive"])
@pytest.mark.parametrize("start", thinned([-90.0, -50.5, -50.0, -49.5, 0.0], 2))
@pytest.mark.parametrize("velocity", [pytest.param(0.005, marks=pytest.mark.slow), 1.0, 40.0, 500.0])
def test_the_edge_of_the_switch_becomes_the_reference(direction: str, start: float, velocity: float) -> None:
    """Whatever the side of the start and the direction: the drive position -50 is called 7 in the end."""
    if velocity < 1.0 and abs(start + 50.0) > 0.1:
        start = -50.0 + 0.05 * (1 if start > -50.0 else -1)
    home = {"mode": "switch", "switch": -50.0, "velocity": velocity, "position": 7.0, "direction": direction}
    run, x = ready(start_position=start, home=home)
    command = x.home()
    assert state_of(x) is AxisState.HOMING
    finish(run, command, 200_000)
    assert command.done
    assert x.homed
    assert state_of(x) is AxisState.STANDSTILL
    assert (x.set_velocity, x.set_acceleration) == (0.0, 0.0)
    assert x.set_position - 7.0 == pytest.approx(drive_position(x) + 50.0, abs=1e-9)
    assert command.end_time is not None
    run.step()
    assert x.set_position == x.actual_position
    finish(run, x.move_absolute(7.0))
    assert drive_position(x) == pytest.approx(-50.0, abs=1e-9)


@pytest.mark.parametrize("start", [0.1, 1000.0, 1e6 / 3.0])
def test_direct_homing_keeps_the_lag_at_exactly_zero(start: float) -> None:
    run, x = ready(start_position=start)
    x.home(-84.3)
    run.step(3)
    trace = run.trace
    assert trace["X.set_position"].tolist() == trace["X.actual_position"].tolist()


def test_an_own_reference_position() -> None:
    run, x = ready(home={"mode": "switch", "switch": -50.0, "velocity": 40.0, "position": 7.0})
    finish(run, x.home(300.0))
    finish(run, x.move_absolute(300.0))
    assert drive_position(x) == pytest.approx(-50.0, abs=1e-9)


def test_homing_twice_gives_the_same_coordinate() -> None:
    run, x = ready(home={"mode": "switch", "switch": -50.0, "velocity": 40.0, "position": 7.0})
    for _ in range(2):
        finish(run, x.home())
        finish(run, x.move_absolute(7.0))
        assert drive_position(x) == pytest.approx(-50.0, abs=1e-9)


def test_homing_ignores_the_software_limits_of_a_coordinate_that_is_not_known_yet() -> None:
    run, x = ready(
        software_limit_min=-10.0, home={"mode": "switch", "switch": -50.0, "velocity": 40.0, "position": -5.0}
    )
    command = x.home()
    finish(run, command)
    assert command.done
    assert x.set_position == pytest.approx(-5.0, abs=1.0)


def test_a_stop_ends_the_homing() -> None:
    run, x = ready(home={"mode": "switch", "switch": -50.0, "velocity": 40.0})
    home = x.home()
    run.step(200)
    stop = x.stop()
    assert home.aborted
    assert home.by is stop
    finish(run, stop)
    assert not x.homed
    assert state_of(x) is AxisState.STANDSTILL
    run.step(3000)
    assert x.set_position > -50.0


@pytest.mark.parametrize("tick", [1, 30, 600])
def test_override_holds_and_scales_the_search(tick: int) -> None:
    run, x = ready(home={"mode": "switch", "switch": -50.0, "velocity": 40.0, "position": 7.0})
    home = x.home()
    run.step(tick)
    x.set_override(0.0)
    run.step(500)
    assert x.set_velocity == 0.0
    assert state_of(x) is AxisState.HOMING
    assert home.busy
    x.set_override(0.5)
    run.step(200)
    assert x.set_velocity == -20.0
    finish(run, home)
    finish(run, x.move_absolute(7.0))
    assert drive_position(x) == pytest.approx(-50.0, abs=1e-9)


def test_homing_in_the_tick_after_a_motion_of_one_cycle() -> None:
    """The halt of a resting axis is a plan of one cycle; the new coordinate begins in the same tick for the trace."""
    run, x = ready(start_position=5.0)
    finish(run, x.halt())
    assert x.home().done
    run.step(3)
    trace = run.trace
    assert trace["X.set_position"][-1] == 0.0
    assert_valid(trace)


def test_a_reference_that_is_no_number_is_refused() -> None:
    _, x = ready()
    for position in (float("nan"), float("inf"), -float("inf")):
        assert error_of(x.home(position)) is ErrorId.TARGET_NOT_FINITE
    assert not x.homed
