"""Answers known beforehand: rest to rest, stops, moves of no length, very long cruises."""

import math

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from motionlayer.profile import Limits, plan_position, plan_stop, plan_velocity, rest_at

from .cases import Problem, anything, calm, inside, integers, some
from .physics import assert_lawful, assert_rests_at, assert_runs_at, curve

LIMITS = Limits(100.0, 1000.0, 500.0, 10000.0)


def ramp_time(speed: float, acc: float, jerk: float) -> float:
    """Return the time from rest to a speed."""
    return speed / acc + acc / jerk if speed * jerk > acc * acc else 2.0 * math.sqrt(speed / jerk)


def rest_to_rest(distance: float, limits: Limits) -> float:
    """Return the time of a move from rest to rest: a ramp of mean speed w/2 up, one down, cruise between."""

    def ramps(speed: float) -> float:
        up = ramp_time(speed, limits.acceleration, limits.jerk)
        return up + ramp_time(speed, limits.deceleration, limits.jerk)

    cruise = distance - 0.5 * limits.velocity * ramps(limits.velocity)
    if cruise >= 0.0:
        return ramps(limits.velocity) + cruise / limits.velocity
    low, high = 0.0, limits.velocity
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if 0.5 * middle * ramps(middle) < distance else (low, middle)
    return ramps(high)


@some(250)
@given(st.one_of(inside(), inside(spread=2.0), integers()))
def test_rest_to_rest(problem: Problem) -> None:
    distance = problem.target - problem.p
    ours = plan_position(0.0, 0.0, 0.0, distance, problem.limits).duration
    assert ours == pytest.approx(rest_to_rest(abs(distance), problem.limits), rel=1e-12)


@pytest.mark.parametrize(
    ("distance", "limits", "seconds"),
    [
        (1.0, Limits(10.0, 10.0, 10.0, 32.0), 1.0),  # four pieces: 4 (d / 2J)^(1/3)
        (6.0, Limits(10.0, 1.0, 1.0, 1.0), 6.0),  # with hold: w (w/A + A/J) = d at w = 2
        (20.0, Limits(2.0, 1.0, 1.0, 1.0), 13.0),  # with cruise: d/V + V/A + A/J
        (2.0, Limits(1.0, 2.0, 2.0, 1.0), 4.0),  # velocity limit touched, acceleration limit not
    ],
)
def test_by_hand(distance: float, limits: Limits, seconds: float) -> None:
    assert plan_position(0.0, 0.0, 0.0, distance, limits).duration == pytest.approx(seconds, rel=1e-14)
    assert plan_position(5.0, 0.0, 0.0, 5.0 - distance, limits).duration == pytest.approx(seconds, rel=1e-14)


def test_acceleration_and_deceleration_change_places_with_the_direction_of_time() -> None:
    turned = LIMITS._replace(acceleration=LIMITS.deceleration, deceleration=LIMITS.acceleration)
    for distance in (0.001, 1.0, 10.0, 1000.0):
        there, back = (plan_position(0.0, 0.0, 0.0, distance, limits) for limits in (LIMITS, turned))
        assert there.duration == pytest.approx(back.duration, rel=1e-12)
        assert there.pieces[1, 3] == pytest.approx(-back.pieces[-2, 3], rel=1e-12)


def test_stop_from_cruise_by_hand() -> None:
    stop = plan_stop(7.0, 100.0, 0.0, LIMITS)
    assert stop.duration == pytest.approx(100.0 / 500.0 + 500.0 / 10000.0, rel=1e-14)
    assert stop.pieces[-1, 1] == pytest.approx(7.0 + 50.0 * stop.duration, rel=1e-14)


@some(150)
@given(anything)
def test_stop_does_not_depend_on_the_velocity_limit(problem: Problem) -> None:
    slower = problem._replace(limits=problem.limits._replace(velocity=problem.limits.velocity / 3.0))
    assert problem.stop().pieces.tolist() == slower.stop().pieces.tolist()


@some(150)
@given(anything)
def test_target_where_the_stop_ends_is_the_stop(problem: Problem) -> None:
    start = problem._replace(p=0.0)
    stop = start.stop()
    assert start._replace(target=float(stop.pieces[-1, 1])).position().pieces.tolist() == stop.pieces.tolist()


@some(100)
@given(anything)
@example(Problem(0.0, 0.000194, 0.0, 0.0, Limits(1.0, 1.0, 0.01, 10.0)))
@example(Problem(0.0, 3.0, 5.0, 0.0, Limits(6.0, 6.0, 2.0, 3.0)))
def test_rest_of_a_way_is_the_way_of_the_rest(problem: Problem) -> None:
    # (3): wherever a fastest way is left and planned anew, no time is won or lost.
    assume(calm(problem.v, problem.a, problem.limits))
    whole = problem.position()
    reach = abs(problem.p) + abs(problem.target) + whole.high - whole.low
    # A position rounded by e is made good in a time of (32 e / J)^(1/3).
    slack = 1e-9 * whole.duration + 10.0 * (1e-15 * reach / problem.limits.jerk) ** (1.0 / 3.0)
    for k in range(1, len(whole.pieces) - 1):
        left, p, v, a, _ = whole.pieces[k].tolist()
        rest = plan_position(p, v, a, problem.target, problem.limits)
        assert abs(left + rest.duration - whole.duration) <= slack, problem


@pytest.mark.parametrize("p", [0.0, -0.0, 12.5, -1e9, 1e-300])
def test_target_already_reached(p: float) -> None:
    profile = plan_position(p, 0.0, 0.0, p, LIMITS)
    assert profile.pieces.tolist() == [[0.0, p, 0.0, 0.0, 0.0]]
    assert (profile.low, profile.high, profile.duration) == (p, p, 0.0)
    assert rest_at(p).pieces.tolist() == profile.pieces.tolist()


def test_velocity_already_reached() -> None:
    assert plan_velocity(3.0, -40.0, 0.0, -40.0, LIMITS).pieces.tolist() == [[0.0, 3.0, -40.0, 0.0, 0.0]]


@pytest.mark.parametrize("target", [100.000001, -math.inf, math.nan])
def test_target_velocity_above_the_limit_is_refused(target: float) -> None:
    with pytest.raises(ValueError, match="above the limit"):
        plan_velocity(0.0, 0.0, 0.0, target, LIMITS)


@pytest.mark.parametrize("distance", [1e-15, 1e-12, 1e-9, 1e-6, 1e-3])
@pytest.mark.parametrize("p", [0.0, 1000.0])
def test_tiny_moves(p: float, distance: float) -> None:
    target = p + distance
    profile = plan_position(p, 0.0, 0.0, target, LIMITS)
    assert_lawful(profile, (p, 0.0, 0.0), LIMITS)
    assert_rests_at(profile, target)
    assert profile.duration == pytest.approx(rest_to_rest(target - p, LIMITS), rel=1e-12)


@pytest.mark.parametrize("distance", [1e3, 1e6, 2.0**53 * 1e-9, 1e9, 1e12, 1e15, 1e100, 1e290])
@pytest.mark.parametrize("jerk", [1e3, 1e9])
def test_very_long_cruise_is_exact_whatever_the_clock(distance: float, jerk: float) -> None:
    limits = Limits(1.0, 10.0, 20.0, jerk)
    profile = plan_position(-3.0, -0.5, 1.0, distance, limits)
    assert_lawful(profile, (-3.0, -0.5, 1.0), limits)
    assert_rests_at(profile, distance)
    assert profile.duration == pytest.approx(distance, rel=1e-2)
    rows = profile.pieces.astype(np.longdouble)
    steps, v, a, j = np.diff(rows[:, 0]), *rows[:-1, 2:].T
    assert (np.abs(v + steps * (a + steps * j / 2) - rows[1:, 2]) <= 1e-14 * limits.velocity).all()
    assert (np.abs(a + steps * j - rows[1:, 3]) <= 1e-9 * limits.acceleration).all()
    assert (np.diff(rows[-4:, 2]) <= 0).all(), "the stop does not fall"


@pytest.mark.parametrize("v", [4.2518656012387463e-277, -5e-324, 1e-160, -1e-30])
def test_velocity_that_rounding_swallows_is_kept_at_the_start(v: float) -> None:
    limits = Limits(1.0, 1.0, 1.0, 1.0)
    profile = plan_position(0.0, v, -0.5, -1.0, limits)
    assert_lawful(profile, (0.0, v, -0.5), limits)
    assert_rests_at(profile, -1.0)


def test_reversal_passes_zero_with_the_smaller_limit() -> None:
    for limits in (LIMITS, LIMITS._replace(acceleration=500.0, deceleration=1000.0)):
        profile = plan_velocity(0.0, -100.0, 0.0, 100.0, limits)
        assert_lawful(profile, (0.0, -100.0, 0.0), limits)
        assert_runs_at(profile, 100.0)
        _, _, v, a = curve(profile.pieces)
        assert float(a[abs(v).argmin()]) == pytest.approx(500.0, rel=1e-12)
        assert float(a.max()) == pytest.approx(1000.0, rel=1e-12)


def test_a_first_piece_that_only_rounding_made_is_left_out() -> None:
    limits = Limits(22.291621343717154, 17.054604508398878, 148.51868074868673, 2958.380730005665)
    profile = plan_position(1.6938004319649875, -0.31991277055431194, 61.63892333329399, 4.032573168580419, limits)
    assert profile.pieces[1, 0] > 1e-6
    assert profile.pieces[0, 1:4].tolist() == [1.6938004319649875, -0.31991277055431194, 61.63892333329399]
