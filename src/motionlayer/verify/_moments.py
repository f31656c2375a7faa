"""When something happened to an axis, row by row: what the events tell, as flags beside the samples."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from motionlayer.event import Event, Kind, Level
from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Flags, Integers
from motionlayer.verify._lives import Life


@dataclass(frozen=True)
class Moments:
    """Rows in whose tick something happened, and rows in which something was under way; shape (n,) each.

    Attributes:
        accepted: a command was accepted.
        enabled: one that asks for power was, or is still under way.
        disabled: one that takes it away was under way in this row or in the one before.
        ended: a command ended, in whichever way.
        done, aborted, failed: a command ended that way.
        faulted: the axis came into error.
        busy: a command was under way.
        busy_before: a command was under way in this row or in the one before.
    """

    accepted: Flags
    enabled: Flags
    disabled: Flags
    ended: Flags
    done: Flags
    aborted: Flags
    failed: Flags
    faulted: Flags
    busy: Flags
    busy_before: Flags

    @classmethod
    def of(cls, axis: Axis, events: Iterable[Event], lives: Mapping[int, Life]) -> "Moments":
        """Sort the events of an axis into its rows; those after the last row are left out."""
        own = [event for event in events if event.source == axis.name]

        def rows(which: Callable[[Event], bool]) -> Flags:
            return np.isin(axis.ticks, [event.tick for event in own if which(event)])

        done, aborted, failed = (
            rows(lambda event, kind=kind: event.kind == kind)  # type: ignore[misc]
            for kind in (Kind.DONE, Kind.ABORTED, Kind.ERROR)
        )

        def called(name: str) -> list[Life]:
            return [life for life in lives.values() if life.text.startswith(f"{name}(")]

        return cls(
            accepted=rows(lambda event: event.kind == Kind.ACCEPTED),
            enabled=_under_way(axis, called("enable"), 0),
            disabled=_under_way(axis, called("disable"), 1),
            ended=done | aborted | failed,
            done=done,
            aborted=aborted,
            failed=failed,
            faulted=rows(lambda event: event.kind == Kind.MESSAGE and event.level == Level.ERROR and event.code != 0),
            busy=_under_way(axis, lives.values(), 0),
            busy_before=_under_way(axis, lives.values(), 1),
        )


def _under_way(axis: Axis, lives: Iterable[Life], before: int) -> Flags:
    """Tell for each row whether one of the commands of the axis is under way in it or in the `before` ticks before."""
    change = np.zeros(len(axis.ticks) + 1, np.int64)
    for life in lives:
        if life.source == axis.name:
            span = np.searchsorted(axis.ticks, [life.accepted, life.ended + before + 1])
            change[span[0]] += 1
            change[span[1]] -= 1
    return np.asarray(np.cumsum(change[:-1]) > 0)


def just_before(flags: Flags) -> Flags:
    """Move flags one row on: what was up in the row before; nothing was before the first one."""
    return np.concatenate([[False], flags[:-1]])


def just_after(flags: Flags) -> Flags:
    """Move flags one row back: what will be up in the next row; nobody knows what comes after the last one."""
    return np.concatenate([flags[1:], [True]])


def changes(values: Integers) -> Flags:
    """Tell where a value is another one than in the row before."""
    return np.concatenate([[False], np.diff(values) != 0])
