"""The oracle's rules of the parameter selector (motion-layer 5.12)."""

import itertools
from collections.abc import Iterator
from typing import Final

from motionlayer.bench.campaign import _contract_words as words
from motionlayer.bench.campaign._contract_recording import Recording
from motionlayer.bench.campaign._contract_watch import Fault

NAME: Final = "selector"
BY_INDEX: Final = 0
BY_ID: Final = 1


def selected(recording: Recording) -> Iterator[Fault]:
    """State answers every change of the command at once, and goes on as the axis does; the axis is that asked for."""
    commands = recording.selector_ctrl["command"].tolist()
    starts = [tick for tick in range(1, len(commands)) if commands[tick] != commands[tick - 1]]
    for start, stop in itertools.pairwise([*starts, len(commands)]):
        yield from _one(recording, commands[start], start, stop)


def _one(recording: Recording, command: int, start: int, stop: int) -> Iterator[Fault]:
    states = recording.selector_state["state"][start:stop].tolist()
    index, axis_id = _resolved(recording, start)
    shows = recording.selector_state[start]
    if (int(shows["axis"]), int(shows["axis_id"])) != (index, axis_id):
        text = f"AxisIndex, AxisId are {shows['axis']}, {shows['axis_id']}; asked for was {index}, {axis_id}"
        yield Fault(NAME, start, "axis", text)
    steps = words.STEPS[command] if command in {words.READ, words.WRITE, words.WRITE_PERSISTENT} else None
    if steps is None or axis_id == 0:
        expected = 0 if steps is None else words.ERROR
        wrong = [tick for tick, state in enumerate(states, start) if state != expected]
        if wrong:
            text = f"State is {states[wrong[0] - start]}, {expected} answers command {command}"
            yield Fault(NAME, wrong[0], "answer", text)
        return
    yield from _steps(steps, command, start, [state - command for state in states])


def _steps(steps: words.Steps, command: int, start: int, shown: list[int]) -> Iterator[Fault]:
    if shown[0] != words.INIT:
        yield Fault(NAME, start, "answer", f"State is {command + shown[0]} after command {command}")
        return
    for tick, (before, now) in enumerate(itertools.pairwise(shown), start + 1):
        if now == before and now != words.INIT:
            continue
        allowed = (*steps[before], words.ERROR) if before in steps else ()
        if now not in allowed:
            yield Fault(NAME, tick, "order of steps", f"State {command + now} after {command + before}")
            return


def _resolved(recording: Recording, tick: int) -> tuple[int, int]:
    """Return index and id that are shown; ids of the NC are counted as the axes are."""
    asked = recording.selector_ctrl[tick]
    number, there = int(asked["axis"]), 1 <= int(asked["axis"]) <= len(recording.axes)
    if asked["selector"] == BY_INDEX:
        return (number, number) if there else (number, 0)
    return (number, number) if there and asked["selector"] == BY_ID else (0, 0)
