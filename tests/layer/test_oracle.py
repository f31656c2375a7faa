"""The oracle of the motion layer finds whatever is changed in a recording of a layer that keeps its contract."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from motionlayer.bench.campaign import _contract_words as words
from motionlayer.bench.campaign._contract import contract
from motionlayer.bench.campaign._contract_oracle import answers, judge
from motionlayer.bench.campaign._contract_play import Contract, play
from motionlayer.bench.campaign._contract_recording import Recording, Rows
from motionlayer.bench.campaign._contract_states import ended
from motionlayer.bench.campaign._contract_watch import Segment, Watch, segments, watches
from motionlayer.event import Event, Kind, Level
from tests.effort import quick

SEED = 11

Damage = Callable[[np.random.Generator, Recording], Recording]


@cache
def recorded() -> Recording:
    """Return a recording with two clients per axis."""
    case = contract(SEED, 0)
    return play(Contract(case.machine, [life[:2] for life in case.lives], case.selector))


def one_segment(
    rng: np.random.Generator, recording: Recording, fits: Callable[[Watch, Segment], bool]
) -> tuple[int, Watch, Segment]:
    """Return a random command for which something holds, and the place of its axis."""
    found = [
        (place, watch, segment)
        for place, watch in enumerate(watches(recording))
        for segment in segments(watch)
        if segment.start and fits(watch, segment)
    ]
    return found[int(rng.integers(len(found)))]


def put(rows: Rows, name: str, tick: int | slice, place: int, value: float) -> Rows:
    """Return a copy with another value in a field."""
    changed = rows.copy()
    changed[name][tick, place] = value
    return changed


def put_state(recording: Recording, tick: int | slice, place: int, value: int) -> Recording:
    return recording._replace(state=put(recording.state, "state", tick, place, value))


def flip(recording: Recording, tick: int, place: int, bit: int) -> Recording:
    bits = int(recording.info["bits"][tick, place]) ^ bit
    return recording._replace(info=put(recording.info, "bits", tick, place, bits))


# -- damages -----------------------------------------------------------------------------------------------------------


def a_state_of_its_own(rng: np.random.Generator, recording: Recording) -> Recording:
    """Any state in any cycle, a number outside of the table among them."""
    tick, place = int(rng.integers(20, len(recording.errors))), int(rng.integers(len(recording.axes)))
    old = int(recording.state["state"][tick, place])
    new = int(rng.choice([0, old + 1, 2000 + old % 1000, 10_071, 65_535, 9_000, 100]))
    return put_state(recording, tick, place, new if new != old else old + 7)


def a_late_answer(rng: np.random.Generator, recording: Recording) -> Recording:
    place, watch, segment = one_segment(
        rng, recording, lambda watch, segment: watch.state[segment.start - 1] != watch.state[segment.start]
    )
    return put_state(recording, segment.start, place, watch.state[segment.start - 1])


def an_early_end(rng: np.random.Generator, recording: Recording) -> Recording:
    """DONE from the second cycle on, of a command that has to wait for the axis."""
    place, _, segment = one_segment(
        rng,
        recording,
        lambda _, segment: segment.command in words.STEPS and segment.initialised and segment.stop - segment.start > 4,
    )
    return put_state(recording, slice(segment.start + 1, segment.stop), place, segment.command + words.DONE)


def an_end_that_does_not_come(rng: np.random.Generator, recording: Recording) -> Recording:
    """The last step stays, though the axis has long done what it should."""
    place, watch, segment = one_segment(
        rng,
        recording,
        lambda watch, segment: (
            segment.command in words.STEPS
            and segment.command not in words.ENDLESS
            and segment.stop - (ended(watch, segment) or segment.stop) > 10
            and not any(one.end < 0 for one in segment.given)
            and segment.command not in (words.MOVE_VELO, words.SEND_TO_POS)  # whose motion goes on
        ),
    )
    end = ended(watch, segment)
    assert end is not None
    return put_state(recording, slice(end, segment.stop), place, watch.state[end - 1])


def another_end(rng: np.random.Generator, recording: Recording) -> Recording:
    """ERROR for DONE."""
    place, watch, segment = one_segment(
        rng,
        recording,
        lambda watch, segment: watch.state[segment.stop - 1] == segment.command + words.DONE and segment.command > 0,
    )
    end = ended(watch, segment)
    return put_state(recording, slice(end, segment.stop), place, segment.command + words.ERROR)


def an_end_that_changes(rng: np.random.Generator, recording: Recording) -> Recording:
    place, watch, segment = one_segment(
        rng, recording, lambda watch, segment: segment.stop - (ended(watch, segment) or segment.stop) > 2
    )
    return put_state(recording, segment.stop - 1, place, watch.state[segment.stop - 1] + 1000)


def an_error_bit(rng: np.random.Generator, recording: Recording) -> Recording:
    """BError in a cycle in which nothing else about errors changes."""
    place, _, segment = one_segment(
        rng,
        recording,
        lambda watch, segment: (
            segment.command not in words.CLEARING
            and segment.stop - segment.start > 3
            and len(set(watch.errors[segment.start - 1 : segment.stop])) == 1
            and not watch.cleared.intersection(range(segment.start - 1, segment.stop))
        ),
    )
    return flip(recording, segment.stop - 1, place, words.IN_ERROR)


def a_busy_bit(rng: np.random.Generator, recording: Recording) -> Recording:
    place, _, segment = one_segment(rng, recording, lambda _, segment: segment.command in words.STEPS)
    return flip(recording, segment.start, place, words.BUSY)


def an_error_number(rng: np.random.Generator, recording: Recording) -> Recording:
    """Another number, or one where there is none."""
    place, watch, segment = one_segment(
        rng,
        recording,
        lambda watch, segment: (
            segment.command in words.STEPS and segment.initialised and not watch.bits[segment.start] & words.TIMEOUT
        ),
    )
    tick = segment.start
    return recording._replace(info=put(recording.info, "error_id", tick, place, watch.error_id[tick] + 1))


def a_number_that_is_none(rng: np.random.Generator, recording: Recording) -> Recording:
    """NaN that stays in the client's structure."""
    found = [
        (name, tick, place)
        for name in recording.asked.dtype.names or ()
        for tick, place in np.argwhere(~np.isfinite(recording.asked[name])).tolist()
    ]
    assert found
    name, tick, place = found[int(rng.integers(len(found)))]
    return recording._replace(data=put(recording.data, name, tick, place, np.nan))


def a_lost_call(rng: np.random.Generator, recording: Recording) -> Recording:
    """What a command has done, without having been asked of the axis."""
    place, _, segment = one_segment(
        rng,
        recording,
        lambda watch, segment: (
            segment.command in (words.ENABLE, words.MOVE_POS, words.RESET, words.HOME)
            and watch.state[segment.stop - 1] == segment.command + words.DONE
        ),
    )
    name, asked = recording.axes[place], words.CALLS[segment.command]
    lost = {
        event.command
        for event in recording.events
        if event.source == name and segment.start <= event.tick < segment.stop and event.text.startswith(asked)
    }
    return recording._replace(events=tuple(event for event in recording.events if event.command not in lost))


def a_motion_that_nobody_asked_for(rng: np.random.Generator, recording: Recording) -> Recording:
    """A move that begins while NULL stands in the command field."""
    place, _, segment = one_segment(rng, recording, lambda _, segment: segment.command == words.NULL)
    name, tick = recording.axes[place], segment.start
    event = Event(tick, Level.VERBOSE, Kind.ACCEPTED, name, "move_velocity(velocity=1.0)", 0, 999_999)
    return recording._replace(events=(*recording.events, event))


def a_step_of_the_axis(rng: np.random.Generator, recording: Recording) -> Recording:
    """A set velocity in an axis that has been asked for nothing."""
    place, watch, segment = one_segment(
        rng,
        recording,
        lambda watch, segment: (
            segment.stop - segment.start > 3
            and all(speed == 0.0 for speed in watch.velocity[segment.start : segment.stop])
            and not any(
                one.lives(tick)
                for one in watch.given
                for tick in range(segment.start, segment.stop)
                if one.method.startswith(("move_", "home"))
            )
        ),
    )
    velocity = np.array(watch.velocity)
    velocity[segment.stop - 2] = 1.0
    return recording._replace(trace=recording.trace.replace({f"{recording.axes[place]}.set_velocity": velocity}))


def a_selector_that_answers_for_another_axis(rng: np.random.Generator, recording: Recording) -> Recording:
    commands = recording.selector_ctrl["command"]
    ticks = np.flatnonzero(commands[1:] != commands[:-1]) + 1
    changed = recording.selector_state.copy()
    changed["axis"][int(rng.choice(ticks))] += 1
    return recording._replace(selector_state=changed)


def a_selector_in_a_state_of_its_own(rng: np.random.Generator, recording: Recording) -> Recording:
    commands = recording.selector_ctrl["command"]
    tick = int(rng.choice(np.flatnonzero(np.isin(commands, (40, 41, 42)))))
    changed = recording.selector_state.copy()
    changed["state"][tick] += 1000
    return recording._replace(selector_state=changed)


DAMAGES: list[Damage] = [
    a_state_of_its_own,
    a_late_answer,
    an_early_end,
    an_end_that_does_not_come,
    another_end,
    an_end_that_changes,
    an_error_bit,
    a_busy_bit,
    an_error_number,
    a_number_that_is_none,
    a_lost_call,
    a_motion_that_nobody_asked_for,
    a_step_of_the_axis,
    a_selector_that_answers_for_another_axis,
    a_selector_in_a_state_of_its_own,
]


def test_nothing_is_found_in_what_was_recorded() -> None:
    assert judge(recorded()) == []


@pytest.mark.parametrize("damage", DAMAGES, ids=lambda damage: damage.__name__)
def test_every_damage_is_found(damage: Damage) -> None:
    numbers = range(2 if quick() else 12)
    assert [number for number in numbers if not judge(damage(np.random.default_rng(number), recorded()))] == []


def test_the_share_of_answers_counts_those_that_come_late() -> None:
    right, count = answers(recorded())
    assert right == count > 100
    late = a_late_answer(np.random.default_rng(3), recorded())
    assert answers(late) == (count - 1, count)
