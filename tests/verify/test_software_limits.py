"""Software limits: the exceptions are as wide as the legal motion, and no wider."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.record import Plan, Trace
from motionlayer.verify import assert_valid, verify
from motionlayer.verify._curves import Curves
from motionlayer.verify._stops import stops

from .bench import DISCRETE, STOPPING, Bench
from .planner import Floats, Limits, roll, to_stop, to_velocity

MAXIMA = Limits(100.0, 1000.0, 1000.0, 20_000.0)
WEAK = Limits(100.0, 1000.0, 200.0, 20_000.0)


def _rules(trace: Trace) -> set[str]:
    return {finding.rule for finding in verify(trace).findings}


def _turning() -> tuple[Bench, Floats]:
    """Return an axis that turns round without rest, shortly before, and the shortest stop from there."""
    bench = Bench(maxima=MAXIMA)
    bench.enable()
    bench.move_velocity(50.0)
    bench.run()
    bench.accept()
    pieces = np.array(roll(bench.now, [(0.05, -20_000.0), (0.05, 0.0), (0.05, 20_000.0)]))
    pieces[-1, 2:4] = -50.0, 0.0
    bench._plan("velocity", -50.0, pieces)
    while bench.now[1] > 26.0:
        bench.run(1)
    return bench, to_stop(bench.now, MAXIMA)


def _turn(bench: Bench) -> float:
    """Return where the axis would turn: as far as its motion comes."""
    pieces = bench.plans[-1].pieces
    times = np.linspace(0.0, pieces[-1, 0], 20_000)
    k = np.searchsorted(pieces[:, 0], times, side="right") - 1
    t, p, v, a, j = pieces[k].T
    s = times - t
    return float((p + s * (v + s * (a / 2 + s * j / 6))).max())


def _stopped(bench: Bench, pieces: Floats, limits: Limits, limit: float) -> Trace:
    bench.soft = (None, limit)
    for row in bench.rows:
        row[11] = limit
    bench.limits = limits
    bench.accept()
    bench.state = STOPPING
    bench._plan("stop", math.nan, pieces)
    bench.run()
    bench.run(2)
    return bench.trace()


def test_a_stop_may_cross_the_limit_where_the_motion_would_just_have_turned() -> None:
    bench, pieces = _turning()
    limit = _turn(bench) + 1e-6
    assert pieces[-1, 1] > limit + 0.01
    assert_valid(_stopped(bench, pieces, MAXIMA, limit))


def test_a_stop_that_dawdles_over_the_limit_is_found() -> None:
    """It takes the acceleration back with the full jerk, and then brakes with a fifth of what it may."""
    bench, _ = _turning()
    limit = _turn(bench) + 1e-6
    trace = _stopped(bench, to_velocity(bench.now, 0.0, WEAK), MAXIMA, limit)
    assert _rules(trace) == {"planned stop", "software limit"}


def test_a_stop_weaker_than_the_motion_before_it_does_not_cross_the_limit() -> None:
    bench, _ = _turning()
    limit = _turn(bench) + 1e-6
    weak = _rules(_stopped(bench, to_stop(bench.now, WEAK), WEAK, limit))
    assert weak == {"software limit", "command limits"}


def test_a_profile_that_began_outside_does_not_excuse_what_takes_over_inside() -> None:
    """Its first piece lies before the tick of the plan: the offset tells how long ago it would have begun."""
    bench = Bench(maxima=MAXIMA, soft=(None, 5.0))
    bench.enable()
    bench.accept()
    bench.state = DISCRETE
    move = np.array(roll((0.0, 0.0, 0.0), [(0.02, 20_000.0), (0.02, -20_000.0), (0.02, -20_000.0), (0.02, 20_000.0)]))
    move[-1, 2:4] = 0.0, 0.0
    move[:, 0] += 1.0
    before = [0.0, 50.0, -50.0, 0.0, 0.0]
    bench._plan("position", float(move[-1, 1]), move - [1.0, 0.0, 0.0, 0.0, 0.0])
    bench.soft = (None, 0.9 * float(move[-1, 1]))
    for row in bench.rows:
        row[11] = bench.soft[1] or 0.0
    bench.run()
    bench.run(2)
    trace = bench.trace()
    assert _rules(trace) == {"software limit"}
    plan = bench.plans[-1]
    bench.plans[-1] = Plan(
        plan.axis, plan.tick, 1.0, plan.command, plan.kind, plan.target, plan.velocity, plan.acceleration,
        plan.deceleration, plan.jerk, np.array([before, *move.tolist()]),
    )  # fmt: skip
    assert "software limit" in _rules(bench.trace())


def test_from_outside_a_move_does_not_go_out_again() -> None:
    bench = Bench(maxima=MAXIMA, soft=(None, 5.0), start=8.0)
    bench.enable()
    for target in (4.0, 7.0, 3.0):  # in, out again but not as far as it began, and in
        bench.move(target)
        bench.run()
    assert _rules(bench.trace()) == {"software limit"}


@given(st.floats(-100.0, 100.0), st.floats(-1500.0, 1500.0), st.floats(50.0, 2000.0), st.floats(500.0, 1e5))
def test_the_shortest_stop_in_closed_form(v: float, a: float, most: float, jerk: float) -> None:
    """Against one that is rolled phase by phase."""
    pieces = to_stop((0.0, v, a), Limits(100.0, 1e9, most, jerk))
    plan = Plan("X", 0, 0.0, 1, "stop", math.nan, 100.0, most, most, jerk, pieces)
    curves = Curves([plan], 0.001)
    shortest = stops(curves, curves.deceleration, curves.jerk)
    times = np.linspace(0.0, pieces[-1, 0], 2000)
    point = curves.at(np.zeros(2000, np.int64), times)
    way = np.abs(point.p).max() + 1e-9
    assert shortest.rest[0] == pytest.approx(pieces[-1, 1], rel=1e-9, abs=1e-9 * way)
    for sign in (-1.0, 1.0):
        outwards = sign * point.v > 1e-9
        furthest = (sign * point.p)[outwards].max() if outwards.any() else -math.inf
        assert float(shortest.furthest(sign)[0]) >= furthest - 1e-9 * way
        if outwards.any():
            assert float(shortest.furthest(sign)[0]) <= furthest + 2e-3 * way + 1e-9
