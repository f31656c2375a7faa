"""Additive and continuous moves, jogging, the lock of a stop, feed enables."""

import math

import pytest

from motionlayer import AxisState
from motionlayer.command import ErrorId
from motionlayer.nc import AxisCommand, BufferMode, Direction, JogMode
from motionlayer.verify import assert_valid
from tests.machines import error_of, finish, ready, state_of


def passed(move: AxisCommand) -> bool:
    """Return `in_end_velocity`; a type checker does not know that it changes between two lines."""
    return move.in_end_velocity


def test_additive_counts_from_the_last_commanded_target_reached_or_not() -> None:
    run, x = ready()
    x.move_absolute(200.0)
    run.step(50)
    finish(run, x.move_additive(30.0))
    assert x.set_position == 230.0
    finish(run, x.move_additive(-30.0))
    assert x.set_position == 200.0
    assert_valid(run.trace)


def test_additive_after_a_halt_still_counts_from_the_target() -> None:
    run, x = ready()
    x.move_absolute(200.0)
    run.step(50)
    finish(run, x.halt())
    finish(run, x.move_additive(30.0))
    assert x.set_position == 230.0


def test_additive_in_endless_motion_and_without_a_target_counts_from_here() -> None:
    run, x = ready(start_position=12.0)
    finish(run, x.move_additive(30.0))
    assert x.set_position == 42.0
    x.move_velocity(100.0)
    run.step(200)
    here = x.set_position
    finish(run, x.move_additive(50.0))
    assert x.set_position == here + 50.0
    assert_valid(run.trace)


@pytest.mark.parametrize(("velocity", "end_velocity"), [(300.0, 100.0), (100.0, 300.0), (200.0, 200.0)])
def test_continuous_passes_the_position_with_the_end_velocity(velocity: float, end_velocity: float) -> None:
    run, x = ready(software_limit_max=None)
    move = x.move_continuous_absolute(150.0, end_velocity, velocity=velocity)
    assert state_of(x) is AxisState.CONTINUOUS_MOTION
    watch = x.passes(150.0)
    assert not passed(move)
    finish(run, watch)
    assert watch.end_time is not None
    assert x.set_velocity == end_velocity
    assert x.set_position == pytest.approx(150.0 + end_velocity * (run.time - watch.end_time), abs=1e-9)
    assert passed(move)
    run.step(50)
    assert move.active
    finish(run, x.halt())
    assert move.aborted
    assert_valid(run.trace)


def test_continuous_backwards_and_relative() -> None:
    run, x = ready(software_limit_min=None, software_limit_max=None)
    x.move_absolute(50.0)
    move = x.move_continuous_relative(-100.0, 80.0, buffer_mode=BufferMode.BLENDING_LOW)
    finish(run, x.passes(50.0))
    finish(run, x.passes(-50.0))
    assert x.set_velocity == -80.0
    assert passed(move)
    finish(run, x.halt())
    assert_valid(run.trace)


def test_continuous_with_a_way_too_short_gains_the_rest_behind() -> None:
    run, x = ready(software_limit_max=None)
    move = x.move_continuous_absolute(1.0, 400.0)
    finish(run, x.passes(1.0))
    assert 0.0 < x.set_velocity < 400.0
    assert not passed(move)
    run.step(500)
    assert x.set_velocity == 400.0
    assert passed(move)
    assert (run.trace["X.set_velocity"] >= 0.0).all()


def test_continuous_comes_to_rest_on_a_software_limit() -> None:
    run, x = ready()
    move = x.move_continuous_absolute(150.0, 100.0)
    run.step(6000)
    assert error_of(move) is ErrorId.MAXIMUM_PASSED
    assert x.set_position == 400.0
    assert_valid(run.trace)


def test_continuous_under_override() -> None:
    run, x = ready(software_limit_max=None)
    move = x.move_continuous_absolute(100.0, 200.0, velocity=300.0)
    run.step(100)
    x.set_override(0.5)
    finish(run, x.passes(100.0))
    assert x.set_velocity == 100.0
    assert passed(move)
    x.set_override(0.25)
    assert not passed(move)
    run.step(200)
    assert x.set_velocity == 50.0
    assert passed(move)
    x.set_override(0.0)
    run.step(200)
    assert x.set_velocity == 0.0
    x.set_override(1.0)
    run.step(300)
    assert x.set_velocity == 200.0
    assert_valid(run.trace)


@pytest.mark.parametrize("end_velocity", [0.0, -1.0, 500.1, math.nan, math.inf])
def test_a_wrong_end_velocity_is_refused(end_velocity: float) -> None:
    _, x = ready()
    assert error_of(x.move_continuous_absolute(100.0, end_velocity)) is ErrorId.VELOCITY


@pytest.mark.parametrize("direction", [Direction.SHORTEST_WAY, Direction.UNDEFINED])
def test_endless_motion_knows_no_such_direction(direction: Direction) -> None:
    _, x = ready()
    assert error_of(x.move_velocity(10.0, direction)) is ErrorId.COMMAND_NOT_PERMITTED
    assert error_of(x.jog(direction)) is ErrorId.COMMAND_NOT_PERMITTED


@pytest.mark.parametrize(
    ("mode", "velocity"), [(JogMode.STANDARD_SLOW, 25.0), (JogMode.STANDARD_FAST, 150.0), (JogMode.CONTINUOUS, 60.0)]
)
def test_jog_moves_while_it_is_held(mode: JogMode, velocity: float) -> None:
    run, x = ready()
    key = x.jog(Direction.POSITIVE, mode, velocity=60.0)
    run.step(300)
    assert x.set_velocity == velocity
    assert state_of(x) is AxisState.CONTINUOUS_MOTION
    key.release()
    finish(run, key)
    assert key.done
    assert state_of(x) is AxisState.STANDSTILL
    run.step(2)
    assert_valid(run.trace)


def test_a_jog_rests_on_a_software_limit_until_it_is_released() -> None:
    run, x = ready()
    key = x.jog(Direction.NEGATIVE, JogMode.STANDARD_FAST)
    run.step(2000)
    assert x.set_position == -100.0
    assert key.busy
    key.release()
    key.release()
    finish(run, key)
    assert key.done
    assert state_of(x) is AxisState.STANDSTILL
    run.step(2)
    assert_valid(run.trace)


def test_inching_makes_one_step_and_stops_by_itself() -> None:
    run, x = ready(manual={"forward": 3.0, "backward": 5.0}, start_position=0.5)
    finish(run, x.jog(Direction.POSITIVE, JogMode.INCHING))
    assert x.set_position == 3.5
    finish(run, x.jog(Direction.NEGATIVE, JogMode.INCHING))
    assert x.set_position == -1.5
    finish(run, x.jog(Direction.POSITIVE, JogMode.INCHING, step=0.25))
    assert x.set_position == -1.25
    assert_valid(run.trace)


@pytest.mark.parametrize(
    ("start", "direction", "end"),
    [
        (0.5, Direction.POSITIVE, 10.0),
        (10.0, Direction.POSITIVE, 20.0),
        (-0.5, Direction.POSITIVE, 0.0),
        (10.0, Direction.NEGATIVE, 0.0),
        (10.5, Direction.NEGATIVE, 10.0),
        (-0.5, Direction.NEGATIVE, -10.0),
    ],
)
def test_inching_modulo_snaps_to_multiples(start: float, direction: Direction, end: float) -> None:
    run, x = ready(start_position=start)
    finish(run, x.jog(direction, JogMode.INCHING_MODULO, step=10.0))
    assert x.set_position == end


@pytest.mark.parametrize("step", [0.0, -1.0, math.nan, math.inf])
def test_a_wrong_step_is_refused(step: float) -> None:
    _, x = ready()
    assert error_of(x.jog(Direction.POSITIVE, JogMode.INCHING, step=step)) is ErrorId.PARAMETER


def test_a_stop_that_is_held_locks_the_axis_at_rest() -> None:
    run, x = ready()
    x.move_absolute(300.0)
    run.step(100)
    stop = x.stop(hold=True)
    run.step(500)
    assert x.set_velocity == 0.0
    assert stop.at_target
    assert stop.busy
    assert state_of(x) is AxisState.STOPPING
    assert error_of(x.move_absolute(0.0)) is ErrorId.LOCKED_BY_STOP
    assert error_of(x.stop()) is ErrorId.STOP_ACTIVE
    stop.release()
    run.step()
    assert stop.done
    assert state_of(x) is AxisState.STANDSTILL
    finish(run, x.move_absolute(0.0))
    assert_valid(run.trace)


def test_a_stop_that_is_released_in_motion_ends_at_rest() -> None:
    run, x = ready()
    x.move_absolute(300.0)
    run.step(100)
    stop = x.stop(hold=True)
    run.step(5)
    stop.release()
    finish(run, stop)
    assert x.set_velocity == 0.0
    assert state_of(x) is AxisState.STANDSTILL


@pytest.mark.parametrize("way", ["reset", "disable", "emergency_stop"])
def test_what_else_ends_the_lock(way: str) -> None:
    run, x = ready()
    x.move_absolute(300.0)
    run.step(100)
    stop = x.stop(hold=True)
    run.step(500)
    finish(run, getattr(x, way)())
    run.step(3)
    assert not stop.busy
    assert state_of(x) is (AxisState.DISABLED if way == "disable" else AxisState.STANDSTILL)
    assert_valid(run.trace)


def test_a_missing_feed_enable_refuses_its_direction_alone() -> None:
    run, x = ready()
    finish(run, x.enable(positive=False))
    assert error_of(x.move_absolute(10.0)) is ErrorId.FEED_NOT_ENABLED
    assert error_of(x.move_velocity(10.0)) is ErrorId.FEED_NOT_ENABLED
    assert error_of(x.jog(Direction.POSITIVE)) is ErrorId.FEED_NOT_ENABLED
    finish(run, x.move_absolute(-10.0))
    finish(run, x.enable(negative=False))
    assert error_of(x.move_absolute(-20.0)) is ErrorId.FEED_NOT_ENABLED
    finish(run, x.move_absolute(0.0))
    assert_valid(run.trace)


def test_a_feed_enable_that_is_lost_brakes_the_motion_in_its_direction() -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    run.step(100)
    gate = x.enable(positive=False)
    assert move.by is gate
    assert state_of(x) is AxisState.STOPPING
    run.step(300)
    assert state_of(x) is AxisState.STANDSTILL
    assert 0.0 < x.set_position < 200.0
    assert_valid(run.trace)


def test_a_feed_enable_of_the_other_direction_leaves_the_motion() -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    back = x.move_absolute(0.0, buffer_mode=BufferMode.BUFFERED)
    run.step(100)
    gate = x.enable(negative=False)
    assert back.by is gate
    finish(run, move)
    assert move.done
    assert x.set_position == 300.0
    assert_valid(run.trace)


def test_disable_may_wait_until_the_axis_has_no_job() -> None:
    run, x = ready()
    move = x.move_absolute(100.0)
    after = x.move_absolute(150.0, buffer_mode=BufferMode.BUFFERED)
    off = x.disable(buffer_mode=BufferMode.BUFFERED)
    finish(run, off)
    assert move.done
    assert after.done
    assert state_of(x) is AxisState.DISABLED
    assert x.set_position == 150.0
    assert_valid(run.trace)
