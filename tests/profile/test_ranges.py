"""The published table: what is inside its ranges is planned, at the edges too; the page says what the code says."""

import math
import random
from pathlib import Path

import numpy as np
import pytest

from motionlayer.profile import (
    RANGES,
    TOLERANCES,
    Limits,
    PlanError,
    passable_velocity,
    plan_passing,
    plan_position,
    plan_velocity,
)

from .cases import Problem, many
from .physics import assert_continuous, assert_lawful, assert_rests_at

PAGE = Path(__file__).parents[2] / "docs" / "profile.md"


def ranged(source: random.Random, *, edge: bool) -> Problem | None:
    """Draw limits of any size, phases of any length side by side, a start inside; None if one leaves the ranges."""

    def power(least: float, most: float) -> float:
        return float(10.0 ** source.uniform(least, most))

    vel = power(-58.0, 58.0)
    acc = vel / power(-9.0, 9.0)
    dec = acc * power(-3.0, 3.0)
    slowest = max(vel / acc, vel / dec)
    shortest = slowest / (RANGES.phases if edge else power(0.0, 12.0))
    limits = Limits(vel, acc, dec, min(min(acc, dec) / shortest, vel / (shortest * shortest)))
    if not all(RANGES.smallest <= limit <= RANGES.largest for limit in limits):
        return None
    v, a = vel * source.choice((-1.0, 0.0, 1.0, source.uniform(-1.0, 1.0))), source.uniform(-1.0, 1.0)
    a *= acc if v * a > 0.0 else dec
    distance = vel * slowest * power(-30.0, 30.0)
    if not RANGES.smallest <= distance <= RANGES.largest:
        return None
    return Problem(0.0, v, a, source.choice((-1.0, 1.0)) * distance, limits)


@pytest.mark.parametrize("edge", [False, True])
def test_everything_inside_the_ranges_is_planned(edge: bool) -> None:
    source = random.Random(edge)
    planned = 0
    for _ in range(many(10_000)):
        problem = ranged(source, edge=edge)
        if problem is None:
            continue
        planned += 1
        problem.position()
        problem.stop()
        share = source.uniform(-1.0, 1.0)
        problem.velocity(share * problem.limits.velocity)
        u = math.copysign(share, problem.target) * problem.limits.velocity  # a turn after a long cruise is refused
        assert plan_passing(*problem[:4], u, problem.limits).pieces[-1, 1] == problem.target
        assert abs(passable_velocity(*problem[:4], u, problem.limits)) <= problem.limits.velocity
    assert planned > many(3000)


@pytest.mark.parametrize("size", [RANGES.smallest, 1.0, RANGES.largest])
def test_one_size_for_everything(size: float) -> None:
    limits = Limits(size, size, size, size)
    for v, a in ((0.0, 0.0), (0.5, -0.25), (-1.0, 1.0)):
        for target in (size, -100.0 * size):
            problem = Problem(0.0, v * size, a * size, target, limits)
            profile = problem.position()
            assert_lawful(profile, problem[:3], limits)
            assert_rests_at(profile, target)
    assert plan_position(0.0, 0.0, 0.0, 100.0 * size, limits).duration == pytest.approx(102.0, rel=TOLERANCES.time)


def test_phases_that_the_clock_cannot_tell_apart_are_refused() -> None:
    # A ramp of 10^12 s, when the clock goes in steps of 10^-4 s, with ends of 10^-5 s, then of 1 s.
    limits = Limits(1.0, 1e-12, 1e-12, 1e-7)
    with pytest.raises(PlanError, match="jumps between two pieces"):
        plan_velocity(0.0, 0.0, 0.0, 1.0, limits)
    fine = limits._replace(jerk=1e-12)
    assert_continuous(plan_velocity(0.0, 0.0, 0.0, 1.0, fine))


NAMED = {
    "brakes back from 10^12 times the velocity limit": Problem(
        -984164.5975738949, 1597.741064284888, -15178079.821924517, -911838.0347318039,
        Limits(8364.31311077939, 729397.4460299314, 15782532.051385142, 93.42691916629822),
    ),
    "the same in small": Problem(
        -290.8468799891259, 1.296202668457355, -196.5523340165846, -290.84687610478665,
        Limits(1.474811704302685, 29.230109883848204, 288.14700134979245, 4.153503183401598e-06),
    ),
    "starts outside in both": Problem(
        0.9125507706592473, 0.00043421200026862546, -9.81357271589501, 0.9068009303496424,
        Limits(0.0009701188103340083, 0.06772857062572071, 1.8100968648409832, 1.1726234489660725e-05),
    ),
}  # fmt: skip


@pytest.mark.parametrize("problem", NAMED.values(), ids=list(NAMED))
def test_found_once(problem: Problem) -> None:
    profile = problem.position()
    assert_lawful(profile, problem[:3], problem.limits)
    assert_rests_at(profile, problem.target)


def test_target_farther_than_a_float_is_refused() -> None:
    with pytest.raises(PlanError), np.errstate(all="ignore"):
        plan_position(-1.7e308, 0.0, 0.0, 1.7e308, Limits(1.0, 1.0, 1.0, 1.0))
    with pytest.raises(PlanError), np.errstate(all="ignore"):
        plan_passing(-1.7e308, 0.0, 0.0, 1.7e308, 0.5, Limits(1.0, 1.0, 1.0, 1.0))


@pytest.mark.parametrize("limit", [5e-324, 1e-310, 1e308])
@pytest.mark.parametrize("name", Limits._fields)
def test_denormal_and_huge_limits_are_exact_or_refused(name: str, limit: float) -> None:
    limits = Limits(1.0, 2.0, 3.0, 4.0)._replace(**{name: limit})
    for start in ((0.0, 0.0, 0.0), (0.0, 0.5, -1.0), (1.0, -2.0, 5.0)):
        problem = Problem(*start, 7.0, limits)
        for plan in (problem.position, problem.stop):
            try:
                with np.errstate(all="ignore"):
                    profile = plan()
            except ArithmeticError:
                continue
            assert_lawful(profile, start, limits)


def test_the_page_says_what_the_code_says() -> None:
    text = PAGE.read_text()
    for value in (*TOLERANCES, RANGES.smallest, RANGES.largest, RANGES.phases):
        mantissa, exponent = f"{value:e}".split("e")
        assert f"{float(mantissa):g}e{int(exponent)}" in text, value
    assert f"{RANGES.duration:.0f} s" in text
