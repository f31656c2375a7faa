"""What went wrong or was cut short, and when: marks for the plots, and the list at the end of the page."""

from typing import Final, NamedTuple

import numpy as np

from motionlayer.event import Digest, Entry, Event, Kind, Level, told
from motionlayer.record._trace import Trace
from motionlayer.record.plot._series import ERROR_STOP, axes_of, column

MARKS: Final = ("error", "program failed", "fault", "refused", "warning", "aborted")
"""Kinds of marks, the grave ones first."""

MOST_MARKS: Final = 2000
"""Marks of each kind that are drawn; of more, so many at equal distances."""

MOST_SOURCES: Final = 12
OTHERS: Final = "others"
PROGRAM: Final = "program "
"""Events of programs come from sources that begin like this."""


class Mark(NamedTuple):
    """An event worth a mark; `row` is where it is drawn, `text` says who and what."""

    kind: str
    time: float
    row: str
    text: str


def kind_of(event: Event) -> str:
    """Return as which kind of mark an event is drawn, "" if it is not."""
    if event.kind is Kind.MESSAGE:
        return {Level.ERROR: "fault", Level.WARNING: "warning"}.get(event.level, "")
    if event.kind is Kind.ERROR and event.source.startswith(PROGRAM):
        return "program failed"
    return str(event.kind) if event.kind in (Kind.ERROR, Kind.REFUSED, Kind.ABORTED) else ""


def marks_of(trace: Trace) -> dict[str, list[Mark]]:
    """Return the marks of each kind that occurs, in order."""
    rows = mark_rows(trace)
    marks: dict[str, list[Mark]] = {kind: [] for kind in MARKS}
    for event in trace.events:
        kind = kind_of(event)
        if kind:
            row = event.source if event.source in rows else OTHERS
            marks[kind].append(Mark(kind, event.tick * trace.base_cycle, row, told(event)))
    return {kind: _some(found) for kind, found in marks.items() if found}


def mark_rows(trace: Trace) -> list[str]:
    """Return the sources that have marks, axes first; those beyond `MOST_SOURCES` share a row."""
    sources = dict.fromkeys(event.source for event in trace.events if kind_of(event))
    axes = [axis for axis in axes_of(trace) if axis in sources]
    rows = list(dict.fromkeys([*axes, *sources]))
    return rows if len(rows) <= MOST_SOURCES else [*rows[: MOST_SOURCES - 1], OTHERS]


def _some(marks: list[Mark]) -> list[Mark]:
    if len(marks) <= MOST_MARKS:
        return marks
    return [marks[n] for n in np.linspace(0, len(marks) - 1, MOST_MARKS).astype(int).tolist()]


def error_stops(trace: Trace, axis: str) -> list[float]:
    """Return when an axis entered the state ErrorStop, s; also when that lasted one tick only."""
    states = column(trace, axis, "state")
    if states is None:
        return []
    stopped = states == ERROR_STOP
    entered = np.flatnonzero(stopped & ~np.append(False, stopped[:-1]))
    return [float(time) for time in trace.time[entered][:MOST_MARKS]]


def grave_entries(trace: Trace) -> list[Entry]:
    """Return what was said in errors, then in warnings; once each, in the order in which it was last said."""
    digest = Digest()
    for event in trace.events:
        digest(event)
    return digest.entries()
