"""`Watch` and `Segment`: one axis of a recording, and what happened there between two changes of its command."""

import itertools
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from motionlayer.bench.campaign import _contract_words as words
from motionlayer.bench.campaign._contract_recording import Recording, Rows
from motionlayer.event import Event, Kind


class Given(NamedTuple):
    """A command to the axis behind the layer, from its events.

    Attributes:
        method: `move_absolute`.
        text: its call, or why it was refused.
        start: tick in which it was accepted or refused.
        end: tick of its end; -1 as long as there is none.
        how: it has ended; ACCEPTED as long as it runs.
        code: error id, 0 without.
    """

    method: str
    text: str
    start: int
    end: int
    how: Kind
    code: int

    @property
    def failed(self) -> bool:
        """It has not come to DONE."""
        return self.how in {Kind.ERROR, Kind.REFUSED, Kind.ABORTED}

    def lives(self, tick: int) -> bool:
        """Tell whether it was under way in a tick."""
        return self.start <= tick and (self.end < 0 or tick <= self.end)


class Watch(NamedTuple):
    """One axis of a recording; an element per tick.

    Attributes:
        name: of the axis.
        given: by the command field, in the order in which they were given.
        cleared: ticks in which a reset of the axis was done; all others as in `Recording`.
    """

    name: str
    patience: int
    command: list[int]
    ends: list[int]
    state: list[int]
    encoder: list[int]
    bits: list[int]
    error_id: list[int]
    errors: list[int]
    velocity: list[float]
    acceleration: list[float]
    actual: list[float]
    distance: list[float]
    data: Rows
    asked: Rows
    given: list[Given]
    cleared: frozenset[int]

    def rests(self, tick: int) -> bool:
        """Tell whether the axis was at rest in a tick; one that passes through zero is not."""
        return self.velocity[tick] == self.acceleration[tick] == 0.0


class Segment(NamedTuple):
    """What one command has shown, until the field changed again.

    Attributes:
        command: its number.
        start: tick in which it was seen.
        stop: tick in which the next one was.
        initialised: AXIS_INIT was done before.
        given: what was asked of the axis meanwhile.
    """

    command: int
    start: int
    stop: int
    initialised: bool
    given: list[Given]


class Fault(NamedTuple):
    """A broken rule."""

    axis: str
    tick: int
    rule: str
    text: str

    def __str__(self) -> str:
        return f"{self.axis}, tick {self.tick}: {self.rule}: {self.text}"


def watches(recording: Recording) -> Iterator[Watch]:
    """Yield the axes one by one."""
    lives = _lives(recording.events)
    for place, name in enumerate(recording.axes):
        given = lives.get(name, [])
        yield Watch(
            name,
            recording.patience,
            recording.ctrl["command"][:, place].tolist(),
            recording.ctrl["ends"][:, place].tolist(),
            recording.state["state"][:, place].tolist(),
            recording.state["encoder"][:, place].tolist(),
            recording.info["bits"][:, place].tolist(),
            recording.info["error_id"][:, place].tolist(),
            recording.errors[:, place].tolist(),
            recording.trace[f"{name}.set_velocity"].tolist(),
            recording.trace[f"{name}.set_acceleration"].tolist(),
            recording.info["position"][:, place].tolist(),
            recording.options["distance"][:, place].tolist(),
            recording.data[:, place],
            recording.asked[:, place],
            _without_selector(recording, place + 1, given),
            frozenset(one.end for one in given if one.method == "reset" and one.how is Kind.DONE),
        )


def segments(watch: Watch) -> Iterator[Segment]:
    """Yield what lies between two changes of the command field; the first one begins before the first cycle."""
    command, initialised = watch.command, False
    starts = [tick for tick in range(len(command)) if tick == 0 or command[tick] != command[tick - 1]]
    given = iter([*watch.given, None])
    following = next(given)
    for start, stop in itertools.pairwise([*starts, len(command)]):
        own = []
        while following is not None and following.start < stop:
            own.append(following)
            following = next(given)
        if command[start] == words.AXIS_INIT:
            initialised = False
        segment = Segment(command[start], start, stop, initialised, own)
        yield segment
        if segment.command == words.AXIS_INIT:
            initialised = _initialises(watch, segment)


def _initialises(watch: Watch, segment: Segment) -> bool:
    """Tell whether an AXIS_INIT has come to DONE.

    One that another command replaces in the very cycle that would have shown its DONE has done so too, and the answer
    to the other one is all that tells.
    """
    stop = segment.stop
    if watch.state[stop - 1] == words.AXIS_INIT + words.DONE:
        return True
    could = watch.state[stop - 1] - words.AXIS_INIT in (words.PREPARE, 6000)
    answers = stop < len(watch.state) and watch.state[stop] == words.answer(watch.command[stop], initialised=True)
    return could and answers


def _without_selector(recording: Recording, index: int, given: list[Given]) -> list[Given]:
    """Leave out what the parameter selector has asked of an axis: in the cycle that answers its command, and last."""
    own, state = list(given), recording.selector_state
    for tick in np.flatnonzero((state["axis"] == index) & (state["state"] // words.INIT == 1)).tolist():
        command, number = int(state["state"][tick]) % words.INIT, int(recording.selector_ctrl["number"][tick])
        method = words.CALLS[command][0]
        asked = [one for one in own if one.start == tick and one.method == method]
        if command == words.READ:  # a number that can be read asks nothing
            asked = [one for one in asked if f"ParameterNumber = {number})" in one.text]
        if asked:
            own.remove(asked[-1])
    return own


def _lives(events: Iterable[Event]) -> dict[str, list[Given]]:
    """Return the commands of every axis."""
    found: dict[int, Given] = {}
    sources: dict[int, str] = {}
    for event in events:
        if event.kind in {Kind.ACCEPTED, Kind.REFUSED}:
            call = event.text.removeprefix(f"{event.source}.")
            method = call.partition("(" if event.kind is Kind.ACCEPTED else ":")[0]
            end = -1 if event.kind is Kind.ACCEPTED else event.tick
            found[event.command] = Given(method, event.text, event.tick, end, event.kind, event.code)
            sources[event.command] = event.source
        elif event.kind is not Kind.MESSAGE and event.command in found:
            found[event.command] = found[event.command]._replace(end=event.tick, how=event.kind, code=event.code)
    by_axis: dict[str, list[Given]] = {}
    for number, one in found.items():
        by_axis.setdefault(sources[number], []).append(one)
    return by_axis
