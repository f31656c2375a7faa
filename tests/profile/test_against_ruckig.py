"""Durations against ruckig: as quick as it is, to 1e-11, never quicker; cases that failed once stand as examples."""

import random
from collections.abc import Callable

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from motionlayer.profile import Limits

from .cases import Problem, calm, inside, integers, many, signed, some
from .oracle import position_times, velocity_time

CLOSE = 1e-11

# Phases that just touch a limit: ruckig itself needs 28 % and 83 % longer than necessary here.
AT_THE_LIMIT = Problem(0.0, 3.0, -4.0, -39.0, Limits(5.0, 5.0, 5.0, 1.0))
NO_HOLD = Problem(0.0, 2.0, 0.0, 11.0, Limits(6.0, 1.0, 1.0, 1.0))


def stop_end(problem: Problem) -> float:
    return float(problem.stop().pieces[-1, 1])


def touches_stop(problem: Problem) -> bool:
    """Tell whether the target is so close to where a stop ends that ruckig's absolute tolerance blurs it."""
    length = problem.limits.velocity * problem.limits.velocity / problem.limits.acceleration
    return abs(problem.target - stop_end(problem)) < 1e-7 * length


def assert_same_time(problem: Problem) -> None:
    p, v, a, target, limits = problem
    ours = problem.position().duration
    slack = CLOSE * max(ours, limits.velocity / limits.acceleration)
    for theirs in position_times(v, a, target - p, limits):
        assert ours <= theirs + slack, f"ruckig needs {theirs}, we {ours}: {problem}"
        if ours >= theirs - slack:
            return
    pytest.fail(f"ruckig needs {theirs}, we only {ours}: {problem}")


@some(300)
@given(st.one_of(integers(symmetric=True), inside(symmetric=True), inside(symmetric=True, spread=2.0)))
@example(AT_THE_LIMIT)
@example(NO_HOLD)
def test_position_with_equal_limits(problem: Problem) -> None:
    assume(calm(problem.v, problem.a, problem.limits) and not touches_stop(problem))
    assert_same_time(problem)


def test_small_integers_by_the_thousand() -> None:
    source = random.Random(1)
    for _ in range(many(10000)):
        vel, acc, jerk = (float(source.randint(1, 6)) for _ in range(3))
        v, a, target = (float(source.randint(-n, n)) for n in (6, 6, 40))
        limits = Limits(vel, acc, acc, jerk)
        problem = Problem(0.0, v, a, target, limits)
        if calm(v, a, limits) and not touches_stop(problem):
            assert_same_time(problem)


@pytest.mark.slow
@pytest.mark.parametrize("decades", [0.5, 1.0, 2.0, 3.0])
def test_every_scale_by_the_ten_thousand(decades: float) -> None:
    source = random.Random(decades)

    def power(most: float) -> float:
        return float(10.0 ** source.uniform(-most, most))

    for _ in range(many(20000)):
        vel = power(6.0)
        acc = vel * power(decades)
        limits = Limits(vel, acc, acc, acc * power(decades))
        v, a = vel * source.uniform(-1.0, 1.0), acc * source.uniform(-1.0, 1.0)
        problem = Problem(0.0, v, a, vel * vel / acc * power(6.0) * source.choice((-1.0, 1.0)), limits)
        if calm(v, a, limits) and not touches_stop(problem):
            assert_same_time(problem)


@some(300)
@given(st.one_of(integers(), inside(), inside(spread=2.0)))
def test_position_with_unequal_limits_without_reversal(problem: Problem) -> None:
    # While v keeps its sign, ruckig's signed bound on the acceleration is a deceleration limit.
    p, v, a, target, limits = problem
    if v < 0.0:
        v, a = -v, -a
    assume(calm(v, a, limits) and (v > 0.0 or a >= 0.0))
    assume(v + min(a, 0.0) * abs(a) / (2.0 * limits.jerk) >= 0.0)
    problem = Problem(p, v, a, target, limits)
    end = stop_end(problem)
    problem = problem._replace(target=end + abs(target - end))
    assume(not touches_stop(problem))
    assert_same_time(problem)


@some(150)
@given(st.one_of(integers(symmetric=True), inside(symmetric=True)), signed)
def test_velocity_with_equal_limits(problem: Problem, share: float) -> None:
    _, v, a, _, limits = problem
    assume(calm(v, a, limits))
    theirs, _ = velocity_time(v, a, share * limits.velocity, 0.0, limits)
    ours = problem.velocity(share * limits.velocity).duration
    assert ours == pytest.approx(theirs, rel=CLOSE, abs=CLOSE * limits.velocity / limits.acceleration)


@some(50)
@given(inside(), signed)
@example(Problem(0.0, 1.0, 0.0, 0.0, Limits(1.0, 1.0, 1.0, 1.0)), 0.0)
def test_reversal_is_the_best_way_through_zero(problem: Problem, share: float) -> None:
    # A reversal by hand: down to v = 0 with an acceleration x under D, from there to the target under A and D. Both
    # halves keep the sign of v, so ruckig plans them. Every x is a lawful way, and the best of them is ours.
    limits = problem.limits
    v = -abs(problem.v)
    assume(v < 0.0)
    highest = min(limits.acceleration, limits.deceleration, (-2.0 * limits.jerk * v) ** 0.5)
    turn = Problem(0.0, v, 0.0, 0.0, limits)
    far = Problem(0.0, 0.0, highest, 0.0, limits)
    target = stop_end(turn) + stop_end(far) + abs(share) * limits.velocity * limits.velocity / limits.acceleration
    ours = turn._replace(target=target).position().duration
    braking = limits._replace(acceleration=limits.deceleration)

    def time(x: float) -> float:
        first, distance = velocity_time(v, 0.0, 0.0, x, braking)
        second = next(position_times(0.0, x, target - distance, limits))
        assert first + second >= ours * (1.0 - 1e-9), f"{x} at v = 0 is quicker: {turn._replace(target=target)}"
        return first + second

    assert least(time, highest) <= ours * (1.0 + 1e-7), turn._replace(target=target)


def least(function: Callable[[float], float], high: float) -> float:
    """Return the least value between 0 and `high` of a function with one valley."""
    low, best = 0.0, function(high)
    for _ in range(40):
        first, second = low + (high - low) / 3.0, high - (high - low) / 3.0
        one, two = function(first), function(second)
        best = min(best, one, two)
        low, high = (low, second) if one < two else (first, high)
    return best
