"""Passable velocities: the nearest to the one asked for that spares the way back, to the last float."""

import math

import numpy as np
from hypothesis import assume, example, given

from motionlayer.profile import Limits, Profile, passable_velocity, plan_passing, plan_velocity

from .cases import Problem, anything, signed, some
from .physics import assert_lawful, curve

LIMITS = Limits(100.0, 1000.0, 500.0, 10000.0)
START = (0.0, 0.0, 0.0)


def goes_on(profile: Profile, direction: float, limits: Limits) -> bool:
    """Tell whether a profile, once it goes in the direction, never goes back."""
    v = direction * curve(profile.pieces)[2]
    forward = v >= 0.0
    return bool((v[int(np.argmax(forward)) :] >= -1e-9 * limits.velocity).all())


@some(300)
@given(anything, signed)
@example(Problem(0.0, 80.0, 0.0, 5.0, LIMITS), 0.2)
@example(Problem(0.0, 0.0, 0.0, 1.0, LIMITS), 0.5)
def test_the_passable_velocity_spares_the_way_back_and_is_the_nearest(problem: Problem, share: float) -> None:
    p, v, a, target, limits = problem
    u = share * limits.velocity
    found = passable_velocity(p, v, a, target, u, limits)
    assert abs(found) <= limits.velocity
    if found == 0.0:
        return
    s = math.copysign(1.0, found)
    assert u == 0.0 or s * u > 0.0
    profile = plan_passing(p, v, a, target, found, limits)
    assert_lawful(profile, (p, v, a), limits)
    assert profile.pieces[-1, 1:].tolist() == [target, found, 0.0, 0.0]
    reached = v + 0.5 * a * abs(a) / limits.jerk
    assert goes_on(profile, s, limits) or s * v >= 0.0 > s * reached  # its own acceleration turns it
    if found != u:  # the next float towards u is too much: its own fastest way already leads beyond the target
        beyond = plan_velocity(0.0, v, a, float(np.nextafter(found, u)), limits).pieces[-1, 1]
        assert s * (beyond - (target - p)) > 0.0


@some(200)
@given(anything, signed)
def test_without_a_passable_velocity_the_target_is_behind_or_too_near(problem: Problem, share: float) -> None:
    p, v, a, target, limits = problem
    u = share * limits.velocity
    assume(u != 0.0 and passable_velocity(p, v, a, target, u, limits) == 0.0)
    s = math.copysign(1.0, u)
    level = min(max(s * (v + 0.5 * a * abs(a) / limits.jerk), 0.0), limits.velocity)
    for velocity in (
        level,
        0.5 * (level + limits.velocity),
        0.5 * level,
    ):  # each way leads beyond, or ends on it at rest
        end = plan_velocity(0.0, v, a, s * velocity, limits).pieces[-1, 1]
        assert s * (end - (target - p)) >= 0.0


def test_a_velocity_that_can_be_had_is_taken_as_it_is() -> None:
    for velocity in (0.0, 5e-324, 30.0, 100.0):
        assert passable_velocity(*START, 100.0, velocity, LIMITS) == velocity
        assert passable_velocity(*START, -100.0, -velocity, LIMITS) == -velocity


def test_who_cannot_brake_passes_faster_and_who_cannot_stop_too() -> None:
    for velocity in (20.0, 0.0):
        found = passable_velocity(0.0, 80.0, 0.0, 5.0, velocity, LIMITS)
        assert 68.0 < found < 69.0
        assert plan_passing(0.0, 80.0, 0.0, 5.0, found, LIMITS).duration < 0.07


def test_a_target_behind_has_no_passable_velocity() -> None:
    assert passable_velocity(*START, -10.0, 50.0, LIMITS) == 0.0
    assert passable_velocity(0.0, 80.0, 400.0, 1.0, 50.0, LIMITS) == 0.0  # too near to bring a to zero
    assert passable_velocity(0.0, 150.0, 0.0, 1.0, 50.0, LIMITS) == 0.0  # too near to come below the limit
