"""The oracle's rules of motion: the axis is asked for what the command means, and moves for nothing else (5.2, 5.5)."""

import itertools
import math
from collections.abc import Iterator
from typing import Final

from motionlayer.bench.campaign import _contract_words as words
from motionlayer.bench.campaign._contract_recording import Rows
from motionlayer.bench.campaign._contract_states import SOON, ended
from motionlayer.bench.campaign._contract_watch import Fault, Given, Segment, Watch
from motionlayer.event import Kind

_NUMBERS: Final = {"position": words.POSITION, "velocity": words.VELOCITY}
_POSITIONING: Final = ("position", "velocity", "acceleration", "deceleration", "jerk")
_MOVING: Final = ("velocity", "direction", "acceleration", "deceleration", "jerk")
_SET_VALUES: Final = {words.MOVE_BUFFER: _POSITIONING, words.MOVE_BUFFER_VELO: _MOVING}


def asked_for(watch: Watch, segment: Segment) -> Iterator[Fault]:
    """Whatever is asked of the axis belongs to the command under way; NULL asks nothing, and so stops nothing."""
    allowed = words.CALLS.get(segment.command, ())
    if segment.command != words.AXIS_INIT and not segment.initialised:
        allowed = ()
    end = ended(watch, segment)
    for one in segment.given:
        late = end is not None and one.start >= end
        gives_up = one.method == "disable" and segment.command == words.ENABLE
        if late or (one.method not in allowed and not gives_up):
            text = f"{one.text} with command {segment.command}, State {watch.state[one.start]}"
            yield Fault(watch.name, one.start, "motion not asked for", text)
            return


def often_enough(watch: Watch, segment: Segment) -> Iterator[Fault]:
    """A move is asked for once, in the cycle of its command; HALT and STOP again after they were taken over."""
    own = [one for one in segment.given if one.method in words.CALLS.get(segment.command, ())]
    if not own or not segment.initialised:
        return
    if own[0].start != segment.start and segment.command not in words.SWITCHING:
        yield Fault(watch.name, own[0].start, "when", f"{own[0].text}; the command came in tick {segment.start}")
    if segment.command in words.ONCE and own[1:]:
        yield Fault(watch.name, own[1].start, "how often", f"{own[1].text} again")
    if segment.command in {words.HALT, words.STOP}:
        for before, after in itertools.pairwise(own):
            if before.how is not Kind.ABORTED or before.end > after.start:
                yield Fault(watch.name, after.start, "how often", f"{after.text} again, {before.text} was not aborted")
                return


def as_written(watch: Watch, segment: Segment) -> Iterator[Fault]:
    """A move goes where the data say in the cycle that starts it; a buffered one follows a change of the data.

    Also one that is taken back before the job has acted on it: a change starts the next motion.
    """
    before: int | None = None
    for one in segment.given:
        if not one.method.startswith("move_"):
            continue
        row = watch.data[one.start]
        yield from _numbers(watch, one, row)
        if one.method == "move_absolute" and one.how is not Kind.REFUSED and _is_no_target(watch, one.start):
            yield Fault(watch.name, one.start, "set value", f"{one.text}, and no number was written as the position")
        if segment.command in words.ENDLESS:
            names = _SET_VALUES[segment.command]
            if before is not None and all(_is_constant(watch.data[name][before : one.start + 1]) for name in names):
                yield Fault(watch.name, one.start, "how often", f"{one.text} again, and no set value has changed")
                return
            before = one.start


def followed(watch: Watch, segment: Segment) -> Iterator[Fault]:
    """A buffered job takes every change of its set values up, as soon as the buffer of the axis has room (D11).

    It has none while a move of the job waits for whatever the axis does before it, be it another command's HALT.
    """
    names = _SET_VALUES.get(segment.command)
    moves = [one for one in segment.given if one.method.startswith("move_")]
    if names is None or not moves:
        return
    waiting, stop = 0, ended(watch, segment) or segment.stop
    for tick in range(segment.start, stop):
        last = next(one for one in reversed(moves) if one.start <= tick)
        changed = any(watch.data[tick][name] != watch.data[last.start][name] for name in names)
        room = sum(one.lives(tick) for one in watch.given if one.method in words.MOTIONS) < 2
        ends = words.DONE in watch.ends[max(tick - 1, 0) : tick + 1]
        waiting = waiting + 1 if changed and room and not ends else 0
        if waiting > SOON:
            text = f"State {watch.state[tick]}, and the new set values are not taken up after {last.text}"
            yield Fault(watch.name, tick, "goes on", text)
            return


def _is_constant(values: Rows) -> bool:
    return bool((values == values[:1]).all())


def _is_no_target(watch: Watch, tick: int) -> bool:
    """Tell whether the position of the data is the 0.0 that stands for what is no number: nobody asks for that."""
    return not math.isfinite(watch.asked[tick]["position"])


def _numbers(watch: Watch, one: Given, row: Rows) -> Iterator[Fault]:
    for name, pattern in _NUMBERS.items() if one.how is not Kind.REFUSED else ():
        found = pattern.search(one.text)
        if found is not None and float(found[1]) != float(row[name]):
            yield Fault(watch.name, one.start, "set value", f"{one.text}, the data say {name} {float(row[name])}")
            return


def moves_for_a_reason(watch: Watch) -> Iterator[Fault]:
    """An axis sets off only while a motion that was asked for is under way.

    One that is brought to rest may pass through zero and come back, as its jerk is limited; it was not at rest then.
    """
    moves = [one for one in watch.given if one.method.startswith("move_") or one.method == "home"]
    for tick in range(1, len(watch.velocity)):
        sets_off = watch.rests(tick - 1) and watch.velocity[tick] != 0.0
        if sets_off and not any(one.lives(tick) or one.lives(tick - 1) for one in moves):
            text = f"the set velocity becomes {watch.velocity[tick]}, State {watch.state[tick]}"
            yield Fault(watch.name, tick, "motion not asked for", text)
            return
