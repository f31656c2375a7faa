"""Which curves of a trace are drawn over time, and in which panel."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from motionlayer.record._trace import Trace
from motionlayer.record.plot._reduce import Floats
from motionlayer.record.plot._series import axes_of, column

MOST_AXES: Final = 24
UNITS: Final = {"position": "", "lag": "", "velocity": "/s", "acceleration": "/s²", "jerk": "/s³", "override": "%"}
"""Panels in order, and what their unit adds to that of the axis; % stands alone."""

LAG_SHARE: Final = 1e-9
"""A lag below this share of the positions is rounding, and not drawn."""

LIMITS: Final = (
    ("max_velocity", "velocity", 1.0),
    ("max_velocity", "velocity", -1.0),
    ("max_acceleration", "acceleration", 1.0),
    ("max_deceleration", "acceleration", -1.0),
    ("max_jerk", "jerk", 1.0),
    ("max_jerk", "jerk", -1.0),
)


@dataclass(frozen=True)
class Curve:
    """What is drawn of an axis in a panel; kind "solid", "actual" or "limit"."""

    panel: str
    axis: str
    values: Floats
    kind: str = "solid"


def drawn_axes(trace: Trace) -> list[str]:
    """Return the axes that are drawn over time, in order."""
    return list(axes_of(trace))[:MOST_AXES]


def unit_of(panel: str, axis_unit: str) -> str:
    """Return the unit of what is drawn of an axis in a panel."""
    return UNITS[panel] if panel == "override" else axis_unit + UNITS[panel]


def curves_of(trace: Trace) -> list[Curve]:
    """Return what is drawn over time, as far as it was recorded."""
    curves = []
    for axis in drawn_axes(trace):
        for panel in ("position", "velocity", "acceleration", "jerk"):
            values = column(trace, axis, f"set_{panel}")
            if values is not None:
                curves.append(Curve(panel, axis, values))
        override = column(trace, axis, "override")
        if override is not None and (override != 1.0).any():
            curves.append(Curve("override", axis, 100.0 * override))
        curves += _actual(axis, column(trace, axis, "set_position"), column(trace, axis, "actual_position"))
        for limit, panel, sign in LIMITS:
            values = column(trace, axis, limit)
            if values is not None:
                curves.append(Curve(panel, axis, sign * values, "limit"))
    return curves


def _actual(axis: str, position: Floats | None, actual: Floats | None) -> list[Curve]:
    if actual is None:
        return []
    if position is None:
        return [Curve("position", axis, actual, "actual")]
    lag = position - actual
    if np.abs(lag).max() <= LAG_SHARE * np.abs(position).max():
        return []
    return [Curve("position", axis, actual, "actual"), Curve("lag", axis, lag)]
