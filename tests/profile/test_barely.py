"""Targets so near to where the fastest way ends that the rounding of a velocity is a visible share of the way.

A joint that an axis comes to while it brakes is such a target: what it can still reach there is hardly another velocity
than its own, for as long as 1e-7 s. One in fifty of these plans was refused, and others jumped by a thousandth of
their way.
"""

import math

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from motionlayer.profile import (
    Limits,
    Moving,
    Profile,
    passable_velocity,
    plan_passing,
    plan_position,
    plan_synchronise,
    plan_velocity,
)

from .cases import Problem, anything, calm, signed, some
from .physics import assert_lawful

KINDS = ["rest", "passing", "synchronise"]
near = st.tuples(st.sampled_from([-1.0, 1.0]), st.floats(-18.0, 0.0)).map(lambda draw: draw[0] * 10.0 ** draw[1])
"""Shares of a way, down to less than what rounding does to it."""

HELD = Problem(
    0.0, 399.95, -100.0, 200.0 - 199.59998333333334, Limits(400.0, 5000.0, 6000.0, 1e5)
)  # after a hold of one cycle, 0.4 mm before a joint


def ahead(problem: Problem, share: float) -> float:
    """Return a place that lies by a share of the way beyond where the acceleration has been taken back."""
    p, v, a, _, limits = problem
    settled = plan_velocity(p, v, a, v + 0.5 * a * abs(a) / limits.jerk, limits)
    way = float(settled.pieces[-1, 1]) - p
    return p + way * (1.0 + abs(share))


@some(400)
@given(anything, signed, near)
@example(HELD, 0.5, 2.5e-4)
@example(HELD, 0.5, 1e-12)
@example(HELD, 0.5, 1e-9)
def test_a_place_that_can_hardly_be_passed_faster_is_passed_lawfully(
    problem: Problem, pull: float, share: float
) -> None:
    v, limits = abs(problem.v), problem.limits
    start = problem._replace(v=v, a=-abs(pull) * limits.deceleration) if problem is not HELD else problem
    assume(calm(start.v, start.a, limits) and start.v > 0.5 * start.a * start.a / limits.jerk)
    place = ahead(start, share)
    u = passable_velocity(start.p, start.v, start.a, place, limits.velocity, limits)
    assume(u != 0.0)
    profile = plan_passing(start.p, start.v, start.a, place, u, limits)
    assert_lawful(profile, start[:3], limits)
    assert profile.pieces[-1, 1:].tolist() == [place, u, 0.0, 0.0]


def around(problem: Problem, kind: str, u: float, share: float) -> tuple[Profile, float]:
    """Plan to a target that lies by a share of the way from where the fastest way to u ends; return it too."""
    p, v, a, _, limits = problem
    velocity = 0.0 if kind == "rest" else u
    direct = plan_velocity(p, v, a, velocity, limits)
    end = float(direct.pieces[-1, 1]) - (u * direct.duration if kind == "synchronise" else 0.0)
    target = end + share * max(abs(end - p), direct.high - direct.low)
    match kind:
        case "rest":
            return plan_position(p, v, a, target, limits), target
        case "passing":
            return plan_passing(p, v, a, target, u, limits), target
    return plan_synchronise(p, v, a, Moving(target, u), limits), target


@pytest.mark.parametrize("kind", KINDS)
@some(200)
@given(problem=anything, share=signed, near=near, alike=st.booleans())
def test_a_target_beside_where_the_fastest_way_ends_is_met_lawfully(
    kind: str, problem: Problem, share: float, near: float, alike: bool
) -> None:
    p, v, a, _, limits = problem
    settled = v + 0.5 * a * abs(a) / limits.jerk
    u = settled * (1.0 + near) if alike else share * limits.velocity
    assume(abs(u) < 0.99 * limits.velocity)
    profile, target = around(problem, kind, u, near)
    assert_lawful(profile, (p, v, a), limits)
    end = target + (u * profile.duration if kind == "synchronise" else 0.0)
    assert profile.pieces[-1, 1] == pytest.approx(end, rel=1e-15)


@pytest.mark.parametrize("velocity", [202.23709902272735, math.nextafter(202.23709902272583, 300.0)])
def test_a_target_that_moves_hardly_faster_than_the_start_is_joined(velocity: float) -> None:
    """Refused once: the way until rest was taken for the size of a way of 2e-5 mm."""
    limits = Limits(211.35178142103473, 275.2794480434549, 206.16889277546738, 595.3709693197177)
    for ahead in (0.0, 1e-17, 6.591479725328297e-14, 1e-9):
        profile = plan_synchronise(0.0, 202.23709902272583, 0.0, Moving(ahead, velocity), limits)
        assert_lawful(profile, (0.0, 202.23709902272583, 0.0), limits)


@some(200)
@given(anything, signed)
def test_the_velocity_that_remains_is_come_to_by_taking_the_acceleration_back_and_by_nothing_else(
    problem: Problem, pull: float
) -> None:
    """A second ramp made up for the rounding of that velocity, and led a joint 1e-10 mm astray."""
    p, v, _, _, limits = problem
    a = pull * min(limits.acceleration, limits.deceleration)
    remaining = v + 0.5 * a * abs(a) / limits.jerk
    assume(abs(remaining) <= limits.velocity and a != 0.0)
    profile = plan_velocity(p, v, a, remaining, limits)
    assert profile.pieces[0].tolist() == [0.0, p, v, a, -math.copysign(limits.jerk, a)]
    assert len(profile.pieces) == 2
    assert profile.duration == abs(a) / limits.jerk
    assert_lawful(profile, (p, v, a), limits)
