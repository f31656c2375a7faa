"""Passing a position: there with the velocity asked for and a = 0; which velocities spare the way back."""

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from motionlayer import profile as planner
from motionlayer.profile import (
    TOLERANCES,
    Limits,
    PlanError,
    Profile,
    passable_velocity,
    plan_passing,
    plan_position,
)

from .cases import Problem, anything, calm, inside, integers, signed, some
from .oracle import passing_times
from .physics import assert_continuous, assert_lawful, curve

LIMITS = Limits(100.0, 1000.0, 500.0, 10000.0)
START = (0.0, 0.0, 0.0)
CLOSE = 1e-11

# Who goes backwards and is about to turn gains the way that is missing by turning a little later. Backing off as far
# as for any other target took 2.6 and 1.6 times as long.
ABOUT_TO_TURN = Problem(
    0.0, -20.038212432907816, 8.849191845033202, 34.55060940436446,
    Limits(59.036356456526676, 10.88482633353612, 10.88482633353612, 1.4918608393122872),
)  # fmt: skip
TURNING = Problem(
    0.0, -1.2292679102419592, 2.259649382729611, 2.4761912683558025,
    Limits(3.700778704057445, 3.3817481043199575, 3.3817481043199575, 2.1935291278796676),
)  # fmt: skip


def passing(problem: Problem, share: float) -> Profile:
    return plan_passing(*problem[:4], share * problem.limits.velocity, problem.limits)


def assert_passes(profile: Profile, target: float, velocity: float) -> None:
    assert profile.pieces[-1, 1:].tolist() == [target, velocity, 0.0, 0.0]


def margin(problem: Problem, velocity: float) -> float:
    """Return how far the target lies from where the fastest way to the velocity ends."""
    return abs(problem.target - float(problem.velocity(velocity).pieces[-1, 1]))


@some(300)
@given(anything, signed)
@example(Problem(0.0, 0.0, 0.0, 1.0, LIMITS), 1.0)
@example(Problem(0.0, 0.0, 0.0, 0.0, LIMITS), -1.0)
def test_any_position_is_passed_lawfully(problem: Problem, share: float) -> None:
    profile = passing(problem, share)
    assert_lawful(profile, problem[:3], problem.limits)
    assert_passes(profile, problem.target, share * problem.limits.velocity)
    p = curve(profile.pieces[:, :])[1]
    blur = 1e-9 * (abs(problem.p) + abs(problem.target) + profile.high - profile.low)
    assert profile.low - blur <= p.min()
    assert p.max() <= profile.high + blur


@some(200)
@given(anything)
def test_passing_at_rest_is_a_move_to_a_position(problem: Problem) -> None:
    assert passing(problem, 0.0).pieces.tolist() == problem.position().pieces.tolist()


@some(200)
@given(anything, signed)
def test_mirrored_problem_has_the_mirrored_answer_bit_for_bit(problem: Problem, share: float) -> None:
    p, v, a, target, limits = problem
    mirrored = Problem(-p, -v, -a, -target, limits)
    there, back = passing(problem, share), passing(mirrored, -share)
    assert (there.pieces * np.array([1.0, -1.0, -1.0, -1.0, -1.0])).tolist() == back.pieces.tolist()
    assert (there.low, there.high) == (-back.high, -back.low)
    u = share * limits.velocity
    assert passable_velocity(p, v, a, target, u, limits) == -passable_velocity(-p, -v, -a, -target, -u, limits)


@some(150)
@given(anything, signed, st.integers(-20, 20))
def test_power_of_two_as_unit_of_length_changes_no_bit_of_the_times(
    problem: Problem, share: float, exponent: int
) -> None:
    factor = 2.0**exponent
    there, back = passing(problem, share), passing(problem.scaled(factor), share)
    assert (there.pieces * [1.0, *[factor] * 4]).tolist() == back.pieces.tolist()


@some(150)
@given(st.one_of(inside(), integers()), signed, st.sampled_from([1e-6, 1e-3, 1e3, 1e6, 360.0, 1.0 / 360.0, 0.0254]))
def test_same_passing_takes_the_same_time_in_any_unit(problem: Problem, share: float, factor: float) -> None:
    move = problem._replace(p=0.0, v=0.0, a=0.0)
    length = move.limits.velocity * move.limits.velocity / move.limits.acceleration
    assume(margin(move, share * move.limits.velocity) > 1e-6 * length)  # the border is rounded like everything
    there, back = passing(move, share), passing(move.scaled(factor), share)
    assert back.duration == pytest.approx(there.duration, rel=TOLERANCES.time)


@some(400)
@given(st.one_of(integers(symmetric=True), inside(symmetric=True), inside(symmetric=True, spread=2.0)), signed)
@example(ABOUT_TO_TURN, 0.30905201735)
@example(TURNING, 0.72883085)
def test_as_quick_as_ruckig_with_equal_limits(problem: Problem, share: float) -> None:
    p, v, a, target, limits = problem
    u = share * limits.velocity
    length = limits.velocity * limits.velocity / limits.acceleration
    assume(calm(v, a, limits) and margin(problem, u) > 1e-6 * length)
    ours = passing(problem, share).duration
    slack = CLOSE * max(ours, limits.velocity / limits.acceleration)
    theirs = list(passing_times(v, a, target - p, u, limits))
    assert ours <= min(theirs) + 1e3 * slack
    assert ours >= min(theirs) - slack


def test_by_hand() -> None:
    # From rest to 50 with 500 u/s² and 10 000 u/s³: 0.05 s of ramps, 0.05 s held, mean velocity 25.
    limits = Limits(100.0, 500.0, 500.0, 10000.0)
    profile = plan_passing(*START, 25.0 * 0.15, 50.0, limits)
    assert profile.duration == pytest.approx(0.15, rel=1e-14)
    assert len(profile.pieces) == 4
    assert passable_velocity(*START, 25.0 * 0.15, 100.0, limits) == pytest.approx(50.0, rel=1e-14)
    # A short way: full jerk up and down covers v √(v/J).
    assert passable_velocity(*START, 1.0, 100.0, limits) == pytest.approx(10000.0 ** (1.0 / 3.0), rel=1e-12)


@pytest.mark.parametrize("velocity", [30.0, 100.0])
@pytest.mark.parametrize("distance", [1e9, 1e14, 1e20, 1e292])
def test_long_cruises_end_on_the_target(distance: float, velocity: float) -> None:
    for s in (-1.0, 1.0):
        profile = plan_passing(*START, s * distance, s * velocity, LIMITS)
        assert_continuous(profile)
        assert_passes(profile, s * distance, s * velocity)


def test_a_turn_finer_than_the_clock_is_refused() -> None:
    profile = plan_passing(*START, 1e9, -5.0, LIMITS)
    assert_continuous(profile)
    assert_passes(profile, 1e9, -5.0)
    with pytest.raises(PlanError, match=r"jumps|order of time"):
        plan_passing(*START, 1e20, -5.0, LIMITS)


@pytest.mark.parametrize("velocity", [100.1, -101.0, math.nan, math.inf])
def test_a_velocity_above_the_limit_is_refused(velocity: float) -> None:
    for question in (plan_passing, passable_velocity):
        with pytest.raises(ValueError, match="above the limit 100"):
            question(*START, 10.0, velocity, LIMITS)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("field", range(4))
def test_a_number_that_is_none_is_refused(field: int, value: float) -> None:
    numbers = [0.5, 0.25, -0.5, 3.0]
    numbers[field] = value
    p, v, a, target = numbers
    for question in (plan_passing, passable_velocity):
        with np.errstate(all="ignore"), pytest.raises(PlanError):
            question(p, v, a, target, 0.5, LIMITS)


@pytest.mark.parametrize("value", [math.inf, 0.0, -0.0, -1.0])
@pytest.mark.parametrize("name", Limits._fields)
def test_a_limit_that_is_none_is_refused(name: str, value: float) -> None:
    for question in (plan_passing, passable_velocity):
        with pytest.raises((PlanError, ValueError), match=r"a limit|above the limit"):
            question(*START, 1.0, 0.5, LIMITS._replace(**{name: value}))


@some(250)
@given(st.floats(), st.floats(), st.floats(), st.floats(), st.floats(-100.0, 100.0))
def test_any_floats_are_exact_or_refused(p: float, v: float, a: float, target: float, u: float) -> None:
    try:
        with np.errstate(all="ignore"):
            profile = plan_passing(p, v, a, target, u, LIMITS)
    except ArithmeticError:
        return
    assert_continuous(profile)
    assert_passes(profile, target, u)
    with np.errstate(all="ignore"):
        assert abs(passable_velocity(p, v, a, target, u, LIMITS)) <= LIMITS.velocity


@pytest.mark.parametrize("name", ["plan_passing", "passable_velocity"])
def test_message_can_be_pasted(name: str) -> None:
    ask = partial(getattr(planner, name), 0.0, 1.0, 0.1, 1.0 / 3.0, 0.5)
    with pytest.raises(PlanError) as caught:
        ask(LIMITS._replace(jerk=math.inf))
    call = str(caught.value).split(": ", 1)[1]
    with pytest.raises(PlanError, match="a limit"):
        eval(call, {**vars(planner), "inf": math.inf})  # noqa: S307 - that is the promise


def test_a_target_reached_already_is_the_motion_itself() -> None:
    profile = plan_passing(3.0, 40.0, 0.0, 3.0, 40.0, LIMITS)
    assert profile.pieces.tolist() == [[0.0, 3.0, 40.0, 0.0, 0.0]]
    assert plan_position(3.0, 0.0, 0.0, 3.0, LIMITS).duration == 0.0


def test_a_turn_that_comes_back_just_as_far_is_the_fastest_way() -> None:
    """The way there and back is much longer than the way between: its rounding is no miss to be made up for."""
    limits = Limits(3290.389195627944, 44064.0337728279, 98958.19433547233, 235762.46642259829)
    start, place = (2382.531902345335, -2129.889425760415, 864.6030491129646), 2390.346643709829
    velocity = passable_velocity(*start, place, limits.velocity, limits)
    profile = plan_passing(*start, place, velocity, limits)
    assert len(profile.pieces) == 3
    assert profile.pieces[-1, 1:4].tolist() == [place, velocity, 0.0]
