"""What the page says beside its curves: events, override, states, damage."""

import re
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from plotly.offline import get_plotlyjs

from motionlayer.event import Event, Kind, Level
from motionlayer.record import Trace, TraceError, TraceWriter
from motionlayer.record.plot import write_page
from motionlayer.record.plot._curves import curves_of, unit_of
from motionlayer.record.plot._events import MOST_MARKS, MOST_SOURCES, OTHERS, error_stops, mark_rows, marks_of
from motionlayer.record.plot._path import _height
from motionlayer.record.plot._time import MARK_LETTERS, MARK_LINES, _wrapped, time_chart

from .samples import gantry, header

EVENTS = [
    Event(0, Level.VERBOSE, Kind.ACCEPTED, "X", "X.move", 0, 1),
    Event(1, Level.VERBOSE, Kind.ABORTED, "X", "X.move by X.stop", 0, 1),
    Event(1, Level.WARNING, Kind.REFUSED, "Y", "Y.move: <i>outside</i>", 0x4222, 2),
    Event(2, Level.ERROR, Kind.ERROR, "X", "lag too large", 0x4550, 3),
    Event(2, Level.ERROR, Kind.MESSAGE, "X", "drive fault"),
    Event(3, Level.WARNING, Kind.MESSAGE, "Y", "hot"),
    Event(3, Level.INFO, Kind.MESSAGE, "Y", "warm"),
    Event(4, Level.ERROR, Kind.ERROR, "program pick", "ValueError: boom", 0, 4),
    Event(4, Level.INFO, Kind.DONE, "program place", "ended", 0, 5),
]


def trace_of(
    events: list[Event], columns: dict[str, list[float]] | None = None, rest: bytes = b"", **other: Any
) -> Trace:
    columns = columns or {"X.set_position": [0.0] * 6, "Y.set_position": [0.0] * 6}
    writer = TraceWriter(None, header(list(columns), **other))
    for event in events:
        writer.event(event)
    block = np.array(list(columns.values())).T
    writer.rows(0, block)
    writer.close(len(block), "")
    return Trace.from_chunks([*writer.chunks, *([rest] if rest else [])])


def page_of(trace: Trace, folder: Path) -> str:
    """Return the page without the library in it."""
    write_page(trace, folder / "x.html")
    return re.sub(r"<script>/\*\*.*?</script>", "", (folder / "x.html").read_text(), count=1, flags=re.DOTALL)


def drawn(trace: Trace) -> list[Any]:
    chart = time_chart(trace)
    assert chart is not None
    return list(chart.figure.data)


def test_what_went_wrong_or_was_cut_short_is_marked() -> None:
    trace = trace_of(EVENTS)
    marks = marks_of(trace)
    found = {kind: [(round(mark.time * 1000), mark.row) for mark in group] for kind, group in marks.items()}
    assert found == {
        "error": [(2, "X")],
        "program failed": [(4, "program pick")],
        "fault": [(2, "X")],
        "refused": [(1, "Y")],
        "warning": [(3, "Y")],
        "aborted": [(1, "X")],
    }
    assert mark_rows(trace) == ["X", "Y", "program pick"]
    assert list(marks_of(trace_of(EVENTS[:1]))) == []


def test_marks_say_what_happened() -> None:
    hovers = {
        text
        for curve in drawn(trace_of(EVENTS))
        if curve.type == "scatter" and curve.mode == "markers"
        for text in curve.text or ()
    }
    assert hovers == {
        "aborted: X.move by X.stop", "refused: Y.move: &lt;i&gt;outside&lt;/i&gt;", "error: X: lag too large",
        "fault: X: drive fault", "warning: Y: hot", "program failed: program pick: ValueError: boom",
    }  # fmt: skip


def test_long_texts_are_wrapped() -> None:
    lines = _wrapped("far too long " * 100).split("<br>")
    assert len(lines) == MARK_LINES
    assert max(map(len, lines)) <= MARK_LETTERS
    assert lines[-1].endswith(" …")


def test_many_sources_share_a_row_and_many_marks_are_thinned() -> None:
    many = [Event(n % 6, Level.ERROR, Kind.ERROR, f"program p{n}", "x", 0, n + 1) for n in range(3 * MOST_MARKS)]
    trace = trace_of([EVENTS[1], *many])
    rows = mark_rows(trace)
    assert (len(rows), rows[0], rows[-1]) == (MOST_SOURCES, "X", OTHERS)
    marks = marks_of(trace)["program failed"]
    assert len(marks) == MOST_MARKS
    assert {mark.row for mark in marks} <= set(rows)


def test_errors_and_warnings_are_listed_at_the_end(tmp_path: Path) -> None:
    page = page_of(trace_of(EVENTS), tmp_path)
    rows = re.findall(r"<tr><td>([\d.]+) s</td><td>(\w+)</td><td>([^<]+)</td></tr>", page)
    assert rows == [
        ("0.002000", "error", "X: lag too large"),
        ("0.002000", "error", "X: drive fault"),
        ("0.004000", "error", "program pick: ValueError: boom"),
        ("0.001000", "warning", "Y.move: &lt;i&gt;outside&lt;/i&gt;"),
        ("0.003000", "warning", "Y: hot"),
    ]
    assert page.index("Over time") < page.index("Errors and warnings") < page.index("<footer>")
    assert "program failed</span>" in page
    assert " more</div>" not in page


def test_a_flood_of_warnings_is_one_line_and_hides_no_error(tmp_path: Path) -> None:
    late = [Event(n, Level.WARNING, Kind.MESSAGE, "runtime", f"{n} ticks late; programs, {n}.5 ms") for n in range(99)]
    page = page_of(trace_of([*late, Event(100, Level.ERROR, Kind.MESSAGE, "X", "drive fault", 0x4650)]), tmp_path)
    rows = re.findall(r"<td>(error|warning)</td><td>([^<]+)</td></tr>", page)
    assert rows == [
        ("error", "X: drive fault"),
        ("warning", "runtime: 0 ticks late; programs, 0.5 ms (99 times, the last at 0.098000 s)"),
    ]


def test_a_message_of_the_layer_is_listed_with_its_subdevice_and_number(tmp_path: Path) -> None:
    event = Event(5, Level.ERROR, Kind.MESSAGE, "GVL_AXIS.Ctrl[1]", " : PROGRESS_ERROR", 0x4650, 0, 14001, 1003)
    page = page_of(trace_of([event]), tmp_path)
    assert "<td>GVL_AXIS.Ctrl[1]: AxisCycle PROGRESS_ERROR [0x4650]</td>" in page


def test_only_the_first_errors_are_listed(tmp_path: Path) -> None:
    page = page_of(trace_of([Event(1, Level.ERROR, Kind.MESSAGE, "X", f"number {n}") for n in range(33)]), tmp_path)
    assert "<td>X: number 19</td>" in page
    assert "<td>X: number 20</td>" not in page
    assert "and 13 more</div>" in page


def test_the_override_is_drawn_if_it_ever_was_another() -> None:
    columns = {"X.set_position": [0.0, 1.0], "X.override": [1.0, 1.0], "Y.override": [1.0, 0.25]}
    found = [curve for curve in curves_of(trace_of([], columns)) if curve.panel == "override"]
    assert [(curve.axis, curve.values.tolist()) for curve in found] == [("Y", [100.0, 25.0])]
    assert (unit_of("override", "mm"), unit_of("velocity", "mm")) == ("%", "mm/s")


def test_an_error_stop_of_one_tick_has_a_mark() -> None:
    states = [2.0] * 50_000
    states[30_000] = 3.0
    states[40_000:40_005] = [3.0] * 5
    trace = trace_of([], {"X.state": states})
    assert error_stops(trace, "X") == pytest.approx([30.0, 40.0])
    (mark,) = [curve for curve in drawn(trace) if curve.type == "scatter"]
    assert mark.x == pytest.approx((30.0, 40.0))
    assert mark.marker.line.width >= 2
    assert error_stops(trace_of([], {"X.state": [3.0, 2.0]}), "X") == [0.0]
    assert error_stops(trace_of([], {"X.override": [1.0]}), "X") == []


def test_where_a_long_run_opens_is_said(tmp_path: Path) -> None:
    assert "Opened at" not in page_of(gantry(12), tmp_path)
    assert "Opened at 0 to 5.332 s of 25.74 s; a double-click shows the whole run." in page_of(gantry(40), tmp_path)


def test_a_damaged_file_is_named_on_the_page(tmp_path: Path) -> None:
    trace = trace_of([], rest=b"<junk>")
    page = page_of(trace, tmp_path)
    assert f"The file is damaged: {escape(trace.damage)}. Shown is what was read." in page
    assert "Incomplete: " not in page


def test_the_same_trace_gives_the_same_page(tmp_path: Path) -> None:
    first, second = (tmp_path / name for name in ("one.html", "two.html"))
    for path in (first, second):
        write_page(gantry(12), path)
    assert first.read_bytes() == second.read_bytes()


def test_the_plane_is_as_high_as_equal_scales_need() -> None:
    assert _height(0.5) == "clamp(380px, calc((100cqw - 84px) * 0.500000 + 120px), 840px)"


def test_curves_that_leave_out_ticks_say_so(tmp_path: Path) -> None:
    page = page_of(gantry(12), tmp_path)
    assert "they pass every recorded value within 0.05% of their range" in page
    assert "The table at the top is made from every tick." in page


def test_the_page_stands_alone_and_says_what_it_shows(tmp_path: Path) -> None:
    path = tmp_path / "gantry.html"
    trace = gantry(12)
    write_page(trace, path)
    page = path.read_bytes().decode()
    assert "<h1>gantry</h1>" in page
    assert trace.hash in page
    assert get_plotlyjs() in page
    assert not re.search(r"<(script|link|img)[^>]*(src|href)=", page.replace(get_plotlyjs(), ""))
    assert "Path in the plane X, Y" in page
    assert "DiscreteMotion" in page
    assert "Incomplete: " not in page
    assert "Errors and warnings" not in page
    assert "share of the limit that was in force at the peak" in page
    assert path.stat().st_size < 8e6


def test_a_big_trace_makes_no_big_page(tmp_path: Path) -> None:
    values = np.random.default_rng(0).normal(size=(6000, 120))
    kinds = ("set_position", "set_velocity", "set_acceleration", "set_jerk")
    names = [f"axis{n}.{kind}" for n in range(30) for kind in kinds]
    writer = TraceWriter(None, header(names))
    writer.rows(0, values)
    path = tmp_path / "big.html"
    write_page(Trace.from_chunks(writer.chunks), path)
    assert path.stat().st_size < 8e6
    page = path.read_text()
    assert "The first 24 of 30 axes are drawn." in page
    assert "Incomplete: the writer of the trace was cut short. The recording ends at 5.999 s, tick 5\u2009999." in page


@pytest.mark.parametrize("kind", ["set_position", "actual_position", "set_jerk", "state", "max_velocity", "override"])
def test_a_page_is_drawn_from_whatever_was_recorded(tmp_path: Path, kind: str) -> None:
    assert "2 ticks" in page_of(trace_of([], {f"X.{kind}": [1.0, 2.0]}), tmp_path)


def test_nothing_in_a_trace_becomes_markup(tmp_path: Path) -> None:
    evil = "<script>alert(1)</script>"
    path = tmp_path / "x.html"
    write_page(trace_of([], {f"{evil}.set_position": [0.0, 1.0]}, machine={"name": evil}, product=evil), path)
    assert evil not in path.read_text()


@pytest.mark.parametrize("name", ["x.png", "x.svg", "x"])
def test_pictures_are_refused_with_the_way_out(tmp_path: Path, name: str) -> None:
    with pytest.raises(TraceError, match=r"\.html only; name it x\.html"):
        write_page(gantry(2), tmp_path / name)


def test_a_page_that_cannot_be_written_is_refused(tmp_path: Path) -> None:
    with pytest.raises(TraceError, match="page cannot be written"):
        write_page(gantry(2), tmp_path / "nowhere" / "x.html")


def test_a_trace_with_nothing_to_draw_is_refused(tmp_path: Path) -> None:
    empty = Trace.from_chunks(TraceWriter(None, header(["X.set_position"])).chunks)
    with pytest.raises(TraceError, match="holds no rows of an axis"):
        write_page(empty, tmp_path / "x.html")
