"""Software limits: no command leads beyond them, an endless motion comes to rest on them."""

import math

import numpy as np
import pytest

from motionlayer import AxisState
from motionlayer.command import ErrorId
from motionlayer.nc import BufferMode, Direction
from motionlayer.verify import assert_valid
from tests.machines import assert_smooth, error_of, finish, follow, ready, state_of

LOW, HIGH = -100.0, 400.0


@pytest.mark.parametrize("position", [math.nextafter(HIGH, 1e9), math.nextafter(LOW, -1e9), 1e6, -1e50])
def test_a_target_outside_is_refused(position: float) -> None:
    _, x = ready()
    assert error_of(x.move_absolute(position)) is ErrorId.TARGET_OUTSIDE_LIMITS
    assert error_of(x.move_relative(position)) is ErrorId.TARGET_OUTSIDE_LIMITS
    assert state_of(x) is AxisState.STANDSTILL


@pytest.mark.parametrize("position", [LOW, HIGH])
def test_the_limits_themselves_are_inside(position: float) -> None:
    run, x = ready()
    follow(run, x, x.move_absolute(position))
    assert x.set_position == position


@pytest.mark.parametrize("up", [True, False])
@pytest.mark.parametrize("velocity", [0.5, 30.0, 500.0])
def test_endless_motion_comes_to_rest_on_the_limit_and_goes_into_error(up: bool, velocity: float) -> None:
    limit = HIGH if up else LOW
    run, x = ready(start_position=limit - 0.2 if velocity == 0.5 and up else limit + 0.2 if velocity == 0.5 else 0.0)
    move = x.move_velocity(velocity, Direction.POSITIVE if up else Direction.NEGATIVE)
    rows = follow(run, x, move)
    assert error_of(move) is (ErrorId.MAXIMUM_PASSED if up else ErrorId.MINIMUM_PASSED)
    assert (x.set_position, x.set_velocity, x.set_acceleration) == (limit, 0.0, 0.0)
    assert rows[:, 0].min() >= LOW
    assert rows[:, 0].max() <= HIGH
    assert state_of(x) is AxisState.ERRORSTOP
    assert x.error is move.error
    run.step(50)
    assert x.set_position == limit
    assert error_of(x.move_absolute(0.0)) is ErrorId.CANNOT_START
    finish(run, x.reset())
    outward = x.move_velocity(10.0, Direction.POSITIVE if up else Direction.NEGATIVE)
    assert error_of(outward) is (ErrorId.ABOVE_MAXIMUM if up else ErrorId.BELOW_MINIMUM)
    assert state_of(x) is AxisState.STANDSTILL
    finish(run, x.move_absolute(0.0))
    assert x.set_position == 0.0


@pytest.mark.parametrize("factor", [0.0, 0.2, 1.0])
def test_the_limit_holds_under_a_changing_override(factor: float) -> None:
    run, x = ready()
    move = x.move_velocity(500.0)
    samples = []
    for tick in range(3000):
        if tick % 40 == 0:
            x.set_override(factor if tick % 80 else 1.0)
        samples.append((x.set_position, x.set_velocity, x.set_acceleration))
        run.step()
    rows = np.array(samples)
    assert_smooth(rows)
    assert rows[:, 0].max() <= HIGH
    assert error_of(move) is ErrorId.MAXIMUM_PASSED
    assert x.set_position == HIGH


@pytest.mark.parametrize("kind", ["absolute", "velocity"])
def test_a_command_that_would_overrun_is_refused_and_the_running_one_goes_on(kind: str) -> None:
    run, x = ready()
    first = x.move_absolute(390.0)
    while x.set_position < 330.0:
        run.step()
    if kind == "absolute":
        second = x.move_absolute(100.0, deceleration=100.0)
    else:
        second = x.move_velocity(100.0, Direction.NEGATIVE, deceleration=100.0)
    assert error_of(second) is ErrorId.OVERRUN
    assert x.command is first
    finish(run, first)
    assert x.set_position == 390.0


def test_a_target_behind_is_reached_if_the_way_there_stays_inside() -> None:
    run, x = ready()
    x.move_absolute(390.0)
    while x.set_position < 300.0:
        run.step()
    move = x.move_absolute(250.0)
    rows = follow(run, x, move)
    assert x.set_position == 250.0
    assert 300.0 < rows[:, 0].max() <= HIGH


@pytest.mark.parametrize(("start", "inward"), [(450.0, Direction.NEGATIVE), (-150.0, Direction.POSITIVE)])
def test_from_outside_the_way_leads_in_only(start: float, inward: Direction) -> None:
    outward = Direction.POSITIVE if inward is Direction.NEGATIVE else Direction.NEGATIVE
    run, x = ready(start_position=start)
    assert error_of(x.move_absolute(start)) is ErrorId.TARGET_OUTSIDE_LIMITS
    assert error_of(x.move_relative(math.copysign(1.0, -start))) is ErrorId.TARGET_OUTSIDE_LIMITS
    refused = x.move_velocity(10.0, outward)
    assert error_of(refused) is (ErrorId.ABOVE_MAXIMUM if start > 0 else ErrorId.BELOW_MINIMUM)
    x.move_velocity(100.0, inward)
    run.step(300)
    assert abs(x.set_velocity) == 100.0
    rows = follow(run, x, x.move_absolute(0.0))
    assert x.set_position == 0.0
    assert rows[:, 0].min() >= LOW - 50.0


@pytest.mark.parametrize("side", ["software_limit_min", "software_limit_max"])
def test_one_limit_alone(side: str) -> None:
    run, x = ready(**{side: None})
    free = Direction.NEGATIVE if side == "software_limit_min" else Direction.POSITIVE
    bound = Direction.POSITIVE if side == "software_limit_min" else Direction.NEGATIVE
    x.move_velocity(500.0, free)
    run.step(3000)
    assert abs(x.set_velocity) == 500.0
    move = x.move_velocity(500.0, bound)
    finish(run, move)
    assert x.set_position == (HIGH if side == "software_limit_min" else LOW)


@pytest.mark.parametrize(("low", "position"), [(0.3, 398.0), (0.7, 390.0), (0.0, 399.9), (0.5, HIGH)])
def test_an_end_velocity_is_lowered_to_what_the_limit_behind_allows(low: float, position: float) -> None:
    """Also when the override was low at first: what it allows then could not be braked after it has risen."""
    run, x = ready()
    x.set_override(low)
    move = x.move_continuous_absolute(position, 500.0)
    run.step(700)
    x.set_override(1.0)
    rows = follow(run, x, move)
    assert error_of(move) is ErrorId.MAXIMUM_PASSED
    assert rows[:, 0].max() <= HIGH
    assert x.set_position == HIGH
    assert_valid(run.trace)


@pytest.mark.parametrize("factor", [0.2, 0.5, 1.0])
def test_a_joint_before_an_end_velocity_leaves_room_to_brake_behind_the_target(factor: float) -> None:
    """Also where the override rises: from the end velocity as commanded, the axis would come to rest at 432."""
    run, x = ready()
    x.set_override(factor)
    run.step()
    first = x.move_absolute(300.0)
    after = x.move_continuous_absolute(330.0, 450.0, deceleration=1000.0, buffer_mode=BufferMode.BLENDING_HIGH)
    run.step(100)
    x.set_override(1.0)
    finish(run, first)
    assert x.set_velocity > 400.0
    finish(run, after)
    assert error_of(after) is ErrorId.MAXIMUM_PASSED
    assert (x.set_position, x.set_velocity, x.set_acceleration) == (HIGH, 0.0, 0.0)
    assert run.trace["X.set_position"].max() <= HIGH
    assert_valid(run.trace)
