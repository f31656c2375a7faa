"""The table of key figures: how far, how fast, and what share of its limits that was, per axis."""

from html import escape
from typing import Final

import numpy as np

from motionlayer.record._trace import Trace
from motionlayer.record.plot._series import KeyFigures, Peak, axes_of, key_figures
from motionlayer.record.plot._style import ALARM

THIN_SPACE: Final = "\u2009"
NONE: Final = "<span class=soft>–</span>"  # noqa: RUF001 - the dash of a table cell
ALMOST: Final = 1.0 + 1e-6
"""A share of a limit above this is shown in red; below it is rounding."""

COLUMNS: Final = (
    "Moves",
    "Travel",
    "Range",
    "Peak velocity",
    "Peak acceleration",
    "Peak deceleration",
    "Peak jerk",
)


def table(trace: Trace, colour: dict[str, str]) -> str:
    """Return the table as HTML, a row per axis.

    Args:
        trace: whose axes.
        colour: by axis.
    """
    head = "".join(f"<th>{title}</th>" for title in COLUMNS)
    rows = [_row(axis, unit, key_figures(trace, axis), colour[axis]) for axis, unit in axes_of(trace).items()]
    shown = f"<table><thead><tr><th>Axis</th>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"
    note = "<div class=small>Bars and percentages: share of the limit that was in force at the peak.</div>"
    return f"<div class=scroll>{shown}</div>{note if 'class=bar' in shown else ''}"


def _row(axis: str, unit: str, figures: KeyFigures, colour: str) -> str:
    travel, span = figures.travel, figures.span
    cells = [
        f"<span class=dot style='background:{colour}'></span>{escape(axis)}",
        grouped(figures.moves, 0),
        NONE if travel is None else _quantity(travel, unit),
        NONE if span is None else f"{number(span[0])} … {number(span[1])}{_unit(unit)}",
        _peak(figures.velocity, f"{unit}/s", colour),
        _peak(figures.acceleration, f"{unit}/s²", colour),
        _peak(figures.deceleration, f"{unit}/s²", colour),
        _peak(figures.jerk, f"{unit}/s³", colour),
    ]
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def _peak(peak: Peak | None, unit: str, colour: str) -> str:
    """A value, and below it the share of its limit as a bar; what exceeds its limit is red."""
    if peak is None:
        return NONE
    text = _quantity(peak.value, unit)
    if np.isnan(peak.share):
        return text
    over = peak.share > ALMOST
    fill = ALARM if over else colour
    share = f"<span class='{'warn' if over else 'share'}'>{peak.share:.0%}</span>"
    width = min(peak.share, 1.0) * 100.0
    return f"{text}<div class=bar><i style='width:{width:.1f}%;background:{fill}'></i></div>{share}"


def _quantity(value: float, unit: str) -> str:
    return f"{number(value)}{_unit(unit)}"


def _unit(unit: str) -> str:
    return f" <span class=unit>{escape(unit)}</span>" if unit else ""


def number(value: float) -> str:
    """Four significant digits, never an exponent below a million million, thousands apart."""
    if value == 0.0 or not np.isfinite(value):
        return f"{value:g}"
    digits = max(0, 3 - int(np.floor(np.log10(abs(value)))))
    text = grouped(value, min(digits, 9))
    return text.rstrip("0").rstrip(".") if "." in text else text


def grouped(value: float, digits: int) -> str:
    """A number with so many digits behind the point, thousands apart."""
    return f"{value:,.{digits}f}".replace(",", THIN_SPACE)
