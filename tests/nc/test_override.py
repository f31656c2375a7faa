"""The override scales the velocity of every motion; 0 holds the axis without ending its command."""

import numpy as np
import pytest

from motionlayer import AxisState
from motionlayer.verify import assert_valid
from tests.effort import thinned
from tests.machines import assert_smooth, finish, follow, ready

PHASES = [0, 1, 20, 60, 100, 300, 650, 680, 720, 745]


@pytest.mark.parametrize("tick", thinned(PHASES, 2))
@pytest.mark.parametrize("factor", [0.0, 0.01, 0.5, 1.0])
def test_in_every_phase_of_a_move_the_target_is_still_reached(tick: int, factor: float) -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    rows = [np.empty((0, 3))]
    run.step(tick)
    x.set_override(factor)
    assert x.override == factor
    pause = x.passes(1000.0)  # never: only to follow a while
    samples = []
    for _ in range(400):
        samples.append((x.set_position, x.set_velocity, x.set_acceleration))
        run.step()
    assert pause.busy
    rows.append(np.array(samples))
    if factor == 0.0:
        assert x.set_velocity == 0.0
        if tick < 745:
            assert move.busy
            assert x.state is AxisState.DISCRETE_MOTION
    x.set_override(1.0)
    rows.append(follow(run, x, move))
    assert x.set_position == 300.0
    assert move.done
    assert_smooth(np.vstack(rows))


@pytest.mark.parametrize("factor", [0.01, 0.3, 1.0])
def test_endless_motion_takes_the_scaled_velocity_and_returns(factor: float) -> None:
    run, x = ready(software_limit_max=None)
    move = x.move_velocity(400.0)
    run.step(300)
    assert x.set_velocity == 400.0
    x.set_override(factor)
    assert move.in_velocity == (factor == 1.0)
    run.step(400)
    assert x.set_velocity == pytest.approx(400.0 * factor, rel=1e-12)
    assert move.in_velocity
    x.set_override(1.0)
    run.step(400)
    assert x.set_velocity == 400.0
    assert move.busy


def test_override_zero_holds_an_endless_motion() -> None:
    run, x = ready()
    move = x.move_velocity(400.0)
    run.step(300)
    x.set_override(0.0)
    run.step(300)
    assert (x.set_velocity, x.set_acceleration) == (0.0, 0.0)
    assert x.state is AxisState.CONTINUOUS_MOTION
    assert move.busy
    assert move.active
    x.set_override(1.0)
    run.step(50)
    assert x.set_velocity > 0.0


def test_a_command_under_override_zero_waits() -> None:
    run, x = ready()
    x.set_override(0.0)
    move = x.move_absolute(50.0)
    run.step(100)
    assert move.busy
    assert move.active
    assert x.set_position == 0.0
    x.set_override(0.2)
    _, v, _ = follow(run, x, move).T
    assert v.max() <= 100.0 * (1.0 + 1e-12)
    assert x.set_position == 50.0


@pytest.mark.parametrize("name", ["halt", "stop", "disable"])
def test_braking_is_not_scaled(name: str) -> None:
    ticks = []
    for factor in (1.0, 0.25):
        run, x = ready(software_limit_max=None)
        x.set_override(factor)
        x.move_velocity(100.0 / factor)
        run.step(400)
        assert x.set_velocity == pytest.approx(100.0, rel=1e-12)
        ticks.append(finish(run, getattr(x, name)()))
    assert ticks[0] == ticks[1]


@pytest.mark.parametrize("name", ["halt", "stop", "disable"])
def test_a_held_axis_can_be_halted_stopped_disabled(name: str) -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    run.step(100)
    x.set_override(0.0)
    run.step(300)
    brake = getattr(x, name)()
    assert move.aborted
    finish(run, brake)
    assert brake.done
    x.set_override(1.0)
    run.step(100)
    assert x.set_velocity == 0.0
    assert x.state is (AxisState.DISABLED if name == "disable" else AxisState.STANDSTILL)


def test_the_same_value_changes_nothing() -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    run.step(100)
    before = x._store.table.tobytes()
    x.set_override(1.0)
    assert x._store.table.tobytes() == before
    assert move.busy


def test_the_override_of_the_last_call_of_a_tick_holds() -> None:
    run, x = ready(software_limit_max=None)
    x.move_velocity(200.0)
    for factor in (0.0, 0.7, 0.0, 0.5):
        x.set_override(factor)
    run.step(300)
    assert x.set_velocity == 100.0


def test_override_changing_in_every_tick_stays_within_limits() -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    samples = []
    for tick in range(600):
        x.set_override((tick * 37 % 101) / 100)
        samples.append((x.set_position, x.set_velocity, x.set_acceleration))
        run.step()
        if not move.busy:
            break
    x.set_override(1.0)
    tail = follow(run, x, move)
    assert_smooth(np.vstack([np.array(samples), tail]))
    assert x.set_position == 300.0


@pytest.mark.parametrize("factor", [5e-324, 1e-310, 1e-300, 1e-12])
def test_the_smallest_overrides_do_not_harm(factor: float) -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    run.step(50)
    x.set_override(factor)
    run.step(500)
    assert x.error is None
    assert move.busy
    assert abs(x.set_velocity) <= 500e-6
    x.set_override(1.0)
    finish(run, move)
    assert x.set_position == 300.0


@pytest.mark.parametrize("ticks", [0, 100])
def test_a_continuous_motion_held_for_long_has_not_passed_its_target(ticks: int) -> None:
    """It passes at a time of its profile; the hold is another profile, whose time goes on."""
    run, x = ready()
    x.set_override(1.0 if ticks else 0.0)
    run.step()
    x.move_continuous_absolute(200.0, 20.0, velocity=100.0)
    run.step(ticks)
    x.set_override(0.0)
    run.step(5000)
    held = x.set_position
    x.set_override(1.0)
    run.step(1000)
    assert x.set_velocity == 100.0
    assert 90.0 < x.set_position - held < 100.0
    run.step(2000)
    assert x.set_velocity == 20.0
    assert_valid(run.trace)


@pytest.mark.parametrize("tick", [100, 164, 165, 166, 167, 168, 200, 260])
def test_an_override_lowered_before_a_place_that_leaves_just_the_room_to_brake(
    tick: int,
) -> None:
    """The acceleration can be taken back only where the place is; a ride of less than a nanosecond remains.

    Found by the campaign `blocks`: verify took that ride for one outside the limit.
    """
    run, x = ready(
        software_limit_min=-50.0,
        max_acceleration=4000.0,
        max_deceleration=4000.0,
        start_position=50.0,
        max_jerk=20000.0,
    )
    move = x.move_continuous_relative(-50.0, 500.0)
    run.step(tick)
    x.set_override(0.5)
    run.step(3)
    x.set_override(1.0)
    finish(run, move)
    assert x.set_position == pytest.approx(-50.0)
    assert_valid(run.trace)
