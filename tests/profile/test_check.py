"""The check of the planner itself: each kind of fault put into a good plan is refused for its own reason."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray

from motionlayer.profile import TOLERANCES, Limits, plan_position, plan_velocity
from motionlayer.profile._check import (
    ACCELERATION_LIMIT,
    END_STATE,
    FINE,
    JERK_LIMIT,
    JUMP,
    NOT_FINITE,
    REASONS,
    TIME_RUNS_BACK,
    VELOCITY_LIMIT,
    check_meeting,
    check_velocity,
)

from .cases import Problem, inside, some

LIMITS = Limits(100.0, 1000.0, 500.0, 10000.0)
TARGET = 100.0
GOOD = plan_position(0.0, 0.0, 0.0, TARGET, LIMITS).pieces
LAST = len(GOOD) - 1


def verdict(pieces: NDArray[np.float64], limits: Limits = LIMITS, target: float = TARGET) -> int:
    return check_meeting(pieces, len(pieces), target, 0.0, 0.0, *limits)


def mutated(row: int, field: int, value: float) -> NDArray[np.float64]:
    pieces = GOOD.copy()
    pieces[row, field] = value
    return pieces


def test_the_good_plan_has_all_phases_and_passes() -> None:
    assert len(GOOD) == 7
    assert verdict(GOOD) == FINE


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("field", range(5))
@pytest.mark.parametrize("row", [0, 3, LAST])
def test_not_finite(row: int, field: int, value: float) -> None:
    assert verdict(mutated(row, field, value)) == NOT_FINITE


@pytest.mark.parametrize("row", range(1, len(GOOD)))
def test_time_runs_back(row: int) -> None:
    before = float(GOOD[row - 1, 0])
    assert verdict(mutated(row, 0, before)) == TIME_RUNS_BACK
    assert verdict(mutated(row, 0, before - 0.001)) in {TIME_RUNS_BACK, VELOCITY_LIMIT}


@pytest.mark.parametrize(("field", "size"), [(1, 1e-7), (2, 1e-7), (3, 1e-6)])
@pytest.mark.parametrize("row", range(1, LAST))
def test_jump(row: int, field: int, size: float) -> None:
    for sign in (-1.0, 1.0):
        pieces = mutated(row, field, float(GOOD[row, field]) + sign * size)
        assert verdict(pieces) in {JUMP, VELOCITY_LIMIT, ACCELERATION_LIMIT}
    inward = mutated(row, field, float(GOOD[row, field]) * (1.0 - 1e-8) - 1e-7)
    assert verdict(inward) == JUMP or GOOD[row, field] <= 0.0


def test_jump_within_the_tolerance_passes() -> None:
    assert verdict(mutated(3, 1, float(GOOD[3, 1]) * (1.0 + 1e-13))) == FINE


@pytest.mark.parametrize("row", [0, 1, 3, 5])
def test_jerk_limit(row: int) -> None:
    assert verdict(mutated(row, 4, LIMITS.jerk * 1.001 * (float(np.sign(GOOD[row, 4])) or 1.0))) in {
        JERK_LIMIT,
        VELOCITY_LIMIT,
    }
    assert verdict(GOOD, LIMITS._replace(jerk=LIMITS.jerk * (1.0 - 1e-9))) == JERK_LIMIT


@pytest.mark.parametrize(
    ("name", "fault"),
    [("velocity", VELOCITY_LIMIT), ("acceleration", ACCELERATION_LIMIT), ("deceleration", ACCELERATION_LIMIT)],
)
def test_limits(name: str, fault: int) -> None:
    lower = LIMITS._replace(**{name: getattr(LIMITS, name) * (1.0 - 1e-8)})
    assert verdict(GOOD, lower) == fault


def test_acceleration_and_deceleration_are_not_mixed_up() -> None:
    turned = LIMITS._replace(acceleration=LIMITS.deceleration, deceleration=LIMITS.acceleration)
    assert verdict(GOOD, turned) == ACCELERATION_LIMIT


@pytest.mark.parametrize(("field", "value"), [(1, 100.1), (2, 1e-3), (2, -1e-3), (3, 1.0), (4, 1.0)])
def test_end_state(field: int, value: float) -> None:
    assert verdict(mutated(LAST, field, value)) in {END_STATE, JUMP}
    assert verdict(GOOD, target=float(np.nextafter(TARGET, 0.0))) == END_STATE


def test_end_state_of_a_single_piece() -> None:
    for field, fault in ((1, END_STATE), (2, END_STATE), (3, END_STATE), (4, END_STATE)):
        pieces = np.array([[0.0, TARGET, 0.0, 0.0, 0.0]])
        assert verdict(pieces) == FINE
        pieces[0, field] += 1e-9
        assert verdict(pieces) == fault


def test_end_velocity() -> None:
    pieces = plan_velocity(0.0, 0.0, 0.0, 50.0, LIMITS).pieces
    assert check_velocity(pieces, len(pieces), 50.0, *LIMITS) == FINE
    assert check_velocity(pieces, len(pieces), 50.0000001, *LIMITS) == END_STATE


def test_a_start_inside_excuses_nothing() -> None:
    # Reversal with the larger limit on the wrong side of v = 0.
    pieces = plan_velocity(0.0, -100.0, 0.0, 100.0, Limits(100.0, 1000.0, 1000.0, 10000.0)).pieces
    for limits in (LIMITS, LIMITS._replace(acceleration=500.0, deceleration=1000.0)):
        assert check_velocity(pieces, len(pieces), 100.0, *limits) == ACCELERATION_LIMIT


FAST = (0.0, 150.0, 0.0)


@pytest.mark.parametrize(
    ("start", "way", "fault"),
    [
        (FAST, LIMITS._replace(velocity=150.0), VELOCITY_LIMIT),  # goes on as fast as it came
        (FAST, LIMITS._replace(velocity=101.0), VELOCITY_LIMIT),  # comes nearly back
        (FAST, LIMITS._replace(deceleration=450.0), VELOCITY_LIMIT),  # comes back slowly
        (FAST, LIMITS._replace(jerk=9000.0), VELOCITY_LIMIT),
        ((0.0, -150.0, 0.0), LIMITS._replace(velocity=150.0), VELOCITY_LIMIT),  # comes back inside, leaves again
        ((0.0, 0.0, 1100.0), LIMITS._replace(acceleration=1100.0), ACCELERATION_LIMIT),
        ((0.0, 0.0, 1100.0), LIMITS._replace(jerk=9000.0), ACCELERATION_LIMIT),  # is taken back slowly
        ((0.0, 60.0, -700.0), LIMITS._replace(deceleration=700.0), ACCELERATION_LIMIT),
    ],
)
def test_a_start_outside_excuses_its_way_back_only(start: tuple[float, float, float], way: Limits, fault: int) -> None:
    for target in (TARGET, 1000.0):
        pieces = plan_position(*start, target, LIMITS).pieces
        assert verdict(pieces, target=target) == FINE
    pieces = plan_position(*start, 1000.0, way).pieces
    assert verdict(pieces, target=1000.0) == fault


def test_every_fault_has_its_text() -> None:
    assert len(set(REASONS.values())) == len(REASONS)
    assert all(fault < 0 for fault in REASONS)


def changed(problem: Problem, row: int, field: int, sign: float) -> NDArray[np.float64]:
    """Return a plan in which one value is off by what a person would see, and by what its clock resolves."""
    pieces = problem.position().pieces
    p, _, _, target, limits = problem
    most = max(limits.acceleration, limits.deceleration)
    low, high = float(pieces[:, 1].min()), float(pieces[:, 1].max())
    unit = (abs(p) + abs(target - p) + high - low, limits.velocity, limits.acceleration + most)[field - 1]
    per_second = (limits.velocity, most, limits.jerk)[field - 1]
    pieces[row, field] += sign * (1e-5 * max(unit, 1e-300) + 4.0 * TOLERANCES.clock * pieces[-1, 0] * per_second)
    return pieces


@some(150)
@given(inside(), st.data())
def test_any_visible_change_is_refused(problem: Problem, data: st.DataObject) -> None:
    count = len(problem.position().pieces)
    assume(count > 2)
    row, field = data.draw(st.integers(1, count - 1)), data.draw(st.integers(1, 3))
    pieces = changed(problem, row, field, data.draw(st.sampled_from([-1.0, 1.0])))
    assert check_meeting(pieces, len(pieces), problem.target, 0.0, 0.0, *problem.limits) != FINE


def test_a_change_below_the_clock_is_none() -> None:
    # Found by the test above: positions of 1e-18 within 1e-6 s, at a velocity limit of 1, are finer than the clock.
    problem = Problem(0.0, 0.0, 1e-6, 0.0, Limits(1.0, 1.0, 1.0, 1.0))
    pieces = changed(problem, 1, 1, -1.0)
    assert check_meeting(pieces, len(pieces), problem.target, 0.0, 0.0, *problem.limits) != FINE
