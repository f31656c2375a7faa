"""Limits on the exact curves, on the way back inside, and of the position."""

import math
from dataclasses import replace

import numpy as np
import pytest

from motionlayer.record import Trace
from motionlayer.verify import assert_valid, verify

from .bench import HOMING, SEARCH, STOPPING, Bench
from .planner import Floats, Limits, roll, to_velocity, travel

MAXIMA = Limits(100.0, 1000.0, 2000.0, 50_000.0)


def _rules(trace: Trace) -> set[str]:
    return {finding.rule for finding in verify(trace).findings}


def _run(kind: str, pieces: Floats, target: float, limits: Limits = MAXIMA, **start: Floats) -> Trace:
    """Record one plan from rest, or after a first one that is given as `before`."""
    bench = Bench(maxima=MAXIMA)
    bench.enable()
    if "before" in start:
        bench.accept()
        bench.state = 7
        bench._plan("velocity", float(start["before"][-1, 2]), start["before"])
        bench.run(round(float(pieces[0, 0]) / bench.dt))
    bench.accept()
    bench.state = {"position": 6, "velocity": 7, "stop": STOPPING}[kind]
    bench.limits = limits
    moved = pieces - [pieces[0, 0], 0.0, 0.0, 0.0, 0.0]
    moved[:, 1] += bench.now[0] - moved[0, 1]
    moved[0, 1:4] = bench.now
    bench._plan(kind, target, moved)
    bench.run(round((moved[-1, 0] + 0.005) / bench.dt))
    return bench.trace()


def _move(limits: Limits) -> Floats:
    return np.array(roll((0.0, 0.0, 0.0), travel(40.0, limits)))


def _settled(pieces: Floats, target: float | None = None) -> Floats:
    pieces[-1, 2:4] = 0.0 if target is None else target, 0.0
    return pieces


@pytest.mark.parametrize(
    ("limit", "rules"),
    [
        ("velocity", {"planned velocity", "sampled limit"}),
        ("acceleration", {"planned acceleration"}),
        ("deceleration", {"planned acceleration", "sampled limit"}),
        ("jerk", {"planned jerk", "sample step"}),
    ],
)
def test_a_move_above_one_limit(limit: str, rules: set[str]) -> None:
    pieces = _settled(_move(replace(MAXIMA, **{limit: 1.01 * getattr(MAXIMA, limit)})))
    assert _rules(_run("position", pieces, pieces[-1, 1])) == rules
    pieces = _settled(_move(replace(MAXIMA, **{limit: 0.99 * getattr(MAXIMA, limit)})))
    assert_valid(_run("position", pieces, pieces[-1, 1]))


def test_a_peak_between_two_samples() -> None:
    # From 2 to 12 ms at 100.0005 mm/s or more only within 0.4 ms around 10.2 ms: between the samples at 10 and 11.
    rise = math.sqrt(100.0 / MAXIMA.jerk)
    phases = [(rise, MAXIMA.jerk), (rise + 1e-4, -MAXIMA.jerk), (1e-4, MAXIMA.jerk)]
    limit = replace(MAXIMA, acceleration=3000.0)
    pieces = np.array(roll((0.0, 0.0, 0.0), phases))
    peak = 100.0
    pieces[-1, 2:4] = pieces[-1, 2], 0.0
    trace = _run("velocity", pieces, float(pieces[-1, 2]), replace(limit, velocity=peak - 1e-5))
    assert "planned velocity" in _rules(trace)
    assert "sampled limit" not in _rules(trace)


def _reversal(strength: float) -> Floats:
    """Go from +80 to -80 with a constant acceleration through zero."""
    up, t = 1000.0, strength / MAXIMA.jerk
    rise = [(up / MAXIMA.jerk, MAXIMA.jerk), (0.08 - up / MAXIMA.jerk, 0.0), (up / MAXIMA.jerk, -MAXIMA.jerk)]
    turn = [(t, -MAXIMA.jerk), (160.0 / strength - t, 0.0), (t, MAXIMA.jerk)]
    return _settled(np.array(roll((0.0, 0.0, 0.0), [*rise, (0.01, 0.0), *turn])), -80.0)


def test_a_reversal_passes_zero_within_both_limits() -> None:
    assert_valid(_run("velocity", _reversal(1000.0), -80.0))
    assert _rules(_run("velocity", _reversal(1100.0), -80.0)) == {"planned acceleration"}


CRUISE = np.array(roll((0.0, 0.0, 0.0), [(0.02, 50_000.0), (0.06, 0.0), (0.02, -50_000.0)]))
"""To 80 mm/s in 0.1 s; a = 1000 mm/s² in the middle."""
LOWERED = replace(MAXIMA, velocity=50.0)


def _after(time: float, phases: list[tuple[float, float]], v: float, a: float) -> Floats:
    return np.array(roll((0.0, v, a), phases, time))


def test_back_inside_lowered_limits_by_the_straight_way() -> None:
    t = math.sqrt(30.0 / 50_000.0)
    pieces = _settled(_after(0.12, [(t, -50_000.0), (t, 50_000.0)], 80.0, 0.0), 50.0)
    assert_valid(_run("velocity", pieces, 50.0, LOWERED, before=_settled(CRUISE.copy(), 80.0)))


def test_dawdling_outside_lowered_limits() -> None:
    t = math.sqrt(30.0 / 50_000.0)
    pieces = _settled(_after(0.12, [(0.01, 0.0), (t, -50_000.0), (t, 50_000.0)], 80.0, 0.0), 50.0)
    trace = _run("velocity", pieces, 50.0, LOWERED, before=_settled(CRUISE.copy(), 80.0))
    assert _rules(trace) == {"planned velocity"}


@pytest.mark.parametrize(("share", "rules"), [(1.0, set()), (0.5, {"planned velocity", "sampled limit"})])
def test_growing_outside_only_while_the_acceleration_is_taken_back(share: float, rules: set[str]) -> None:
    relent = 1000.0 / (50_000.0 * share)
    v = 50.0 + 1000.0 * relent / 2
    t = math.sqrt((v - 50.0) / 50_000.0)
    phases = [(relent, -50_000.0 * share), (t, -50_000.0), (t, 50_000.0)]
    pieces = _settled(_after(0.06, phases, 50.0, 1000.0), 50.0)
    trace = _run("velocity", pieces, 50.0, LOWERED, before=_settled(CRUISE.copy(), 80.0))
    assert _rules(trace) == rules


@pytest.mark.parametrize(("share", "rules"), [(1.0, set()), (0.5, {"planned acceleration"})])
def test_a_lowered_acceleration_limit_is_approached_with_full_jerk(share: float, rules: set[str]) -> None:
    relent = 1000.0 / (50_000.0 * share)
    target = 50.0 + 1000.0 * relent / 2
    pieces = _settled(_after(0.06, [(relent, -50_000.0 * share)], 50.0, 1000.0), target)
    weaker = replace(MAXIMA, acceleration=500.0)
    trace = _run("velocity", pieces, target, weaker, before=_settled(CRUISE.copy(), 80.0))
    assert _rules(trace) == rules


def test_a_stop_that_does_not_brake() -> None:
    t = math.sqrt(80.0 / 50_000.0)
    brake = [(t, -50_000.0), (t, 50_000.0)]
    before = _settled(CRUISE.copy(), 80.0)
    pieces = _settled(_after(0.12, brake, 80.0, 0.0))
    assert_valid(_run("stop", pieces, math.nan, before=before))
    pieces = _settled(_after(0.12, [(0.01, 0.0), *brake], 80.0, 0.0))
    assert _rules(_run("stop", pieces, math.nan, before=before)) == {"planned stop"}


def test_software_limits() -> None:
    bench = Bench(soft=(-1.0, 5.0))
    bench.enable()
    bench.move(5.0)
    bench.run()
    assert_valid(bench.trace())
    bench.move(5.001)
    bench.run()
    assert _rules(bench.trace()) == {"software limit"}


def test_outside_the_software_limits_the_way_leads_back() -> None:
    bench = Bench(soft=(-1.0, 5.0), start=8.0)
    bench.enable()
    bench.move(2.0)
    bench.run()
    assert_valid(bench.trace())
    bench = Bench(soft=(-1.0, 5.0), start=8.0)
    bench.enable()
    bench.move(9.0)
    bench.run()
    assert _rules(bench.trace()) == {"software limit"}


def test_homing_and_redefining_may_leave_the_software_limits() -> None:
    bench = Bench(soft=(-1.0, 5.0))
    bench.enable()
    bench.home(7.0)
    bench.run()
    bench.run(3)
    assert_valid(bench.trace())
    bench.accept("home(position=0.0)")
    bench.state = HOMING
    bench.limit(velocity=SEARCH)
    bench._plan("velocity", SEARCH, to_velocity(bench.now, SEARCH, bench.maxima))
    bench.run(60)
    assert bench.now[0] > 8.0
    assert_valid(bench.trace())
    bench.stop()
    bench.run()
    bench.run(3)
    assert_valid(bench.trace())
