"""Where two recordings of one run part: the first tick, and what is different in it."""

import math
from collections.abc import Iterator, Sequence
from itertools import zip_longest
from typing import NamedTuple, TypeVar

import numpy as np

from motionlayer.event import Event
from motionlayer.record._records import Plan
from motionlayer.record._trace import Trace

R = TypeVar("R", Event, Plan)


class Difference(NamedTuple):
    """The first thing that differs.

    Attributes:
        tick: where.
        text: what, with both values.
        missing: the event of the recording, if what differs is that the other one has none in this tick.
    """

    tick: int
    text: str
    missing: Event | None = None


def difference(recorded: Trace, again: Trace, *, end: float = math.inf) -> Difference | None:
    """Compare a trace with another one of the same run, bit for bit, outside of its gaps.

    Args:
        recorded: what is compared; its signals, plans and events.
        again: the other one; has a row for every tick from 0 on.
        end: nothing from this tick on is compared.

    Returns:
        The difference of the first tick that has one, None if there is none. Of several in one tick that of an event
        comes before that of a plan, and both before those of signals: causes before effects.
    """
    found = [
        *_records(recorded.events, again.events, end),
        *_records(recorded.plans, again.plans, end),
        *_signals(recorded, again, end),
    ]
    return min(found, key=lambda one: one.tick, default=None)  # of equal ones the first


def _records(recorded: Sequence[R], again: Sequence[R], end: float) -> Iterator[Difference]:
    """Yield the first difference of two sequences in order of their ticks."""
    pairs = zip_longest(
        (one for one in recorded if one.tick < end),
        (one for one in again if one.tick < end),
    )
    for before, now in pairs:
        if before != now:
            first = min((one for one in (before, now) if one is not None), key=lambda one: one.tick)
            text = f"the trace has {_told(before)}, the replay {_told(now)}"
            alone = before is first and (now is None or now.tick > first.tick)
            yield Difference(first.tick, text, first if alone and isinstance(first, Event) else None)
            return


def _told(record: Event | Plan | None) -> str:
    if record is None:
        return "nothing"
    if isinstance(record, Event):
        return f"the {record.level.name.lower()} {record.source}: {record.text!r} ({record.kind})"
    return f"a plan of {record.axis} ({record.kind}, target {record.target!r}, {len(record.pieces)} pieces)"


def _signals(recorded: Trace, again: Trace, end: float) -> Iterator[Difference]:
    """Yield the first difference of every signal that has one."""
    rows = np.flatnonzero(recorded.ticks < min(end, len(again.ticks)))
    ticks = recorded.ticks[rows]
    for signal in recorded.signals:
        before, now = recorded[signal.name][rows], again[signal.name][ticks]
        unequal = before.view(np.int64) != now.view(np.int64)  # bits: NaN equals itself, minus zero is not zero
        if unequal.any():
            row = int(unequal.argmax())
            values = f"is {float(before[row])!r} {signal.unit} in the trace, {float(now[row])!r} in the replay"
            yield Difference(int(ticks[row]), f"{signal.name} {values}")
