"""Being in a state at a time: exactly there, exactly then, inside the limits; refusals say why, and what would do."""

import math
import re

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from motionlayer import profile as planner
from motionlayer.profile import (
    Limits,
    Moving,
    PlanError,
    Profile,
    State,
    plan_passing,
    plan_position,
    plan_rendezvous,
    plan_synchronise,
    rest_at,
)

from .cases import Problem, anything, inside, integers, outside, signed, some
from .physics import assert_continuous, assert_lawful

LIMITS = Limits(100.0, 1000.0, 500.0, 10000.0)
START = (0.0, 0.0, 0.0)
EARLIEST = re.compile(r"before (\S+) s|met at (\S+) s")

shares = st.tuples(signed, signed)


def target(problem: Problem, share: tuple[float, float]) -> State:
    """Return a state at the problem's target into which a lawful ramp leads: from a share of the velocity limit."""
    vel, acc, dec, jerk = problem.limits
    before = 0.95 * share[0] * vel
    pull = share[1] * min(acc, dec, math.sqrt(2.0 * jerk * (0.99 * vel - abs(before))))
    return State(problem.target, before + 0.5 * pull * abs(pull) / jerk, pull)


def ample(problem: Problem) -> float:
    """Return a time in which any state can be met: to stop, to go there and back at full speed, to ramp."""
    p, v, a, there, (vel, acc, dec, jerk) = problem
    top = abs(v) + 0.5 * a * a / jerk + vel
    ramps = 4.0 * (top / min(acc, dec) + (abs(a) + acc + dec) / jerk)
    return (abs(there - p) + ramps * top) / vel + ramps


def assert_meets(profile: Profile, state: State, at: float) -> None:
    assert profile.pieces[-1].tolist() == [at, *state, 0.0]


@some(300)
@given(st.one_of(integers(), inside(), outside()), shares, st.floats(1.0, 20.0))
def test_with_ample_time_any_state_is_met(problem: Problem, share: tuple[float, float], later: float) -> None:
    state, at = target(problem, share), later * ample(problem)
    profile = plan_rendezvous(*problem[:3], state, problem.limits, at=at)
    assert_lawful(profile, problem[:3], problem.limits)
    assert_meets(profile, state, at)


@some(300)
@given(st.one_of(integers(), inside()), shares, st.floats(0.0, 5.0))
def test_at_any_time_the_state_is_met_or_the_message_names_a_time_that_does(
    problem: Problem, share: tuple[float, float], later: float
) -> None:
    state = target(problem, share)
    at = abs(state.acceleration) / problem.limits.jerk + later * problem.limits.velocity / problem.limits.acceleration
    try:
        profile = plan_rendezvous(*problem[:3], state, problem.limits, at=at)
    except PlanError as error:
        message = str(error)
    else:
        assert_lawful(profile, problem[:3], problem.limits)
        assert_meets(profile, state, at)
        return
    named = EARLIEST.search(message)
    assert named is not None, message
    before, gap = named.groups()
    earliest = float(before or gap)
    assert at < earliest if before else at >= earliest
    there = plan_rendezvous(*problem[:3], state, problem.limits, at=earliest * (1.0 + 1e-9))
    assert_meets(there, state, earliest * (1.0 + 1e-9))


@some(200)
@given(st.one_of(integers(), inside()), shares)
def test_the_earliest_is_passing_the_begin_of_the_ramp(problem: Problem, share: tuple[float, float]) -> None:
    p, v, a, _, limits = problem
    state = target(problem, share)
    ramp = abs(state.acceleration) / limits.jerk
    before = state.velocity - 0.5 * ramp * state.acceleration
    j = math.copysign(limits.jerk, state.acceleration)
    begin = state.position - before * ramp - j * ramp * ramp * ramp / 6.0
    earliest = plan_passing(p, v, a, begin, before, limits).duration + ramp
    assume(0.99 * earliest > ramp)
    with pytest.raises(PlanError, match="cannot be met before"):
        plan_rendezvous(p, v, a, state, limits, at=0.99 * earliest)


@some(200)
@given(anything, shares, st.floats(1.0, 3.0))
def test_mirrored_state_is_met_in_the_mirrored_way(problem: Problem, share: tuple[float, float], later: float) -> None:
    p, v, a, _, limits = problem
    state, at = target(problem, share), later * ample(problem)
    there = plan_rendezvous(p, v, a, state, limits, at=at)
    mirrored = State(-state.position, -state.velocity, -state.acceleration)
    back = plan_rendezvous(-p, -v, -a, mirrored, limits, at=at)
    assert (there.pieces * np.array([1.0, -1.0, -1.0, -1.0, -1.0])).tolist() == back.pieces.tolist()


@some(150)
@given(st.one_of(integers(), inside()), signed, st.floats(1.001, 20.0))
def test_without_acceleration_the_target_is_joined_as_late_as_possible(
    problem: Problem, share: float, later: float
) -> None:
    p, v, a, place, limits = problem
    u = 0.95 * share * limits.velocity
    line = Moving(place, u)
    earliest = plan_synchronise(p, v, a, line, limits).duration
    at = later * earliest
    profile = plan_rendezvous(p, v, a, State(place + u * at, u, 0.0), limits, at=at)
    assert_lawful(profile, problem[:3], problem.limits)
    assert profile.duration == at
    t, _, velocity, pull, jerk = profile.pieces[-2].tolist() if len(profile.pieces) > 1 else [at, 0.0, u, 0.0, 0.0]
    joined = t if (velocity, pull, jerk) == (u, 0.0, 0.0) else at
    # A target that comes by where the fastest way to its velocity ends is joined there and then.
    assert joined >= (1.0 - 1e-6) * at or len(profile.pieces) <= len(problem.velocity(u).pieces) + 1


def test_by_hand() -> None:
    # From rest to 50 u/s with 500 u/s² at the end, at 10 000 u/s³: the last 0.05 s gain 12.5 of it.
    profile = plan_rendezvous(*START, State(20.0, 50.0, 500.0), LIMITS, at=2.0)
    assert_meets(profile, State(20.0, 50.0, 500.0), 2.0)
    t, p, v, a, j = profile.pieces[-2].tolist()
    assert (t, v, a, j) == (1.95, 37.5, 0.0, 10000.0)
    assert p == pytest.approx(20.0 - 0.05 * 37.5 - 10000.0 * 0.05**3 / 6.0, rel=1e-14)


def test_resting_somewhere_at_a_time() -> None:
    earliest = plan_position(*START, 100.0, LIMITS).duration
    profile = plan_rendezvous(*START, State(100.0, 0.0, 0.0), LIMITS, at=3.0 * earliest)
    assert_lawful(profile, START, LIMITS)
    assert_meets(profile, State(100.0, 0.0, 0.0), 3.0 * earliest)
    there = plan_rendezvous(3.0, 0.0, 0.0, State(3.0, 0.0, 0.0), LIMITS, at=0.0)
    assert there.pieces.tolist() == rest_at(3.0).pieces.tolist()


def test_who_comes_along_too_fast_to_be_a_little_later_backs_off() -> None:
    # At 100 u/s towards a target that is to be passed at 100 u/s: in 0.1 s, or not for long.
    state = State(10.0, 100.0, 0.0)
    assert plan_rendezvous(0.0, 100.0, 0.0, state, LIMITS, at=0.1).low == 0.0
    with pytest.raises(PlanError, match=r"can be met at 0\.1 s, and then only later than at 0\.12 s"):
        plan_rendezvous(0.0, 100.0, 0.0, state, LIMITS, at=0.12)
    backed = plan_rendezvous(0.0, 100.0, 0.0, state, LIMITS, at=1.5)
    assert_lawful(backed, (0.0, 100.0, 0.0), LIMITS)
    assert backed.pieces[:, 2].min() < 0.0


@pytest.mark.parametrize(
    ("state", "reason"),
    [
        (State(1.0, 100.1, 0.0), r"velocity 100\.1 is above the limit 100"),
        (State(1.0, -100.1, 0.0), r"velocity -100\.1 is above the limit 100"),
        (State(1.0, 50.0, 1001.0), r"above the acceleration limit 1000"),
        (State(1.0, 50.0, -501.0), r"above the deceleration limit 500"),
        (State(1.0, -50.0, 501.0), r"above the deceleration limit 500"),
        (State(1.0, 100.0, -100.0), r"can only be gained from velocity 100\.5, which is above the limit 100"),
        (
            State(1.0, 1.0, 600.0),
            r"through velocity 0 with 583\.\d+ there, .* lower of the limits 1000.* and 500",
        ),
        (State(1.0, 0.0, 501.0), r"above the deceleration limit 500"),
        (State(1.0, math.nan, 0.0), "above the limit"),
        (State(1.0, 0.0, math.nan), "above the deceleration limit"),
        (State(1.0, 0.0, math.inf), "above the deceleration limit"),
    ],
)
def test_a_state_that_no_way_leads_into_is_named(state: State, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        plan_rendezvous(*START, state, LIMITS, at=100.0)


@pytest.mark.parametrize("at", [math.nan, math.inf, -math.inf, -1.0, 0.0499])
def test_a_time_that_is_none_or_shorter_than_the_ramp_is_refused(at: float) -> None:
    with pytest.raises(ValueError, match=r"finite and at least 0\.05 s, what the ramp"):
        plan_rendezvous(*START, State(1.0, 50.0, 500.0), LIMITS, at=at)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("field", range(4))
def test_a_number_that_is_none_is_refused(field: int, value: float) -> None:
    numbers = [0.5, 0.25, -0.5, 3.0]
    numbers[field] = value
    p, v, a, position = numbers
    with np.errstate(all="ignore"), pytest.raises(PlanError):
        plan_rendezvous(p, v, a, State(position, 0.5, 0.5), LIMITS, at=10.0)


@pytest.mark.parametrize("value", [math.nan, math.inf, 0.0, -0.0, -1.0])
@pytest.mark.parametrize("name", Limits._fields)
def test_a_limit_that_is_none_is_refused(name: str, value: float) -> None:
    with pytest.raises(PlanError, match="a limit is not finite and above zero"):
        plan_rendezvous(*START, State(1.0, 0.5, 0.5), LIMITS._replace(**{name: value}), at=10.0)


@some(250)
@given(*[st.floats()] * 4, st.floats(-100.0, 100.0), st.floats(-500.0, 500.0), st.floats(0.0, 1e9))
def test_any_floats_are_exact_or_refused(
    p: float, v: float, a: float, position: float, u: float, pull: float, at: float
) -> None:
    state = State(position, u, pull)
    try:
        with np.errstate(all="ignore"):
            profile = plan_rendezvous(p, v, a, state, LIMITS, at=at)
    except (ArithmeticError, ValueError):
        return
    assert_meets(profile, state, at)
    assert_continuous(profile)


def test_message_can_be_pasted() -> None:
    with pytest.raises(PlanError) as caught:
        plan_rendezvous(*START, State(1.0 / 3.0, 5.0, 10.0), LIMITS, at=0.01)
    call = str(caught.value).split(": ", 1)[1]
    with pytest.raises(PlanError, match="cannot be met before"):
        eval(call, vars(planner).copy())  # noqa: S307 - that is the promise
