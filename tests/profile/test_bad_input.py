"""Input outside what is documented: refused with `PlanError`, or planned exactly; never a wrong profile."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer import profile as planner
from motionlayer.profile import Limits, PlanError, Profile, plan_position, plan_stop, plan_velocity

from .cases import Problem, some
from .physics import assert_begins, assert_continuous, assert_lawful, assert_rests_at, assert_runs_at

FINE = Limits(1.0, 2.0, 3.0, 4.0)
NOT_NUMBERS = [math.nan, math.inf, -math.inf]


@pytest.mark.parametrize("value", [*NOT_NUMBERS, 0.0, -0.0, -1.0])
@pytest.mark.parametrize("name", Limits._fields)
def test_limit_that_is_none_is_refused(name: str, value: float) -> None:
    limits = FINE._replace(**{name: value})
    refused = pytest.raises(PlanError, match="a limit is not finite and above zero")
    with refused:
        plan_position(0.0, 0.0, 0.0, 1.0, limits)
    with refused:
        plan_position(0.0, 0.5, -0.5, 0.0, limits)
    with refused:
        plan_stop(0.0, 0.5, 0.5, limits)


@pytest.mark.parametrize("value", NOT_NUMBERS)
@pytest.mark.parametrize("field", range(4))
def test_state_that_is_no_number_is_refused(field: int, value: float) -> None:
    state = [0.5, 0.25, -0.5, 3.0]
    state[field] = value
    p, v, a, target = state
    problem = Problem(p, v, a, target, FINE)
    with np.errstate(all="ignore"), pytest.raises(ArithmeticError):
        problem.position()
    if field < 3:
        with np.errstate(all="ignore"), pytest.raises(ArithmeticError):
            problem.stop()


def test_message_can_be_pasted() -> None:
    with pytest.raises(PlanError) as caught:
        plan_position(0.0, 1.0, 0.1, 1.0 / 3.0, FINE._replace(jerk=math.inf))
    call = str(caught.value).split(": ", 1)[1]
    with pytest.raises(PlanError, match="a limit is not finite"):
        eval(call, {**vars(planner), "inf": math.inf})  # noqa: S307 - that is the promise


def exact_or_refused(plan: Callable[[], Profile], start: tuple[float, float, float], limits: Limits) -> Profile | None:
    try:
        with np.errstate(all="ignore"):
            profile = plan()
    except ArithmeticError:
        return None
    assert_begins(profile, start, limits)
    assert_continuous(profile)
    assert (np.abs(profile.pieces[:, 4]) <= limits.jerk).all()
    return profile


@pytest.mark.parametrize("jerk", [5e-324, 1e-308, 1e-200])
def test_jerk_too_small_to_compute_with_does_not_teleport(jerk: float) -> None:
    limits = Limits(1.0, 1.0, 1.0, jerk)
    profile = exact_or_refused(lambda: plan_position(0.0, 0.0, 0.0, 1.0, limits), (0.0, 0.0, 0.0), limits)
    assert profile is None or profile.duration > 0.0


@pytest.mark.parametrize("distance", [1e-30, 1e-60, 1e-138, 1e-300, 5e-324])
def test_distance_below_everything_is_exact_or_refused(distance: float) -> None:
    profile = exact_or_refused(lambda: plan_position(0.0, 0.0, 0.0, distance, FINE), (0.0, 0.0, 0.0), FINE)
    if profile is not None:
        assert_rests_at(profile, distance)


@pytest.mark.parametrize(("v", "a"), [(0.0, 1.8961503816218355e154), (-1.0, 1.4e154), (1.0, 1e200)])
def test_start_whose_square_overflows_is_exact_or_refused(v: float, a: float) -> None:
    # An infinite bound would let every later comparison pass.
    limits = Limits(1.0, 1.0, 1e155, 1e79)
    problem = Problem(0.0, v, a, 1.0, limits)
    for plan in (problem.position, problem.stop):
        profile = exact_or_refused(plan, problem[:3], limits)
        if profile is not None:
            assert_lawful(profile, problem[:3], limits)


# Squares and cubes of these still are floats; beyond, the planner may lose what underflows.
sizes = st.integers(-60, 60).map(lambda exponent: 10.0**exponent)
anyhow = st.one_of(st.floats(), sizes, sizes.map(lambda size: -size))


@some(250)
@given(anyhow, anyhow, anyhow, anyhow, st.tuples(sizes, sizes, sizes, sizes))
def test_any_floats(p: float, v: float, a: float, target: float, sizes: tuple[float, float, float, float]) -> None:
    limits = Limits(*sizes)
    position = exact_or_refused(lambda: plan_position(p, v, a, target, limits), (p, v, a), limits)
    if position is not None:
        assert_rests_at(position, target)
    stop = exact_or_refused(lambda: plan_stop(p, v, a, limits), (p, v, a), limits)
    if stop is not None:
        assert_runs_at(stop, 0.0)
    if abs(target) <= limits.velocity:
        velocity = exact_or_refused(lambda: plan_velocity(p, v, a, target, limits), (p, v, a), limits)
        if velocity is not None:
            assert_runs_at(velocity, target)
