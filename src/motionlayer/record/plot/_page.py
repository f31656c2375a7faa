"""The page around the charts."""

import re
from html import escape
from pathlib import Path
from typing import Any, Final

import numpy as np

from motionlayer.record._errors import TraceError
from motionlayer.record._trace import Trace
from motionlayer.record.plot._curves import MOST_AXES
from motionlayer.record.plot._events import grave_events, marks_of
from motionlayer.record.plot._series import (
    STATES,
    KeyFigures,
    Peak,
    axes_of,
    column,
    key_figures,
    opening,
    plane_of,
)
from motionlayer.record.plot._style import ALARM, FONT, MARK_STYLES, STATE_COLOURS, colours

SUFFIXES: Final = (".html", ".htm")
THIN_SPACE: Final = "\u2009"
NONE: Final = "<span class=soft>–</span>"  # noqa: RUF001 - the dash of a table cell
ALMOST: Final = 1.0 + 1e-6
"""A share of a limit above this is shown in red; below it is rounding."""

MOST_EVENTS: Final = 20
"""Errors and warnings that are listed, the first ones."""

COLUMNS: Final = (
    "Moves",
    "Travel",
    "Range",
    "Peak velocity",
    "Peak acceleration",
    "Peak deceleration",
    "Peak jerk",
)
STYLE: Final = """
body { margin: 0; background: #fff; color: #1f2933; font: 14px/1.45 %(font)s; }
main { max-width: 1240px; margin: 0 auto; padding: 40px 36px 60px; container-type: inline-size; }
h1 { font-size: 30px; font-weight: 600; letter-spacing: -0.015em; margin: 0 0 2px; }
h2 { font-size: 15px; font-weight: 600; margin: 44px 0 10px; } h2 + .small { margin-top: -6px; }
.soft { color: #7b8794; } .mono { font: 12px ui-monospace, Menlo, 'DejaVu Sans Mono', monospace; }
.small { color: #7b8794; font-size: 12px; } .warn { color: %(alarm)s; font-weight: 600; }
.scroll { overflow-x: auto; margin-top: 28px; }
table { border-collapse: collapse; width: 100%%; font-variant-numeric: tabular-nums; }
th { text-align: right; font-weight: 500; font-size: 12px; color: #7b8794; padding: 0 0 6px 18px; }
td { text-align: right; padding: 8px 0 8px 18px; border-top: 1px solid #eceff2; vertical-align: top;
     white-space: nowrap; }
th:first-child, td:first-child { text-align: left; padding-left: 0; font-weight: 600; }
.unit { color: #7b8794; font-size: 12px; }
.bar { height: 3px; background: #eceff2; margin-top: 5px; border-radius: 2px; overflow: hidden; }
.bar i { display: block; height: 100%%; } .share { color: #7b8794; font-size: 11px; }
.dot { display: inline-block; width: 10px; height: 10px; border-radius: 5px; margin-right: 8px; }
.chip { display: inline-block; margin-right: 18px; font-size: 12px; }
.chip i { display: inline-block; width: 22px; height: 10px; margin-right: 6px; border-radius: 2px; }
.rangeslider-mask-min, .rangeslider-mask-max { fill: #fff !important; fill-opacity: 0.72 !important; }
.rangeslider-mask-min-opp-axis, .rangeslider-mask-max-opp-axis { display: none; }
.rangeslider-handle-min, .rangeslider-handle-max { fill: #1f2933 !important; stroke: none !important; }
.list { font-size: 13px; } .list th, .list td { text-align: left; padding: 4px 24px 4px 0; font-weight: 400; }
.list td:last-child { width: 100%%; padding-right: 0; white-space: normal; }
footer { margin-top: 36px; font-size: 12px; color: #7b8794; }
@media (max-width: 900px) {
  main { padding: 24px 20px 40px; }
  th, td { padding-left: 8px; } td { font-size: 12px; } .unit, .share { font-size: 10px; } th { font-size: 11px; }
}
"""


def write_page(trace: Trace, path: str | Path) -> None:
    """Draw a trace into one HTML file.

    Args:
        trace: with at least one row and one signal named `<axis>.<signal>`.
        path: ends in `.html`; replaced if it exists.

    Raises:
        TraceError: the suffix is another, there is nothing to draw, or the file cannot be written.
    """
    path = Path(path)
    if path.suffix.lower() not in SUFFIXES:
        raise TraceError(
            f"{path}: pages are written as .html only; name it {path.stem}.html, open it in a browser, and "
            f"save pictures from there with the camera button of a chart"
        )
    if not axes_of(trace) or not len(trace.ticks):
        raise TraceError(f"{path}: {trace!r} holds no rows of an axis; record signals such as X.set_position")
    try:
        path.write_text(_page(trace), encoding="utf-8")
    except OSError as error:
        raise TraceError(f"{path}: the page cannot be written: {error.strerror}; name another file") from error


def _page(trace: Trace) -> str:
    from plotly.offline import get_plotlyjs  # noqa: PLC0415 - a second to import, and only here

    from motionlayer.record.plot import _path, _time  # noqa: PLC0415

    name = escape(_name(trace))
    plane = plane_of(trace)
    over_time = _time.time_chart(trace)
    parts = [
        f"<!doctype html><html lang=en><head><meta charset=utf-8><title>{name}</title>",
        f"<style>{STYLE % {'font': FONT, 'alarm': ALARM}}</style><script>{get_plotlyjs()}</script></head>",
        "<body><main>",
        f"<h1>{name}</h1>{_subtitle(trace)}",
        _table(trace, colours(trace)),
    ]
    if plane is not None:
        parts += [
            f"<h2>Path in the plane {escape(plane[0])}, {escape(plane[1])}</h2>",
            _chart("path", trace, *_path.path_chart(trace, plane)),
        ]
    if over_time is not None:
        parts += [
            f"<h2>Over time</h2>{_stretch(trace)}",
            _chart("over_time", trace, over_time.figure),
            _key(trace),
        ]
    parts += [_events(trace), _footer(trace, over_time.note if over_time else ""), "</main></body></html>"]
    return "\n".join(parts)


def _name(trace: Trace) -> str:
    return str((trace.header.get("machine") or {}).get("name") or "Trace")


def _subtitle(trace: Trace) -> str:
    facts = [
        f"{_number(len(trace.ticks) * trace.base_cycle)} s",
        f"{_grouped(len(trace.ticks), 0)} ticks of {_number(trace.base_cycle * 1e3)} ms",
        f"{_grouped(len(trace.events), 0)} events",
        escape(str(trace.header.get("product", ""))),
    ]
    digest = f"<div class='soft mono'>{escape(trace.hash)}</div>" if trace.hash else ""
    return f"<div class=soft>{' · '.join(fact for fact in facts if fact)}</div>{digest}{_warning(trace)}"


def _warning(trace: Trace) -> str:
    """Say what is wrong with the trace itself."""
    if trace.gaps:
        lost = _grouped(sum(gap.ticks for gap in trace.gaps), 0)
        first = _grouped(trace.gaps[0].first, 0)
        return f"<div class=warn>{lost} ticks are missing, from tick {first} on: the writer did not keep up.</div>"
    if trace.complete:
        return ""
    if trace.damage:
        return f"<div class=warn>The file is damaged: {escape(trace.damage)}. Shown is what was read.</div>"
    end = f"{_grouped(float(trace.time[-1]), 3)} s, tick {_grouped(int(trace.ticks[-1]), 0)}"
    return f"<div class=warn>Incomplete: the writer of the trace was cut short. The recording ends at {end}.</div>"


def _stretch(trace: Trace) -> str:
    """Say so if the plots do not open on the whole run."""
    start, end = opening(trace)
    whole = float(trace.time[-1] - trace.time[0])
    if end - start > 0.99 * whole:
        return ""
    shown = f"{_number(start)} to {_number(end)} s of {_number(whole)} s"
    return f"<div class=small>Opened at {shown}; a double-click shows the whole run.</div>"


def _table(trace: Trace, colour: dict[str, str]) -> str:
    head = "".join(f"<th>{title}</th>" for title in COLUMNS)
    rows = [_row(axis, unit, key_figures(trace, axis), colour[axis]) for axis, unit in axes_of(trace).items()]
    table = f"<table><thead><tr><th>Axis</th>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"
    note = "<div class=small>Bars and percentages: share of the limit that was in force at the peak.</div>"
    return f"<div class=scroll>{table}</div>{note if 'class=bar' in table else ''}"


def _row(axis: str, unit: str, figures: KeyFigures, colour: str) -> str:
    travel, span = figures.travel, figures.span
    cells = [
        f"<span class=dot style='background:{colour}'></span>{escape(axis)}",
        _grouped(figures.moves, 0),
        NONE if travel is None else _quantity(travel, unit),
        NONE if span is None else f"{_number(span[0])} … {_number(span[1])}{_unit(unit)}",
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


def _key(trace: Trace) -> str:
    """Name the colours of the states and the marks of the events, as far as they occur."""
    columns = [column(trace, axis, "state") for axis in axes_of(trace)]
    present = {int(state) for values in columns if values is not None for state in np.unique(values)}
    chips = [
        f"<span class=chip><b style='color:{MARK_STYLES[kind][2]}'>{MARK_STYLES[kind][1]}</b> {kind}</span>"
        for kind in marks_of(trace)
    ]
    chips += [
        f"<span class=chip><i style='background:{STATE_COLOURS[state]}'></i>{name}</span>"
        for state, name in STATES.items()
        if state in present
    ]
    return f"<div style='padding-left:84px'>{''.join(chips)}</div>" if chips else ""


def _events(trace: Trace) -> str:
    """List the first errors and warnings."""
    events = grave_events(trace)
    if not events:
        return ""
    rows = "".join(
        f"<tr><td>{event.tick * trace.base_cycle:.6f} s</td><td>{event.level.name.lower()}</td>"
        f"<td>{escape(event.source)}</td><td>{escape(event.text)}</td></tr>"
        for event in events[:MOST_EVENTS]
    )
    more = f"<div class=small>and {_grouped(len(events) - MOST_EVENTS, 0)} more</div>"
    return f"<h2>Errors and warnings</h2><table class=list>{rows}</table>{more if len(events) > MOST_EVENTS else ''}"


def _chart(name: str, trace: Trace, figure: Any, height: str = "100%") -> str:  # noqa: ANN401 - plotly has no types
    """Return a chart as HTML; `height` in CSS counts where the figure has none of its own."""
    config = {
        "displaylogo": False,
        "responsive": True,
        "scrollZoom": False,
        "modeBarButtons": [["toImage", "zoom2d", "pan2d", "resetScale2d"]],
        "toImageButtonOptions": {"format": "svg", "filename": re.sub(r"\W+", "_", f"{_name(trace)}_{name}")},
    }
    # A name of its own: plotly would else draw one by lot, and no two pages of a trace were equal.
    html = figure.to_html(full_html=False, include_plotlyjs=False, config=config, div_id=name, default_height=height)
    return str(html)


def _footer(trace: Trace, note: str) -> str:
    notes = [
        "Drag to zoom, or the ends of the strip; double-click for the whole run and back; click a name to hide it.",
        note,
    ]
    if len(axes_of(trace)) > MOST_AXES:
        notes.append(f"The first {MOST_AXES} of {len(axes_of(trace))} axes are drawn.")
    return f"<footer>{' '.join(notes)}</footer>"


def _quantity(value: float, unit: str) -> str:
    return f"{_number(value)}{_unit(unit)}"


def _unit(unit: str) -> str:
    return f" <span class=unit>{escape(unit)}</span>" if unit else ""


def _number(value: float) -> str:
    """Four significant digits, never an exponent below a million million, thousands apart."""
    if value == 0.0 or not np.isfinite(value):
        return f"{value:g}"
    digits = max(0, 3 - int(np.floor(np.log10(abs(value)))))
    text = _grouped(value, min(digits, 9))
    return text.rstrip("0").rstrip(".") if "." in text else text


def _grouped(value: float, digits: int) -> str:
    return f"{value:,.{digits}f}".replace(",", THIN_SPACE)
