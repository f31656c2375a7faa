"""Modulo positioning: the worked rows of function-blocks 2.9, and what is refused."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.command import ErrorId
from motionlayer.nc import BufferMode, Direction, ModuloConfig
from motionlayer.nc._modulo import target_from_rest, target_in_motion
from motionlayer.verify import assert_valid
from tests.machines import error_of, finish, ready

ROWS = [
    (Direction.POSITIVE, 90.0, 0.0, 0.0, 270.0, 360.0),
    (Direction.POSITIVE, 90.0, 360.0, 0.0, 630.0, 720.0),
    (Direction.POSITIVE, 90.0, 720.0, 0.0, 990.0, 1080.0),
    (Direction.NEGATIVE, 90.0, 0.0, 0.0, -90.0, 0.0),
    (Direction.NEGATIVE, 90.0, 360.0, 0.0, -450.0, -360.0),
    (Direction.NEGATIVE, 90.0, 720.0, 0.0, -810.0, -720.0),
    (Direction.SHORTEST_WAY, 90.0, 0.0, 0.0, -90.0, 0.0),
    (Direction.POSITIVE, 90.9, 90.0, 1.0, -0.9, 90.0),
    (Direction.POSITIVE, 91.1, 90.0, 1.0, 358.9, 450.0),
    (Direction.POSITIVE, 88.9, 90.0, 1.0, 1.1, 90.0),
    (Direction.POSITIVE, 90.9, 450.0, 1.0, 359.1, 450.0),
    (Direction.POSITIVE, 91.1, 450.0, 1.0, 718.9, 810.0),
    (Direction.POSITIVE, 89.1, 450.0, 1.0, 360.9, 450.0),
    (Direction.NEGATIVE, 89.1, 90.0, 1.0, 0.9, 90.0),
    (Direction.NEGATIVE, 88.9, 90.0, 1.0, -358.9, -270.0),
    (Direction.NEGATIVE, 91.1, 450.0, 1.0, -361.1, -270.0),
    (Direction.NEGATIVE, 88.9, 450.0, 1.0, -718.9, -630.0),
]
"""Direction, start, target, tolerance window, travel, end."""

ROTARY = {
    "unit": "degree",
    "max_velocity": 3600.0,
    "max_acceleration": 36_000.0,
    "max_deceleration": 36_000.0,
    "max_jerk": 2e6,
    "software_limit_min": None,
    "software_limit_max": None,
}


@pytest.mark.parametrize(("direction", "start", "target", "window", "travel", "end"), ROWS)
def test_worked_rows(
    direction: Direction, start: float, target: float, window: float, travel: float, end: float
) -> None:
    run, x = ready(**ROTARY, start_position=start, modulo={"tolerance": window})
    command = x.move_modulo(target, direction)
    finish(run, command)
    assert x.set_position == end
    assert x.set_position - start == pytest.approx(travel, abs=1e-9)
    assert_valid(run.trace)


@pytest.mark.parametrize(
    ("position", "direction", "error"),
    [
        (-0.1, Direction.POSITIVE, ErrorId.MODULO_TARGET),
        (-360.0, Direction.SHORTEST_WAY, ErrorId.MODULO_TARGET),
        (360.0, Direction.SHORTEST_WAY, ErrorId.MODULO_TARGET),
        (10.0, Direction.UNDEFINED, ErrorId.MODE_INVALID),
        (math.nan, Direction.POSITIVE, ErrorId.TARGET_NOT_FINITE),
        (math.inf, Direction.POSITIVE, ErrorId.TARGET_NOT_FINITE),
    ],
)
def test_refused(position: float, direction: Direction, error: ErrorId) -> None:
    run, x = ready(**ROTARY)
    assert error_of(x.move_modulo(position, direction)) is error
    run.step(3)
    assert x.set_position == 0.0


def test_in_motion_the_next_orientation_in_its_direction_is_taken_without_further_turns() -> None:
    run, x = ready(**ROTARY)
    x.move_velocity(720.0)
    run.step(300)
    here = x.set_position
    command = x.move_modulo(45.0 + 5 * 360.0, Direction.POSITIVE)
    finish(run, command)
    assert x.set_position % 360.0 == 45.0
    assert here < x.set_position < here + 360.0 + 100.0
    assert (run.trace["X.set_velocity"] >= 0.0).all()
    assert_valid(run.trace)


@pytest.mark.parametrize("direction", [Direction.NEGATIVE, Direction.SHORTEST_WAY])
def test_in_motion_a_reversal_is_refused(direction: Direction) -> None:
    run, x = ready(**ROTARY)
    x.move_velocity(720.0)
    run.step(300)
    behind = (x.set_position - 20.0) % 360.0
    assert error_of(x.move_modulo(behind, direction)) is ErrorId.REVERSAL_NOT_PERMITTED


@pytest.mark.parametrize("sign", [Direction.POSITIVE, Direction.NEGATIVE])
def test_current_direction_at_rest_is_that_of_the_last_motion(sign: Direction) -> None:
    run, x = ready(**ROTARY)
    finish(run, x.move_relative(10.0 if sign is Direction.POSITIVE else -10.0))
    finish(run, x.move_modulo(100.0, Direction.CURRENT))
    assert x.set_position == (100.0 if sign is Direction.POSITIVE else -260.0)
    assert_valid(run.trace)


def test_a_follower_honours_further_turns_from_its_start() -> None:
    run, x = ready(**ROTARY)
    x.move_absolute(90.0)
    run.step(20)
    command = x.move_modulo(360.0, Direction.POSITIVE, buffer_mode=BufferMode.BLENDING_LOW)
    finish(run, command)
    assert x.set_position == 720.0
    assert_valid(run.trace)


PERIOD = st.sampled_from([360.0, 1.0, 0.1, 2.0 * math.pi, 1000.0])
SIGNED = st.sampled_from([Direction.POSITIVE, Direction.NEGATIVE])


@given(
    period=PERIOD, start=st.floats(-1e5, 1e5), turns=st.integers(0, 5), share=st.floats(0.0, 0.999), direction=SIGNED
)
def test_without_a_window_the_travel_has_the_sign_of_the_direction(
    period: float, start: float, turns: int, share: float, direction: Direction
) -> None:
    position = turns * period + share * period
    end = target_from_rest(ModuloConfig(period), start, position, direction, 1.0)
    assert isinstance(end, float)
    sign = 1.0 if direction is Direction.POSITIVE else -1.0
    k = math.floor(position / period)
    blur = 1e-9 * (abs(start) + period)
    assert k * period - blur <= sign * (end - start) < (k + 1) * period + blur


@given(period=PERIOD, start=st.floats(-1e5, 1e5), share=st.floats(0.0, 0.999), window=st.floats(0.0, 0.4))
def test_the_nearest_way_is_at_most_half_a_period(period: float, start: float, share: float, window: float) -> None:
    config = ModuloConfig(period, window * period)
    end = target_from_rest(config, start, share * period, Direction.SHORTEST_WAY, 1.0)
    assert isinstance(end, float)
    blur = 1e-9 * (abs(start) + period)
    assert abs(end - start) <= 0.5 * period + blur
    inside = target_from_rest(config, start, share * period, Direction.POSITIVE, 1.0)
    assert isinstance(inside, float)
    assert -window * period - blur <= inside - start <= period + blur


@given(period=PERIOD, start=st.floats(-1e4, 1e4), brake=st.floats(0.0, 500.0), share=st.floats(0.0, 0.999), sign=SIGNED)
def test_in_motion_the_target_lies_behind_the_brake_and_within_a_period(
    period: float, start: float, brake: float, share: float, sign: Direction
) -> None:
    heading = 1.0 if sign is Direction.POSITIVE else -1.0
    stop = start + heading * brake
    end = target_in_motion(ModuloConfig(period), start, stop, share * period, sign, heading)
    assert isinstance(end, float)
    blur = 1e-9 * (abs(stop) + period)
    assert -blur <= heading * (end - stop) <= period + blur
