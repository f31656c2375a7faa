"""Signals over time: the whole run as a strip to choose a stretch in, and below it the panels of that stretch."""

from collections.abc import Iterator
from html import escape
from textwrap import wrap
from typing import Any, Final, NamedTuple

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray

from motionlayer.record._trace import Trace
from motionlayer.record.plot._curves import UNITS, Curve, curves_of, drawn_axes, unit_of
from motionlayer.record.plot._events import Mark, error_stops, mark_rows, marks_of
from motionlayer.record.plot._layout import layout
from motionlayer.record.plot._reduce import Indices, reduce, steps, thin
from motionlayer.record.plot._series import ERROR_STOP, STATES, Run, axes_of, column, opening, state_runs
from motionlayer.record.plot._style import INK, MARK_STYLES, STATE_COLOURS, colours

ALL_POINTS: Final = 160_000
"""Points of all curves together: about two megabytes of the page."""

SINGLE_TICKS: Final = 1 << 20
"""So many ticks are told apart in single precision, which halves the times in the page."""

STRIP_POINTS: Final = 24_000
LIMIT_POINTS: Final = 500
ALL_RUNS: Final = 9000
MARK_LETTERS, MARK_LINES = 60, 4
"""So much of the text of an event is shown at its mark, letters in a line and lines."""


class TimeChart(NamedTuple):
    """The figure, and what must be said about the number of its points ("" if nothing was left out)."""

    figure: go.Figure
    note: str


def time_chart(trace: Trace) -> TimeChart | None:
    """Return what moves, what happened and the states over one time axis, as far as recorded."""
    curves = curves_of(trace)
    drawn = {curve.panel for curve in curves}
    panels = [panel for panel in UNITS if panel in drawn]
    stated = [axis for axis in drawn_axes(trace) if column(trace, axis, "state") is not None]
    if not panels and not stated:
        return None
    figure = go.Figure()
    anchors = layout(figure, trace, panels, {"events": mark_rows(trace), "state": stated})
    rows, note = _rows(trace, curves)
    shown: set[str] = set()
    for curve, selected in zip(curves, rows, strict=True):
        figure.add_trace(_line(trace, curve, selected, anchors[curve.panel], shown))
    figure.add_traces([_strip(trace, curve) for curve in curves if _in_strip(curve)])
    figure.add_traces([_marks(kind, marks, anchors["events"]) for kind, marks in marks_of(trace).items()])
    figure.add_traces(list(_bars(trace, stated, anchors.get("state", ""))))
    figure.add_traces(list(_error_stops(trace, stated, anchors.get("state", ""))))
    return TimeChart(figure, note)


def _rows(trace: Trace, curves: list[Curve]) -> tuple[list[Indices], str]:
    """Choose the rows at which each curve is drawn, and say how."""
    signals = [curve for curve in curves if curve.kind != "limit"]
    first, last = np.searchsorted(trace.time, opening(trace))
    columns = [curve.values for curve in signals]
    reduced = reduce(trace.time, columns, ALL_POINTS, np.arange(first, min(last + 1, len(trace.time))))
    chosen = iter(reduced.rows)
    rows = [steps(curve.values, LIMIT_POINTS) if curve.kind == "limit" else next(chosen) for curve in curves]
    if all(len(kept) == len(trace.time) for kept in reduced.rows):
        return rows, ""
    note = (
        "To keep the page small, the curves leave out ticks that lie on the line anyway: they pass every recorded "
        f"value within {reduced.tolerance:.2%} of their range"
    )
    if reduced.thinned:
        restless = f"{reduced.thinned} of {len(signals)} curves change too fast for that"
        note += f". {restless} and show the highest and lowest value of short spans"
    return rows, f"{note}. The table at the top is made from every tick."


def _line(trace: Trace, curve: Curve, selected: Indices, anchor: str, shown: set[str]) -> go.Scatter:
    colour = colours(trace)[curve.axis]
    group, name, line, visible = {
        "solid": (curve.axis, curve.axis, {"color": colour, "width": 1.5}, True),
        "actual": ("actual", "actual", {"color": colour, "width": 1.2, "dash": "dot"}, True),
        "limit": ("limits", "limits in force", {"color": colour, "width": 1, "dash": "dash"}, "legendonly"),
    }[curve.kind]
    first = group not in shown
    shown.add(group)
    unit = unit_of(curve.panel, axes_of(trace)[curve.axis])
    label = curve.axis if curve.kind == "solid" else f"{curve.axis} {name}"
    x, y = _polyline(trace, curve, selected)
    return go.Scatter(
        x=x,
        y=y,
        xaxis="x2",
        yaxis=anchor,
        mode="lines",
        # Plotly's own simplification tilts long rests.
        line={**line, "shape": "hv" if curve.kind == "limit" else "linear", "simplify": False},
        name=name,
        legendgroup=group,
        legendrank=1000 if curve.kind == "solid" else 1001,
        showlegend=first,
        visible=visible,
        hovertemplate=f"{label} {curve.panel} %{{y:,.5~g}} {unit}<extra></extra>",
    )


def _polyline(trace: Trace, curve: Curve, rows: Indices) -> tuple[NDArray[np.floating[Any]], NDArray[np.float32]]:
    """Return times and values of a curve; where ticks are missing the line is broken."""
    jumps = trace.jumps
    rows = np.unique(np.concatenate([rows, jumps, jumps + 1])) if len(jumps) else rows
    times = trace.time[rows].astype(np.float32 if trace.ticks[-1] < SINGLE_TICKS else np.float64)
    values = curve.values[rows].astype(np.float32)
    behind = np.searchsorted(rows, jumps, side="right")
    return np.insert(times, behind, np.nan), np.insert(values, behind, np.nan)


def _in_strip(curve: Curve) -> bool:
    return curve.panel == "position" and curve.kind == "solid"


def _strip(trace: Trace, curve: Curve) -> go.Scatter:
    """Return the whole run of a position, for the strip."""
    selected = thin(curve.values, min(2400, STRIP_POINTS // len(drawn_axes(trace))))
    x, y = _polyline(trace, curve, selected)
    return go.Scatter(
        x=x,
        y=y,
        mode="lines",
        line={"color": colours(trace)[curve.axis], "width": 0.8},
        legendgroup=curve.axis,
        showlegend=False,
        hoverinfo="skip",
    )


def _bars(trace: Trace, axes: list[str], anchor: str) -> Iterator[go.Bar]:
    """Yield the times of each state of each axis."""
    for axis in axes:
        runs = state_runs(trace, axis, ALL_RUNS // len(axes))
        for state in sorted({run.state for run in runs}):
            yield _bar(axis, state, [run for run in runs if run.state == state], anchor)


def _bar(axis: str, state: int, runs: list[Run], anchor: str) -> go.Bar:
    return go.Bar(
        base=np.array([run.start for run in runs]),
        x=np.array([run.end - run.start for run in runs]),
        y=[axis] * len(runs),
        xaxis="x2",
        yaxis=anchor,
        orientation="h",
        marker={"color": STATE_COLOURS.get(state, INK), "line": {"width": 0}},
        hovertemplate=f"{axis} {STATES.get(state, str(state))}<extra></extra>",
        showlegend=False,
    )


def _error_stops(trace: Trace, axes: list[str], anchor: str) -> Iterator[go.Scatter]:
    """Yield a mark at the beginning of each ErrorStop: one of a single tick is too narrow to be seen as a bar."""
    for axis in axes:
        times = error_stops(trace, axis)
        if times:
            yield go.Scatter(
                x=times,
                y=[axis] * len(times),
                xaxis="x2",
                yaxis=anchor,
                mode="markers",
                marker={"symbol": "line-ns", "size": 18, "line": {"width": 3, "color": STATE_COLOURS[ERROR_STOP]}},
                hoverinfo="skip",
                showlegend=False,
            )


def _marks(kind: str, marks: list[Mark], anchor: str) -> go.Scatter:
    symbol, _, colour = MARK_STYLES[kind]
    return go.Scatter(
        x=[mark.time for mark in marks],
        y=[mark.row for mark in marks],
        xaxis="x2",
        yaxis=anchor,
        mode="markers",
        marker={"symbol": symbol, "size": 9, "color": colour, "line": {"width": 1.5 if "open" in symbol else 0}},
        text=[_wrapped(f"{kind}: {mark.text}") for mark in marks],
        showlegend=False,
        hovertemplate="%{text}<extra></extra>",
    )


def _wrapped(text: str) -> str:
    return "<br>".join(escape(line) for line in wrap(text, MARK_LETTERS, max_lines=MARK_LINES, placeholder=" …"))
