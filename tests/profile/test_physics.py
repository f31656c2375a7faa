"""What every profile keeps, whatever the start: continuity, limits, end state, extent."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.profile import TOLERANCES, Profile

from .cases import Problem, anything, signed, some
from .physics import assert_lawful, assert_rests_at, assert_runs_at, curve


@some(300)
@given(anything)
def test_position_move_is_lawful_and_ends_on_target(problem: Problem) -> None:
    profile = problem.position()
    assert_lawful(profile, problem[:3], problem.limits)
    assert_rests_at(profile, problem.target)


@some(200)
@given(anything, st.one_of(signed, st.sampled_from([-1.0, 0.0, 1.0])))
def test_velocity_move_is_lawful_and_ends_on_target(problem: Problem, share: float) -> None:
    target = share * problem.limits.velocity
    profile = problem.velocity(target)
    assert_lawful(profile, problem[:3], problem.limits)
    assert_runs_at(profile, target)


@some(200)
@given(anything)
def test_stop_is_lawful_and_ends_at_rest(problem: Problem) -> None:
    profile = problem.stop()
    assert_lawful(profile, problem[:3], problem.limits)
    assert_runs_at(profile, 0.0)


def assert_extent(profile: Profile) -> None:
    _, p, v, _ = curve(profile.pieces)
    path = float(np.abs(v).max()) * profile.duration
    slack = 4.0 * TOLERANCES.position * (path + float(np.abs(p).max()))
    assert abs(float(p.min()) - profile.low) <= slack
    assert abs(float(p.max()) - profile.high) <= slack


@some(120)
@given(anything)
def test_extent_is_that_of_the_dense_curve(problem: Problem) -> None:
    assert_extent(problem.position())
    assert_extent(problem.stop())
