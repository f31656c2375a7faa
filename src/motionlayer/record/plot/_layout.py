"""Panels over one time axis, from the top: the strip of the whole run, the curves, the events, the states."""

from html import escape
from typing import Any, Final

import numpy as np
import plotly.graph_objects as go

from motionlayer.record._trace import Trace
from motionlayer.record.plot._curves import UNITS, unit_of
from motionlayer.record.plot._series import axes_of, opening
from motionlayer.record.plot._style import SOFT, axis_style, common

PIXELS: Final = {"position": 230, "lag": 110, "velocity": 170, "acceleration": 170, "jerk": 140, "override": 80}
ROW_PIXELS: Final = {"events": 20, "state": 22}
"""Panels of rows, one below another, and the height of each row."""

GAP_PIXELS: Final = 24
STRIP_PIXELS, STRIP_GAP_PIXELS = 60, 54
TOP_PIXELS, BOTTOM_PIXELS = 40, 46
SLIDER_SHIFT: Final = 18
"""Plotly draws a range slider so much below its axis, px; a few of them depend on the height of the chart."""

MOST_TICKS: Final = 8
NO_HEIGHT: Final = 1.0 / 256.0
"""Share of the height that the panel of the strip takes: with less, plotly takes all or shows what lies outside."""

MOST_LETTERS: Final = 9
"""Of the name of a row: more would run into the title of its panel."""

HIDDEN: Final = {"showgrid": False, "showline": False, "showticklabels": False, "ticks": "", "zeroline": False}


def layout(figure: go.Figure, trace: Trace, panels: list[str], rows: dict[str, list[str]]) -> dict[str, str]:
    """Stack the panels of curves and those of rows, given by their names; return the name of the y axis of each."""
    heights = {panel: PIXELS[panel] for panel in panels}
    heights |= {panel: ROW_PIXELS[panel] * len(names) + 8 for panel, names in rows.items() if names}
    strip = STRIP_PIXELS + STRIP_GAP_PIXELS if "position" in panels else 0
    inner = strip + sum(heights.values()) + GAP_PIXELS * (len(heights) - 1)
    anchors = {}
    top = float(inner - strip)
    for number, (panel, pixels) in enumerate(heights.items(), 2):
        anchors[panel] = f"y{number}"
        domain = (max(top - pixels, 0.0) / inner, top / inner)
        style = _row_axis(panel, rows[panel]) if panel in rows else _y_axis(panel, _unit(trace, panel))
        figure.update_layout({f"yaxis{number}": {**style, "domain": domain}})
        top -= pixels + GAP_PIXELS
    figure.update_layout(
        **common(),
        height=inner + TOP_PIXELS + BOTTOM_PIXELS,
        margin={"l": 84, "r": 16, "t": TOP_PIXELS, "b": BOTTOM_PIXELS},
        hovermode="x unified",
        hoversubplots="axis",
        hoverdistance=3,
        barmode="overlay",
        bargap=0.3,
        legend={"orientation": "h", "x": 0, "y": 1, "yanchor": "bottom", "font": {"size": 13}},
        xaxis2=_x_axis(trace, list(anchors.values())[-1]),
    )
    if strip:
        _add_strip(figure, trace, inner)
    return anchors


def _unit(trace: Trace, panel: str) -> str:
    units = sorted({unit for unit in axes_of(trace).values() if unit})
    return ", ".join(dict.fromkeys(unit_of(panel, unit) for unit in units)) or UNITS[panel].lstrip("/")


def _x_axis(trace: Trace, anchor: str) -> dict[str, Any]:
    return {
        **axis_style(),
        "anchor": anchor,
        "title": {"text": "time in s", "font": {"size": 12, "color": SOFT}, "standoff": 8},
        "range": opening(trace),
        "minallowed": float(trace.time[0]),
        "maxallowed": max(float(trace.time[-1]), float(trace.time[0]) + trace.base_cycle),
        "hoverformat": ",.4~f",
        "showspikes": True,
        "spikemode": "across",
        "spikesnap": "cursor",
        "spikethickness": 1,
        "spikedash": "solid",
        "spikecolor": "#9aa5b1",
    }


def _add_strip(figure: go.Figure, trace: Trace, inner: int) -> None:
    """Add the strip: a range slider draws what belongs to its axis, whose own panel has no height."""
    start, end = float(trace.time[0]), float(trace.time[-1])
    figure.update_layout(
        xaxis={
            "anchor": "y",
            "matches": "x2",
            **HIDDEN,
            "rangeslider": {
                "visible": True,
                "range": (start, end),
                "yaxis": {"rangemode": "auto"},
                "thickness": STRIP_PIXELS / inner,
                "bgcolor": "white",
                "bordercolor": "#dfe4e9",
                "borderwidth": 1,
            },
        },
        # Nothing of the curves lies in this range: they are seen in the slider only.
        yaxis={"domain": (1.0 - NO_HEIGHT, 1.0), "range": (1e200, 2e200), "fixedrange": True, **HIDDEN},
    )
    for time in _round_times(start, end):
        figure.add_annotation(
            x=(time - start) / (end - start),
            y=1.0 - (STRIP_PIXELS + SLIDER_SHIFT + 2) / inner,
            xref="paper",
            yref="paper",
            yanchor="top",
            text=f"{time:,.6g} s".replace(",", "\u2009"),
            showarrow=False,
            font={"size": 11, "color": SOFT},
        )


def _round_times(start: float, end: float) -> list[float]:
    """Return round times between two, one, two or five of a power of ten apart."""
    if end <= start:
        return []
    least = (end - start) / MOST_TICKS
    power = 10.0 ** np.floor(np.log10(least))
    step = next(step for step in (power, 2.0 * power, 5.0 * power, 10.0 * power) if step >= least)
    return [float(time) for time in np.arange(np.ceil(start / step), np.floor(end / step) + 1.0) * step]


def _y_axis(panel: str, unit: str) -> dict[str, Any]:
    text = f"{panel}<br><span style='color:{SOFT};font-size:11px'>{unit}</span>"
    return {
        **axis_style(),
        "title": _title(text),
        "zeroline": panel != "position",
        "zerolinecolor": "#cbd2d9",
        "zerolinewidth": 1,
        "nticks": 6 if PIXELS[panel] > 100 else 4,
    }


def _row_axis(panel: str, names: list[str]) -> dict[str, Any]:
    return {
        **axis_style(),
        "title": _title(panel),
        "type": "category",
        "categoryorder": "array",
        "categoryarray": names,
        "tickvals": names,
        "ticktext": [escape(_short(name)) for name in names],
        "range": (len(names) - 0.5, -0.5),
        "showgrid": False,
        "fixedrange": True,
        "ticks": "",
    }


def _short(name: str) -> str:
    name = name.removeprefix("program ")
    return name if len(name) <= MOST_LETTERS else f"{name[: MOST_LETTERS - 1]}…"


def _title(text: str) -> dict[str, Any]:
    return {"text": text, "font": {"size": 12}, "standoff": 6}
