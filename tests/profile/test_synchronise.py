"""Synchronising: the last piece is the target's motion, limits are of the absolute motion."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from motionlayer.profile import (
    TOLERANCES,
    Limits,
    Moving,
    PlanError,
    Profile,
    plan_position,
    plan_synchronise,
    plan_velocity,
)

from .cases import Problem, inside, integers, outside, signed, some
from .physics import assert_lawful

LIMITS = Limits(100.0, 1000.0, 500.0, 10000.0)
START = (0.0, 0.0, 0.0)


def moving(problem: Problem, share: float) -> Moving:
    """Return a target that starts at the problem's and moves at a share of its velocity limit, mostly below it."""
    return Moving(problem.target, 0.95 * share * problem.limits.velocity)


def assert_joins(profile: Profile, target: Moving) -> None:
    """Assert that the profile ends in the target's motion, bit for bit."""
    t, p, v, a, j = profile.pieces[-1].tolist()
    assert (p, v, a, j) == (target.position + target.velocity * t, target.velocity, 0.0, 0.0)


@some(300)
@given(st.one_of(integers(), inside(), outside()), signed)
def test_any_target_below_the_limit_is_joined_lawfully(problem: Problem, share: float) -> None:
    target = moving(problem, share)
    profile = plan_synchronise(*problem[:3], target, problem.limits)
    assert_lawful(profile, problem[:3], problem.limits)
    assert_joins(profile, target)


@some(200)
@given(st.one_of(integers(), inside()))
def test_a_target_that_stands_is_a_move_to_a_position(problem: Problem) -> None:
    there = plan_synchronise(*problem[:3], Moving(problem.target, 0.0), problem.limits)
    assert there.pieces.tolist() == problem.position().pieces.tolist()


@some(200)
@given(st.one_of(integers(), inside()), signed)
def test_mirrored_target_is_met_in_the_mirrored_way(problem: Problem, share: float) -> None:
    target = moving(problem, share)
    there = plan_synchronise(*problem[:3], target, problem.limits)
    p, v, a = problem[:3]
    back = plan_synchronise(-p, -v, -a, Moving(-target.position, -target.velocity), problem.limits)
    assert (there.pieces * np.array([1.0, -1.0, -1.0, -1.0, -1.0])).tolist() == back.pieces.tolist()


@some(100)
@given(inside(symmetric=True), signed)
def test_from_another_moving_frame_where_no_limit_of_velocity_counts(problem: Problem, share: float) -> None:
    # With equal limits and the velocity limit out of reach the meeting is a move to rest in the target's frame.
    limits = problem.limits._replace(velocity=1e6 * problem.limits.velocity)
    p, v, a = problem[:3]
    u = share * problem.limits.velocity
    still = plan_position(p, v - u, a, problem.target, limits)
    assume(np.abs(still.pieces[:, 2]).max() < 1e5 * problem.limits.velocity)
    met = plan_synchronise(p, v, a, Moving(problem.target, u), limits)
    assert met.duration == pytest.approx(still.duration, rel=1e-9, abs=1e-7 * abs(v) / limits.acceleration)


def test_a_target_that_comes_by_is_joined_there_and_then() -> None:
    limits = Limits(2.0, 2.0, 4.0, 6.0)
    direct = plan_velocity(0.0, 2.0, -6.0, -1.0, limits).pieces[-1]
    target = Moving(float(direct[1] + direct[0]), -1.0)
    profile = plan_synchronise(0.0, 2.0, -6.0, target, limits)
    assert_joins(profile, target)
    assert profile.duration == direct[0]


def test_by_hand() -> None:
    # From rest into a target at 50 from behind: it comes by at the end of the ramp, of which the mean velocity is 25.
    ramp = 50.0 / 1000.0 + 1000.0 / 40000.0
    profile = plan_synchronise(*START, Moving(-25.0 * ramp, 50.0), LIMITS._replace(jerk=40000.0))
    assert profile.duration == pytest.approx(ramp, rel=1e-9)
    assert profile.pieces[-1, 1] == pytest.approx(25.0 * ramp, rel=1e-9)


def test_ways_of_being_too_fast_are_named() -> None:
    with pytest.raises(ValueError, match="above the limit"):
        plan_synchronise(*START, Moving(10.0, 100.1), LIMITS)
    with pytest.raises(PlanError, match="stays out of reach"):
        plan_synchronise(*START, Moving(10.0, 100.0), LIMITS)


def test_a_target_as_fast_as_the_limit_is_met_where_it_comes_from_behind() -> None:
    target = Moving(-50.0, 100.0)
    profile = plan_synchronise(*START, target, LIMITS)
    assert_lawful(profile, START, LIMITS)
    assert_joins(profile, target)


def test_already_there() -> None:
    profile = plan_synchronise(3.0, 40.0, 0.0, Moving(3.0, 40.0), LIMITS)
    assert profile.pieces.tolist() == [[0.0, 3.0, 40.0, 0.0, 0.0]]


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("field", range(5))
def test_a_number_that_is_none_is_refused(field: int, value: float) -> None:
    numbers = [0.5, 0.25, -0.5, 3.0, 0.5]
    numbers[field] = value
    p, v, a, position, velocity = numbers
    with np.errstate(all="ignore"), pytest.raises((PlanError, ValueError)):
        plan_synchronise(p, v, a, Moving(position, velocity), LIMITS)


@some(200)
@given(st.floats(), st.floats(), st.floats(), st.floats(), st.floats(-100.0, 100.0))
def test_any_floats_are_exact_or_refused(p: float, v: float, a: float, position: float, u: float) -> None:
    target = Moving(position, u)
    try:
        with np.errstate(all="ignore"):
            profile = plan_synchronise(p, v, a, target, LIMITS)
    except ArithmeticError:
        return
    assert_joins(profile, target)
    assert abs(profile.pieces[0, 1] - p) <= TOLERANCES.position * (abs(p) + 1.0)


def test_message_can_be_pasted() -> None:
    with pytest.raises(PlanError) as caught:
        plan_synchronise(*START, Moving(1.0 / 3.0, 100.0), LIMITS)
    call = str(caught.value).split(": ", 1)[1]
    names = {"plan_synchronise": plan_synchronise, "Moving": Moving, "Limits": Limits}
    with pytest.raises(PlanError, match="out of reach"):
        eval(call, names)  # noqa: S307 - that is the promise
