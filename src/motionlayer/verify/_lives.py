"""The life of commands, read from the events: accepted once, ended at most once, or refused."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

from motionlayer.event import Event, Kind
from motionlayer.verify._report import Finding

if TYPE_CHECKING:
    from motionlayer.record import Trace

FOREVER: Final = 2**62
"""Tick at which a command ends that had not ended when the trace did."""

ENDS: Final = (Kind.DONE, Kind.ABORTED, Kind.ERROR)


@dataclass(frozen=True, slots=True)
class Life:
    """One command.

    Attributes:
        number: within the run.
        source: the object it was given to.
        accepted: tick.
        ended: tick, `FOREVER` if it did not end within the trace.
        kind: how it ended, or `ACCEPTED`, or `REFUSED`.
        text: of the event that accepted or refused it.
    """

    number: int
    source: str
    accepted: int
    ended: int
    kind: Kind
    text: str


def _begin(event: Event) -> Life:
    ended = event.tick if event.kind == Kind.REFUSED else FOREVER
    return Life(event.command, event.source, event.tick, ended, event.kind, event.text)


def _next(life: Life | None, event: Event) -> Life | str:
    """Return the life after an event, or what is wrong with the event."""
    if event.kind in (Kind.ACCEPTED, Kind.REFUSED):
        return _begin(event) if life is None else f"{event.kind} after it was {life.kind}"
    if life is None:
        return f"{event.kind} without having been accepted"
    if life.kind != Kind.ACCEPTED:
        return f"{event.kind} after it was {life.kind}"
    if event.source != life.source:
        return f"{event.kind} by {event.source}, accepted by {life.source}"
    return replace(life, ended=event.tick, kind=event.kind)


def read_lives(events: Iterable[Event]) -> tuple[dict[int, Life], list[tuple[Event, str]]]:
    """Follow all commands; return their lives by number, and the events that do not fit with the reason."""
    lives: dict[int, Life] = {}
    wrong: list[tuple[Event, str]] = []
    last = None
    for event in events:
        if last is not None and event.tick < last:
            wrong.append((event, f"an event of tick {event.tick} after one of tick {last}"))
        last = event.tick
        if event.kind == Kind.MESSAGE or event.command == 0:
            continue
        result = _next(lives.get(event.command), event)
        if isinstance(result, str):
            wrong.append((event, f"command {event.command} {result}"))
        else:
            lives[event.command] = result
    return lives, wrong


def life_findings(trace: "Trace", wrong: list[tuple[Event, str]]) -> list[Finding]:
    """Turn events that do not fit into findings."""
    return [
        Finding(event.source, event.tick, event.tick * trace.base_cycle, "command life", text) for event, text in wrong
    ]
