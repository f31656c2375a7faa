"""Breakpoints: events at which a run stops.

What happens in a tick is only noted in it; whether a breakpoint is met is asked after the tick, where an exception of a
predicate reaches whoever runs the ticks, and no program.
"""

from collections.abc import Callable

from motionlayer.event import Event, EventLog, Kind, Level

Predicate = Callable[[Event], bool]


class Breakpoint:
    """Stops a run at an event; made by `run.breakpoint`.

    Attributes:
        predicate: tells whether an event is such a one; None takes all.
        source: only events of this object; None takes all.
        level: only events as grave as this or graver; None takes all.
        kind: only events of this kind; None takes all.
    """

    def __init__(
        self,
        breakpoints: "Breakpoints",
        predicate: Predicate | None,
        source: str | None,
        level: Level | None,
        kind: Kind | None,
    ) -> None:
        self.predicate = predicate
        self.source = source
        self.level = level
        self.kind = kind
        self._breakpoints = breakpoints

    def met(self, event: Event) -> bool:
        """Tell whether the run stops at an event. What the predicate raises is raised here."""
        return (
            self.source in (None, event.source)
            and self.kind in (None, event.kind)
            and (self.level is None or event.level <= self.level)
            and (self.predicate is None or self.predicate(event))
        )

    def remove(self) -> None:
        """Stop no more; again, it does nothing."""
        self._breakpoints.remove(self)


class Breakpoints:
    """The breakpoints of a run, and the events of a tick they are compared with.

    Args:
        events: what happens.
    """

    def __init__(self, events: EventLog) -> None:
        self._events = events
        self._all: list[Breakpoint] = []
        self._listening = False
        self._armed = False
        self._seen: list[Event] = []

    def add(
        self, predicate: Predicate | None, source: str | None, level: Level | None, kind: Kind | None
    ) -> Breakpoint:
        """Make one."""
        if not self._listening:  # a run without breakpoints has no listener
            self._listening = True
            self._events.listen(self._note)
        one = Breakpoint(self, predicate, source, level, kind)
        self._all.append(one)
        return one

    def remove(self, one: Breakpoint) -> None:
        """Forget one."""
        if one in self._all:
            self._all.remove(one)

    def arm(self, *, on: bool) -> None:
        """Begin to note events, or end it."""
        self._armed = on
        self._seen.clear()

    def met(self) -> Event | None:
        """Return the first event since the last call at which a breakpoint stops, None without."""
        if not self._seen:
            return None
        seen, self._seen = self._seen, []
        return next((event for event in seen if any(one.met(event) for one in self._all)), None)

    def _note(self, event: Event) -> None:
        if self._armed and self._all:
            self._seen.append(event)
