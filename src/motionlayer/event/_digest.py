"""Errors and warnings for a reader: who says what, the grave ones first, and what says the same thing once only.

| folded into the entry before it | because |
|---|---|
| same tick, level, object and number | one fault is told by the axis, by its command and by the layer |
| same level, source and text | it was said again; of the runtime itself, also with other numbers in the text |
"""

import re
from collections import OrderedDict
from typing import Final, NamedTuple

from motionlayer.event._event import Event, Level
from motionlayer.event._subdevice import Subdevice

_RUNTIME: Final = "runtime"
"""Source of the messages of the runtime itself: so many ticks late."""


class Entry(NamedTuple):
    """One or more messages that a reader takes for one.

    Attributes:
        event: the first of them.
        times: how often it was said, in different ticks or with different numbers.
        last: tick of the last time.
        others: what other messages told of the same thing, in the tick of the last time.
    """

    event: Event
    times: int = 1
    last: int = 0
    others: int = 0

    def line(self, cycle: float) -> str:
        """Return who says what, and how often; `cycle` is the base cycle in seconds."""
        more = f" (and {self.others} more of the same)" if self.others else ""
        again = f" ({self.times} times, the last at {self.last * cycle:.6f} s)" if self.times > 1 else ""
        return f"{told(self.event)}{more}{again}"


class Digest:
    """A listener of events that keeps errors and warnings, folded.

    Args:
        most: entries that are kept of each level, the last ones; None keeps all.

    Attributes:
        counts: messages by level, each one counted.
    """

    def __init__(self, most: int | None = None) -> None:
        self.counts = {Level.ERROR: 0, Level.WARNING: 0}
        self._most = most
        self._entries: dict[Level, OrderedDict[tuple[object, ...], Entry]] = {one: OrderedDict() for one in self.counts}
        self._before: dict[Level, tuple[object, ...]] = dict.fromkeys(self.counts, ())
        self._cause: dict[Level, tuple[object, ...]] = dict.fromkeys(self.counts, ())

    def __call__(self, event: Event) -> None:
        """Take in an event; all but errors and warnings are passed over."""
        level = event.level
        if level not in self.counts:
            return
        self.counts[level] += 1
        entries, cause = self._entries[level], _cause(event)
        if event.code and cause == self._cause[level]:
            entry = entries[self._before[level]]
            entries[self._before[level]] = entry._replace(others=entry.others + 1)
            return
        key = _said(event)
        known = entries.get(key)
        entries[key] = Entry(known.event, known.times + 1, event.tick) if known else Entry(event, last=event.tick)
        entries.move_to_end(key)
        self._before[level], self._cause[level] = key, cause
        if self._most is not None and len(entries) > self._most:
            entries.popitem(last=False)

    def entries(self) -> list[Entry]:
        """Return what was said: errors, then warnings, each in the order in which they were last said."""
        return [entry for entries in self._entries.values() for entry in entries.values()]


def told(event: Event) -> str:
    """Return who says what.

    Messages of the motion layer that say nothing, or begin with a colon, go on from the columns of a message file:
    subdevice and number stand beside them here.
    """
    text = event.text.lstrip(" :")
    if text and text == event.text:
        return text if text.startswith(event.source) else f"{event.source}: {text}"
    part = Subdevice(event.subdevice).name if event.subdevice in Subdevice._value2member_map_ else event.subdevice
    return " ".join(filter(None, (f"{event.source}: {part}", text, f"[0x{event.code:04X}]" if event.code else "")))


def _cause(event: Event) -> tuple[object, ...]:
    return event.tick, event.code, event.device or event.source


def _said(event: Event) -> tuple[object, ...]:
    text = re.sub(r"\d+(\.\d+)?", "#", event.text) if event.source == _RUNTIME else event.text
    return event.source, text, event.code, event.subdevice
