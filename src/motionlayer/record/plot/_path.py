"""The path in the plane."""

from collections.abc import Iterator
from typing import Any, Final, NamedTuple

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray

from motionlayer.record._trace import Trace
from motionlayer.record.plot._reduce import Floats, Indices, extent, follow
from motionlayer.record.plot._series import axes_of, places_of_rest, redefined, speed_along
from motionlayer.record.plot._style import SOFT, axis_style, common

SPEED_SCALE: Final = ((0.0, "#c3d7ea"), (0.3, "#7fb2dc"), (0.65, "#2f78b7"), (1.0, "#0b2f5b"))
SHADES: Final = 16
"""Steps of the colour scale: a line of plotly has one colour."""

REST: Final = "#d9772b"
PATH_POINTS: Final = 16_000
FINEST: Final = 2.0**-12
"""Tolerance of the path as a share of its extent: a third of a millimetre of a metre."""

MARGIN: Final = 0.03
"""Free space around the path as a share of its extent."""

LEFT_PIXELS, RIGHT_PIXELS = 68, 16
LEAST_HEIGHT, MOST_HEIGHT = 260, 720
"""Of the plane, px."""

TOP_PIXELS, BOTTOM_PIXELS = 64, 56


class PathChart(NamedTuple):
    """The figure, and its height in CSS: as high as equal scales need at the width of the page."""

    figure: go.Figure
    height: str


def path_chart(trace: Trace, plane: tuple[str, str]) -> PathChart:
    """Return the path of two axes in equal scales, coloured by speed, and its places of rest."""
    x, y = trace[f"{plane[0]}.set_position"], trace[f"{plane[1]}.set_position"]
    unit = axes_of(trace)[plane[0]]
    jumps = redefined(trace, *plane)
    chosen = np.unique(np.concatenate([_vertices(trace.time, x, y), jumps - 1, jumps]))
    strokes = _strokes(trace.time[chosen], x[chosen], y[chosen], unit, np.searchsorted(chosen, jumps))
    figure = go.Figure([*strokes, _places(x, y, unit, speed_along(x, y, trace.base_cycle, jumps))])
    x_range, y_range = _ranges(x, y)
    equal = {"scaleanchor": "x", "constrain": "domain", "constraintoward": "top"}
    figure.update_layout(
        **common(),
        margin={"l": LEFT_PIXELS, "r": RIGHT_PIXELS, "t": TOP_PIXELS, "b": BOTTOM_PIXELS},
        showlegend=False,
        hovermode="closest",
        xaxis={**_axis(plane[0], unit, x_range), "constrain": "domain", "constraintoward": "left"},
        yaxis={**_axis(plane[1], unit, y_range), **equal},
    )
    return PathChart(figure, _height(float(np.ptp(y_range) / np.ptp(x_range))))


def _height(ratio: float) -> str:
    """Return the height of a chart whose plane is `ratio` times as high as it is wide; 100cqw is the page's width."""
    outside = TOP_PIXELS + BOTTOM_PIXELS
    fitting = f"calc((100cqw - {LEFT_PIXELS + RIGHT_PIXELS}px) * {ratio:.6f} + {outside}px)"
    return f"clamp({LEAST_HEIGHT + outside}px, {fitting}, {MOST_HEIGHT + outside}px)"


def _vertices(time: Floats, x: Floats, y: Floats) -> Indices:
    whole = max(extent(x), extent(y))
    tolerance = FINEST * whole
    chosen = follow(time, [x, y], [tolerance, tolerance])
    while len(chosen) > PATH_POINTS and tolerance < whole:
        tolerance *= 2.0
        chosen = follow(time, [x, y], [tolerance, tolerance])
    return chosen


def _strokes(time: Floats, x: Floats, y: Floats, unit: str, jumps: Indices) -> Iterator[go.Scatter]:
    """Yield the colour bar and the segments of each shade, the slow ones first; none leads to a point of `jumps`."""
    speed = np.hypot(np.diff(x), np.diff(y)) / np.diff(time)
    speed[jumps - 1] = 0.0
    top = float(speed.max(initial=0.0)) or 1.0
    shade = np.minimum(speed / top * SHADES, SHADES - 1).astype(np.intp)
    yield _colour_bar(unit, top)
    x, y, time = (np.append(values, np.nan) for values in (x, y, time))
    for number in range(SHADES):
        rows = _joined(np.flatnonzero((shade == number) & (speed > 0.0)))
        yield go.Scatter(
            x=x[rows].astype(np.float32),
            y=y[rows].astype(np.float32),
            mode="lines",
            line={"color": _colour((number + 0.5) / SHADES), "width": 1, "simplify": False},
            opacity=0.7,
            customdata=time[rows].astype(np.float32),
            hovertemplate=f"%{{x:.2f}}, %{{y:.2f}} {unit}<br>{(number + 0.5) / SHADES * top:,.3g} {unit}/s"
            "<br>at %{customdata:.2f} s<extra></extra>",
        )


def _colour(share: float) -> str:
    """Return the colour of a speed, given as a share of the top speed."""
    knots = [knot for knot, _ in SPEED_SCALE]
    channels = np.array([list(bytes.fromhex(colour[1:])) for _, colour in SPEED_SCALE]).T
    return "#" + "".join(f"{round(np.interp(share, knots, channel)):02x}" for channel in channels)


def _joined(segments: Indices) -> Indices:
    """Return the vertices of segments, neighbours joined; -1 parts those that are not."""
    if not len(segments):
        return segments
    groups = np.split(segments, np.flatnonzero(np.diff(segments) > 1) + 1)
    return np.concatenate([np.append(group, [group[-1] + 1, -1]) for group in groups])


def _places(x: Floats, y: Floats, unit: str, speed: Floats) -> go.Scatter:
    places, counts = places_of_rest(x, y, speed)
    return go.Scatter(
        x=places[:, 0],
        y=places[:, 1],
        mode="markers",
        marker={"size": _sizes(counts), "color": REST, "line": {"color": "white", "width": 1}},
        customdata=counts,
        hovertemplate=f"at rest %{{customdata}} times<br>%{{x:.3f}}, %{{y:.3f}} {unit}<extra></extra>",
    )


def _sizes(counts: NDArray[np.int64]) -> Floats:
    """Return diameters whose areas grow with how often a place was visited, px."""
    return np.minimum(6.0 * np.sqrt(counts), 16.0)


def _colour_bar(unit: str, top: float) -> go.Scatter:
    """Return a curve without points that carries the colour bar."""
    return go.Scatter(
        x=[None, None],
        y=[None, None],
        mode="markers",
        hoverinfo="skip",
        marker={
            "color": [0.0, top],
            "colorscale": SPEED_SCALE,
            "colorbar": {
                "title": {"text": f"speed in {unit}/s", "font": {"size": 12, "color": SOFT}, "side": "top"},
                "orientation": "h",
                "thickness": 8,
                "len": 260,
                "lenmode": "pixels",
                "x": 0.0,
                "xanchor": "left",
                "xpad": 0,
                "y": 1.0,
                "yanchor": "bottom",
                "ypad": 4,
                "nticks": 5,
                "outlinewidth": 0,
                "tickfont": {"size": 11, "color": SOFT},
                "separatethousands": True,
            },
        },
    )


def _ranges(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Return least and greatest of both coordinates with a margin, never nothing."""
    margin = MARGIN * max(extent(x), extent(y)) or 1.0
    return np.array([x.min() - margin, x.max() + margin]), np.array([y.min() - margin, y.max() + margin])


def _axis(name: str, unit: str, span: Floats) -> dict[str, Any]:
    text = f"{name} in {unit}" if unit else name
    return {**axis_style(), "range": span.tolist(), "title": {"text": text, "font": {"size": 12}, "standoff": 12}}
