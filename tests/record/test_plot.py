import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from motionlayer.record import Trace, TraceWriter
from motionlayer.record.plot import write_page
from motionlayer.record.plot._figures import number
from motionlayer.record.plot._layout import MOST_TICKS, _round_times
from motionlayer.record.plot._path import SPEED_SCALE, _colour, _joined, path_chart
from motionlayer.record.plot._reduce import COARSEST, FINEST, Reduced, extent, follow, reduce, steps, thin
from motionlayer.record.plot._series import (
    Run,
    axes_of,
    key_figures,
    opening,
    places_of_rest,
    plane_of,
    redefined,
    speed_along,
    state_runs,
)
from tests.effort import examples

from .samples import Floats, header, plan

VALUES = arrays.arrays(np.float64, st.integers(1, 500), elements=st.floats(-1e9, 1e9))


def trace_of(columns: dict[str, list[float]], **other: Any) -> Trace:
    writer = TraceWriter(None, header(list(columns), **other))
    writer.rows(0, np.array(list(columns.values())).T)
    writer.close(len(next(iter(columns.values()))), "")
    return Trace.from_chunks(writer.chunks)


@settings(max_examples=examples(100), deadline=None)
@given(values=VALUES, points=st.integers(2, 200))
def test_thinning_keeps_ends_and_extremes(values: Floats, points: int) -> None:
    chosen = thin(values, points)
    assert (np.diff(chosen) > 0).all()
    assert (chosen[0], chosen[-1]) == (0, len(values) - 1)
    assert (values[chosen].min(), values[chosen].max()) == (values.min(), values.max())
    assert len(chosen) <= max(points, 2) + 4


@settings(max_examples=examples(200), deadline=None)
@given(
    values=arrays.arrays(np.float64, st.integers(1, 200), elements=st.integers(-9, 9)), tolerance=st.floats(0.0, 5.0)
)
def test_a_curve_is_followed_within_its_tolerance(values: Floats, tolerance: float) -> None:
    time = np.sqrt(np.arange(len(values), dtype=np.float64))
    kept = follow(time, [values, -3.0 * values], [tolerance, 3.0 * tolerance])
    assert (kept[0], kept[-1]) == (0, len(values) - 1)
    assert (np.diff(kept) > 0).all()
    deviation = np.abs(np.interp(time, time[kept], values[kept]) - values)
    assert deviation.max() <= tolerance + 1e-12


def test_corners_are_enough_for_straight_lines() -> None:
    values = np.concatenate([np.zeros(100), np.arange(1.0, 101.0), np.full(100, 100.0)])
    assert follow(np.arange(300.0), [values], [1e-9]).tolist() == [0, 99, 199, 299]


@pytest.mark.parametrize("hole", [np.nan, np.inf])
def test_no_line_leads_across_what_is_not_finite(hole: float) -> None:
    values = np.zeros(9)
    values[4] = hole
    assert follow(np.arange(9.0), [values], [1.0]).tolist() == [0, 3, 4, 5, 8]
    assert (extent(values), extent(values[4:5])) == (0.0, 0.0)


def smooth_and_noise() -> tuple[Floats, Floats, Floats]:
    time = np.linspace(0.0, 10.0, 10_000)
    return time, np.sin(time), np.random.default_rng(1).normal(size=len(time))


def test_smooth_curves_are_drawn_as_finely_as_the_points_allow() -> None:
    time, smooth, _ = smooth_and_noise()
    stretch = np.arange(200, 300)
    fine = reduce(time, [smooth, 5.0 * smooth], 2000, stretch)
    assert (fine.tolerance, fine.thinned) == (FINEST, 0)
    assert set(stretch) <= set(fine.rows[1])
    coarse = reduce(time, [smooth], len(fine.rows[0]) - len(stretch) - 1, stretch[:0])
    assert coarse.tolerance > FINEST
    deviation = np.abs(np.interp(time, time[coarse.rows[0]], smooth[coarse.rows[0]]) - smooth)
    assert deviation.max() <= coarse.tolerance * np.ptp(smooth)


def test_only_noise_is_thinned_and_least_in_the_stretch() -> None:
    time, smooth, noise = smooth_and_noise()
    reduced = reduce(time, [smooth, noise], 2000, np.arange(500, 900))
    assert (reduced.tolerance, reduced.thinned) == (COARSEST, 1)
    assert sum(map(len, reduced.rows)) <= 2000
    rows = reduced.rows[1]
    assert (noise[rows].min(), noise[rows].max()) == (noise.min(), noise.max())
    assert set(range(500, 900)) <= set(rows)


def test_nothing_to_reduce() -> None:
    assert reduce(np.zeros(1), [], 10, np.arange(1)) == Reduced([], FINEST, 0)


def opened(moves: list[int], states: list[float]) -> tuple[float, float]:
    writer = TraceWriter(None, header(["X.state"]))
    for tick in moves:
        writer.plan(plan("X", tick, 1))
    writer.rows(0, np.array([states]).T)
    return opening(Trace.from_chunks(writer.chunks))


def test_the_charts_open_on_the_moves_after_homing() -> None:
    states = [2.0] * 50 + [5.0] * 50 + [2.0] * 15_900
    assert opened([10, 60, *range(200, 2000, 100)], states) == pytest.approx((0.192, 1.008))
    assert opened([*range(200, 2000, 100)], [2.0] * 16_000) == pytest.approx((0.192, 1.008))


def test_the_charts_open_on_everything_if_the_run_is_short() -> None:
    assert opened([*range(200, 2000, 100)], [2.0] * 15_000) == pytest.approx((0.0, 14.999))


def test_the_charts_open_on_everything_if_there_are_few_moves() -> None:
    assert opened([200, 300], [2.0] * 20_000) == (0.0, 19.999)
    assert opened([*range(1000, 19_000, 1600)], [2.0] * 20_000) == (0.0, 19.999)
    assert opened([], [5.0] * 20_000) == pytest.approx((0.0, 19.999))


@settings(max_examples=examples(50), deadline=None)
@given(values=arrays.arrays(np.float64, st.integers(1, 300), elements=st.sampled_from([0.0, 1.0, 2.0])))
def test_steps_can_be_drawn_from_their_changes(values: Floats) -> None:
    chosen = steps(values, 1000)
    held = values[chosen][np.searchsorted(chosen, np.arange(len(values)), side="right") - 1]
    np.testing.assert_array_equal(held, values)


def test_steps_that_change_all_the_time_are_thinned() -> None:
    assert len(steps(np.arange(10_000.0) % 2, 100)) <= 104


def test_key_figures() -> None:
    columns = {
        "X.set_position": [0.0, 1.0, 3.0, 2.5],
        "X.set_velocity": [0.0, 2.0, -4.0, 0.0],
        "X.set_acceleration": [5.0, 3.0, 6.0, 0.0],
        "X.max_velocity": [8.0, 5.0, 2.0, 2.0],
        "X.max_acceleration": [10.0] * 4,
        "X.max_deceleration": [24.0] * 4,
    }
    figures = key_figures(trace_of(columns), "X")
    assert (figures.travel, figures.span) == (3.5, (0.0, 3.0))
    assert figures.velocity == (4.0, 0.8)  # under the limit of the row before
    assert figures.acceleration == (5.0, 0.5)
    assert figures.deceleration == (6.0, 0.25)
    assert figures.jerk is None


def test_a_limit_that_is_unknown_or_zero_gives_no_share() -> None:
    assert np.isnan(key_figures(trace_of({"X.set_velocity": [1.0]}), "X").velocity.share)  # type: ignore[union-attr]
    stopped = {"X.set_velocity": [1.0], "X.max_velocity": [0.0]}
    assert np.isnan(key_figures(trace_of(stopped), "X").velocity.share)  # type: ignore[union-attr]


def test_moves_are_commands_not_plans() -> None:
    writer = TraceWriter(None, header(["X.set_position"]))
    for axis, tick, command in (("X", 0, 1), ("X", 5, 1), ("X", 9, 2), ("Y", 9, 3), ("X", 12, 0)):
        writer.plan(plan(axis, tick, command))
    writer.rows(0, np.zeros((20, 1)))
    assert key_figures(Trace.from_chunks(writer.chunks), "X").moves == 2


def test_states_become_runs() -> None:
    trace = trace_of({"X.state": [1.0, 2.0, 2.0, 6.0]})
    assert state_runs(trace, "X", 100) == [Run(1, 0.0, 0.001), Run(2, 0.001, 0.003), Run(6, 0.003, 0.004)]


def test_too_many_states_are_sampled() -> None:
    assert len(state_runs(trace_of({"X.state": [2.0, 6.0] * 5000}), "X", 1500)) == 1500


@pytest.mark.parametrize(
    ("axes", "plane"),
    [
        ("A X Y", ("X", "Y")),
        ("Y A X", ("X", "Y")),
        ("X1 Y1 X2 Y2", ("X1", "Y1")),
        ("A B", None),
        ("X", None),
        ("x y", None),
        ("X Y1", None),
    ],
)
def test_the_plane(axes: str, plane: tuple[str, str] | None) -> None:
    assert plane_of(trace_of({f"{axis}.set_position": [0.0] for axis in axes.split()})) == plane


@pytest.mark.parametrize(("other", "plane"), [("mm", ("X", "Y")), ("°", None)])
def test_the_plane_has_equal_units(other: str, plane: tuple[str, str] | None) -> None:
    signals = [
        {"name": f"{axis}.set_position", "unit": unit, "resolution": 0.0} for axis, unit in (("X", "mm"), ("Y", other))
    ]
    trace = Trace.from_chunks(TraceWriter(None, {"base_cycle_ns": 1, "signals": signals}).chunks)
    assert plane_of(trace) == plane
    assert axes_of(trace) == {"X": "mm", "Y": other}


def test_strokes_join_neighbours() -> None:
    assert _joined(np.array([0, 1, 4])).tolist() == [0, 1, 2, -1, 4, 5, -1]
    assert len(_joined(np.empty(0, np.intp))) == 0


def test_shades_lie_on_the_scale() -> None:
    assert [_colour(share) for share, _ in SPEED_SCALE] == [colour for _, colour in SPEED_SCALE]


@given(start=st.floats(0.0, 1e6), span=st.floats(1e-3, 1e6))
def test_round_times(start: float, span: float) -> None:
    times = _round_times(start, start + span)
    assert 1 <= len(times) <= MOST_TICKS + 1
    slack = 1e-9 * (start + span)
    assert start - slack <= min(times) <= max(times) <= start + span + slack


def test_no_span_has_no_times() -> None:
    assert _round_times(1.0, 1.0) == []


def test_places_of_rest_are_counted() -> None:
    x = np.array([0.0, 0.0, 1.0, 2.0, 2.0, 1.0, 0.0, 0.0])
    speed = np.array([0.0, 0.0, 5.0, 5.0, 0.0, 5.0, 5.0, 0.0])
    places, counts = places_of_rest(x, np.zeros(8), speed)
    assert places.tolist() == [[0.0, 0.0], [2.0, 0.0]]
    assert counts.tolist() == [2, 1]


def homed() -> Trace:
    """Return a trace of X, Y in which homing gives X another coordinate: 1 mm/s all the time, and a jump of 50 mm."""
    x, y = np.arange(20.0) * 1e-3, np.zeros(20)
    x[10:] += 50.0
    y[5:] = 3.0
    writer = TraceWriter(None, header(["X.set_position", "Y.set_position"]))
    writer.plan(replace(plan(tick=10), kind="set"))
    writer.rows(0, np.array([x, y]).T)
    writer.close(20, "")
    return Trace.from_chunks(writer.chunks)


def test_a_position_that_is_redefined_is_no_motion() -> None:
    trace = homed()
    x, y = trace["X.set_position"], trace["Y.set_position"] * 0.0
    assert redefined(trace, "X", "Y").tolist() == [10]
    assert redefined(trace, "Y").tolist() == []
    assert key_figures(trace, "X").travel == pytest.approx(0.018)
    assert speed_along(x, y, 1e-3, redefined(trace, "X")) == pytest.approx(np.ones(20))
    figure = path_chart(trace, ("X", "Y")).figure
    for curve in figure.data[1:-1]:
        ends = np.abs(np.diff(np.asarray(curve.x, np.float64)))
        assert not (ends > 1.0).any(), "no line leads from the old coordinate to the new one"


def test_no_path_is_drawn_of_an_axis_that_never_moves(tmp_path: Path) -> None:
    for still in ("X", "Y", ""):
        columns = {f"{axis}.set_position": [0.0, 0.0 if axis == still else 1.0] for axis in "XY"}
        write_page(trace_of(columns), tmp_path / "x.html")
        assert ("Path in the plane" in (tmp_path / "x.html").read_text(encoding="utf-8")) == (not still)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (1234567.8, "1\u2009234\u2009568"),
        (12.3456, "12.35"),
        (0.00012345, "0.0001234"),
        (-5.0, "-5"),
        (np.inf, "inf"),
    ],
)
def test_numbers_for_people(value: float, text: str) -> None:
    assert number(value) == text


def test_the_face_of_the_package_does_without_plotly() -> None:
    code = "import sys, json, motionlayer.record; print(json.dumps('plotly' in sys.modules))"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
    assert json.loads(found.stdout) is False
