"""Durations against the optimum of a linear program: separate limits, reversals, moving targets, starts outside.

Where ruckig can be no oracle: its deceleration limit is a signed bound.
"""

import itertools
import random
from typing import NamedTuple

import numpy as np
import pytest

from motionlayer.profile import (
    Limits,
    Moving,
    Profile,
    plan_passing,
    plan_position,
    plan_stop,
    plan_synchronise,
    stop_displacement,
)
from motionlayer.profile._check import time_back
from motionlayer.profile._meet import gain
from tests.effort import examples

from .linear import Start, can_meet, can_return
from .physics import assert_lawful, curve

WORST = 1.001
"""No way on the grid takes the profile's time over this. What the grid costs (see `GRID`) is the test's own error."""

GRID = 1.08
"""But some way takes the profile's time times this; less with a finer grid. Without it the program might find none."""


class Case(NamedTuple):
    start: Start
    direction: float
    distance: float
    w: float
    u: float
    limits: Limits


def power(source: random.Random) -> float:
    return float(10.0 ** source.uniform(-1.0, 1.0))


KINDS = ("rest", "cruising", "any", "moving", "passing", "backing off")
"""Of cases: from rest to rest, from a velocity, from any state, joining a target, passing one far away or too near."""


def drawn(source: random.Random, kind: str) -> Case:
    """Draw limits up to 100 apart, a start inside, and a target some stopping distances away on either side."""
    limits = Limits(*(power(source) for _ in range(4)))
    vel, acc, dec, jerk = limits
    joins = kind in {"moving", "passing", "backing off"}
    while True:
        v = 0.0 if kind == "rest" else source.uniform(-vel, vel)
        a = source.uniform(-1.0, 1.0) * (acc if source.random() < 0.5 else dec) if kind == "any" or joins else 0.0
        rule = acc if v * a > 0.0 else dec
        reached = v + a * abs(a) / (2.0 * jerk)
        u = source.uniform(-vel, vel) if joins else 0.0
        direction = source.choice((-1.0, 1.0))
        signs = v * direction >= 0.0 >= direction * u if kind == "backing off" else v * u >= 0.0 <= direction * u
        if abs(a) <= rule and abs(reached) <= vel and reached * v >= 0.0 and signs:
            break
    w = u if kind == "moving" else 0.0
    near = gain(np.zeros((20, 5)), v, a, w, u, acc, dec, jerk)
    return Case(Start(v, a), direction, near + direction * power(source) * vel * vel / acc, w, u, limits)


def ours(case: Case) -> float:
    (v, a), _, distance, w, u, limits = case
    if u == 0.0:
        return plan_position(0.0, v, a, distance, limits).duration
    if w == 0.0:
        return plan_passing(0.0, v, a, distance, u, limits).duration
    return plan_synchronise(0.0, v, a, Moving(distance, u), limits).duration


def assert_optimal(case: Case, steps: int) -> None:
    time = ours(case)
    start, direction, distance, w, u, limits = case
    assert not can_meet(start, direction, distance, w, u, time / WORST, limits, steps), case
    assert can_meet(start, direction, distance, w, u, time * GRID, limits, steps), case


@pytest.mark.parametrize("kind", KINDS)
def test_one_is_as_quick_as_any_way(kind: str) -> None:
    source = random.Random(kind)
    assert_optimal(drawn(source, kind), 80)


def test_unequal_phases() -> None:
    # 44 s under D, then 5 s under both: with 200 steps the program's way is 3 % longer, with 800 only 0.1 %.
    limits = Limits(6.160290931455572, 7.464209674069866, 0.11103922947375991, 1.0393068680019601)
    assert_optimal(Case(Start(4.9139784854254085, 0.0), -1.0, 107.9160804739588, 0.0, 0.0, limits), 200)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_228_are_as_quick_as_any_way(kind: str) -> None:
    source = random.Random(f"slow {kind}")
    for _ in range(38):
        assert_optimal(drawn(source, kind), 200)


def outside(source: random.Random) -> tuple[Start, Limits]:
    """Draw a start that is too fast, or whose acceleration makes it so."""
    limits = Limits(*(power(source) for _ in range(4)))
    while True:
        v = limits.velocity * source.uniform(0.0, 3.0)
        a = source.uniform(-1.0, 1.0) * 3.0 * (limits.acceleration + limits.deceleration)
        if v + a * abs(a) / (2.0 * limits.jerk) > limits.velocity:
            return Start(v, a), limits


def test_way_back_to_the_velocity_limit_is_the_shortest() -> None:
    source = random.Random(1)
    for _ in range(examples(40)):
        start, limits = outside(source)
        profile = plan_position(0.0, *start, 1e6, limits)
        assert_lawful(profile, (0.0, *start), limits)
        t, _, v, _ = curve(profile.pieces)
        back = float(t[np.flatnonzero(v > limits.velocity * (1.0 + 1e-9))[-1]])
        allowed = time_back(*start, limits.velocity, limits.deceleration, limits.jerk)
        assert back <= allowed * (1.0 + 1e-9)
        assert can_return(start, limits.velocity, allowed * 1.01, limits, 300, 0.0), (start, limits)
        assert not can_return(start, limits.velocity, allowed * 0.99, limits, 300, 0.0), (start, limits)


def last_above(profile: Profile, velocity: float) -> float:
    """Return the last time at which v is above a velocity, to a thousandth of a piece."""
    rows = profile.pieces
    times = np.concatenate([np.linspace(t, end, 1000) for t, end in itertools.pairwise(rows[:, 0])])
    k = np.maximum(np.searchsorted(rows[:, 0], times, side="right") - 1, 0)
    s = times - rows[k, 0]
    v = rows[k, 2] + s * (rows[k, 3] + s * rows[k, 4] / 2.0)
    return float(times[np.flatnonzero(v > velocity)[-1]])


def test_a_stop_or_a_target_behind_is_back_below_the_velocity_limit_as_early_as_possible() -> None:
    # They lead on through the limit. How hard they may brake there, the way beyond says: to rest, or through v = 0 with
    # |a| <= min(A, D) to the velocity limit on the other side.
    source = random.Random(2)
    for _ in range(examples(25)):
        start, limits = outside(source)
        vel, acc, dec, jerk = limits
        behind = stop_displacement(*start, dec, jerk) - 1e6
        through = min((4.0 * jerk * vel) ** 0.5, (min(acc, dec) ** 2 + 2.0 * jerk * vel) ** 0.5)
        for profile, pull in (
            (plan_stop(0.0, *start, limits), (2.0 * jerk * vel) ** 0.5),
            (plan_position(0.0, *start, behind, limits), through),
        ):
            back = last_above(profile, vel)
            assert can_return(start, vel, back * 1.01, limits, 300, pull), (start, limits)
            assert not can_return(start, vel, back * 0.99, limits, 300, pull), (start, limits)


def test_acceleration_outside_is_taken_back_at_full_jerk_at_once() -> None:
    source = random.Random(3)
    for _ in range(200):
        limits = Limits(*(power(source) for _ in range(4)))
        sign = source.choice((-1.0, 1.0))
        v = source.uniform(-1.0, 1.0) * limits.velocity
        a = sign * (limits.acceleration + limits.deceleration) * source.uniform(1.0, 5.0)
        for target in (-1e5, 1e5):
            first = plan_position(0.0, v, a, target, limits).pieces[0]
            assert first[4] == -sign * limits.jerk
