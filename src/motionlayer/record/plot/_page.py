"""The page around the charts."""

import re
from html import escape
from pathlib import Path
from typing import Any, Final

import numpy as np

from motionlayer.record._errors import TraceError
from motionlayer.record._trace import Trace
from motionlayer.record.plot._curves import MOST_AXES
from motionlayer.record.plot._events import grave_entries, marks_of
from motionlayer.record.plot._figures import grouped, number, table
from motionlayer.record.plot._series import (
    STATES,
    axes_of,
    column,
    moves,
    opening,
    plane_of,
)
from motionlayer.record.plot._style import ALARM, FONT, MARK_STYLES, STATE_COLOURS, colours

SUFFIXES: Final = (".html", ".htm")
MOST_ENTRIES: Final = 20
"""Errors and warnings that are listed."""

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
        table(trace, colours(trace)),
    ]
    if plane is not None and all(moves(trace, axis) for axis in plane):
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
        f"{number(len(trace.ticks) * trace.base_cycle)} s",
        f"{grouped(len(trace.ticks), 0)} ticks of {number(trace.base_cycle * 1e3)} ms",
        f"{grouped(len(trace.events), 0)} events",
        escape(str(trace.header.get("product", ""))),
    ]
    digest = f"<div class='soft mono'>{escape(trace.hash)}</div>" if trace.hash else ""
    return f"<div class=soft>{' · '.join(fact for fact in facts if fact)}</div>{digest}{_warning(trace)}"


def _warning(trace: Trace) -> str:
    """Say what is wrong with the trace itself."""
    if trace.gaps:
        lost = grouped(sum(gap.ticks for gap in trace.gaps), 0)
        first = grouped(trace.gaps[0].first, 0)
        return f"<div class=warn>{lost} ticks are missing, from tick {first} on: the writer did not keep up.</div>"
    if trace.complete:
        return ""
    if trace.damage:
        return f"<div class=warn>The file is damaged: {escape(trace.damage)}. Shown is what was read.</div>"
    end = f"{grouped(float(trace.time[-1]), 3)} s, tick {grouped(int(trace.ticks[-1]), 0)}"
    return f"<div class=warn>Incomplete: the writer of the trace was cut short. The recording ends at {end}.</div>"


def _stretch(trace: Trace) -> str:
    """Say so if the plots do not open on the whole run."""
    start, end = opening(trace)
    whole = float(trace.time[-1] - trace.time[0])
    if end - start > 0.99 * whole:
        return ""
    shown = f"{number(start)} to {number(end)} s of {number(whole)} s"
    return f"<div class=small>Opened at {shown}; a double-click shows the whole run.</div>"


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
    """List errors, then warnings; what was said more than once stands there once."""
    entries = grave_entries(trace)
    if not entries:
        return ""
    rows = "".join(
        f"<tr><td>{entry.event.tick * trace.base_cycle:.6f} s</td><td>{entry.event.level.name.lower()}</td>"
        f"<td>{escape(entry.line(trace.base_cycle))}</td></tr>"
        for entry in entries[:MOST_ENTRIES]
    )
    more = f"<div class=small>and {grouped(len(entries) - MOST_ENTRIES, 0)} more</div>"
    return f"<h2>Errors and warnings</h2><table class=list>{rows}</table>{more if len(entries) > MOST_ENTRIES else ''}"


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
