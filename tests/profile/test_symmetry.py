"""The planner has no favourite direction, unit, place or moment."""

import random

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from motionlayer.profile import TOLERANCES, Limits, plan_position, plan_stop

from .cases import Problem, anything, calm, inside, integers, many, signed, some

MIRROR = np.array([1.0, -1.0, -1.0, -1.0, -1.0])
# The acceleration outside its limit, and its target exactly what bringing it back to zero gains.
EXACTLY_GAINED = Problem(0.0, -4.0, 4.0, 0.0, Limits(6.0, 1.0, 1.0, 2.0))


def mirrored(problem: Problem) -> Problem:
    p, v, a, target, limits = problem
    return Problem(-p, -v, -a, -target, limits)


@some(250)
@given(anything, signed)
@example(EXACTLY_GAINED, 0.0)
def test_mirrored_problem_has_the_mirrored_answer_bit_for_bit(problem: Problem, share: float) -> None:
    other, target = mirrored(problem), share * problem.limits.velocity
    for there, back in (
        (problem.position(), other.position()),
        (problem.stop(), other.stop()),
        (problem.velocity(target), other.velocity(-target)),
    ):
        assert (there.pieces * MIRROR).tolist() == back.pieces.tolist()
        assert (there.low, there.high) == (-back.high, -back.low)


@some(120)
@given(anything, st.integers(-20, 20))
def test_power_of_two_as_unit_of_length_changes_no_bit_of_the_times(problem: Problem, exponent: int) -> None:
    factor = 2.0**exponent
    there, back = problem.position(), problem.scaled(factor).position()
    assert (there.pieces * [1.0, *[factor] * 4]).tolist() == back.pieces.tolist()


@some(120)
@given(st.one_of(inside(), integers()), st.sampled_from([1e-6, 1e-3, 1e3, 1e6, 360.0, 1.0 / 360.0, 0.0254]))
def test_same_move_takes_the_same_time_in_any_unit(problem: Problem, factor: float) -> None:
    move = problem._replace(p=0.0, v=0.0, a=0.0)
    assert move.scaled(factor).position().duration == pytest.approx(move.position().duration, rel=TOLERANCES.time)


@some(120)
@given(st.one_of(inside(), integers()), st.sampled_from([1e-6, 1e-3, 1e3, 1e6, 360.0, 1.0 / 360.0, 0.0254]))
def test_same_stop_takes_the_same_time_in_any_unit(problem: Problem, factor: float) -> None:
    calmly = calm(problem.v, problem.a, problem.limits)
    move = problem if calmly else problem._replace(a=0.0)
    rounding = abs(move.a) / move.limits.jerk + abs(move.v) / move.limits.deceleration
    assert move.scaled(factor).stop().duration == pytest.approx(
        move.stop().duration, rel=TOLERANCES.time, abs=1e-7 * rounding
    )


def test_a_machine_in_motion_takes_the_same_time_in_any_unit() -> None:
    # µm, m, degrees of a spindle of 5 mm a turn; jerk up to 1e9. The worst of 100 000 was 9e-15.
    source = random.Random(1)
    for _ in range(many(10_000)):
        vel, acc, jerk = (10.0 ** source.uniform(*decades) for decades in ((0.0, 4.0), (1.0, 5.0), (2.0, 9.0)))
        limits = Limits(vel, acc, acc * 10.0 ** source.uniform(-0.5, 0.5), jerk)
        v, a = vel * source.uniform(-1.0, 1.0), source.uniform(-1.0, 1.0) * min(limits[1:3])
        distance = vel * vel / acc * source.choice((-1.0, 1.0)) * 10.0 ** source.uniform(-3.0, 3.0)
        problem = Problem(0.0, v, a if calm(v, a, limits) else 0.0, distance, limits)
        time = problem.position().duration
        for factor in (1e3, 1e-3, 72.0):
            assert abs(problem.scaled(factor).position().duration - time) <= TOLERANCES.time * time, problem


@some(120)
@given(anything, st.integers(-1000, 1000).map(float))
def test_stop_does_not_depend_on_the_place(problem: Problem, place: float) -> None:
    here, there = problem._replace(p=0.0).stop(), problem._replace(p=place).stop()
    assert here.pieces[:, [0, 2, 3, 4]].tolist() == there.pieces[:, [0, 2, 3, 4]].tolist()
    assert (here.pieces[:, 1] + place).tolist() == there.pieces[:, 1].tolist()


def test_a_plan_is_not_changed_by_the_next_one() -> None:
    limits = Limits(100.0, 1000.0, 500.0, 10000.0)
    first = plan_position(0.0, 0.0, 0.0, 100.0, limits)
    kept = first.pieces.copy()
    plan_stop(3.0, 50.0, 100.0, limits)
    assert first.pieces.tolist() == kept.tolist()
