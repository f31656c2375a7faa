"""Colours and letters, the same in both charts."""

from typing import Any, Final

from motionlayer.record._trace import Trace
from motionlayer.record.plot._series import axes_of

FONT: Final = "Inter, 'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', sans-serif"
INK: Final = "#1f2933"
SOFT: Final = "#7b8794"
GRID: Final = "#eceff2"
COLOURS: Final = ("#1f6fb4", "#d9772b", "#2f9163", "#8a5bb0", "#c2455a", "#2a9d9d", "#8c6d46", "#5b6b7b")
ALARM: Final = "#b4232a"
MARK_STYLES: Final = {
    "error": ("x", "✖", ALARM),
    "program failed": ("square", "■", ALARM),
    "fault": ("diamond", "◆", ALARM),
    "refused": ("triangle-down", "▼", "#c77700"),
    "warning": ("triangle-up", "▲", "#e8a93a"),
    "aborted": ("circle-open", "○", SOFT),
}
"""Symbol of plotly, the same as a letter, and colour of each kind of mark."""

STATE_COLOURS: Final = {
    1: "#d5dae0",
    2: "#eef1f4",
    3: "#cf3f3f",
    4: "#e8a93a",
    5: "#a596cf",
    6: "#8db9e2",
    7: "#84c7a3",
    8: "#56a8a8",
}


def colours(trace: Trace) -> dict[str, str]:
    """Return the colour of every axis, the same wherever it appears."""
    return {axis: COLOURS[n % len(COLOURS)] for n, axis in enumerate(axes_of(trace))}


def axis_style() -> dict[str, Any]:
    """Return how an axis of a chart looks."""
    return {
        "gridcolor": GRID,
        "linecolor": "#cbd2d9",
        "ticks": "outside",
        "ticklen": 4,
        "tickcolor": "#cbd2d9",
        "tickfont": {"size": 11, "color": SOFT},
        "zeroline": False,
        "exponentformat": "none",
        "separatethousands": True,
    }


def common() -> dict[str, Any]:
    """Return what the layouts of all charts have in common."""
    return {
        "template": "none",
        "paper_bgcolor": "white",
        "plot_bgcolor": "white",
        "font": {"family": FONT, "color": INK, "size": 12},
        "separators": ".\u2009",
        "hoverlabel": {"bgcolor": "rgba(255,255,255,0.94)", "bordercolor": "#cbd2d9", "font": {"size": 12}},
    }
