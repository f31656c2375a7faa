"""The oracle of the motion layer: judges a recording by the text of motion-layer alone, and shares no code with it.

It watches from outside: commands and data as written, State and Info as published in every cycle, and what the axes
were asked for and did. Rules look at one command from its change to the next one, or at an axis as a whole.
"""

from collections.abc import Callable, Iterator
from typing import Final

from motionlayer.bench.campaign import _contract_errors as errors
from motionlayer.bench.campaign import _contract_motions as motions
from motionlayer.bench.campaign import _contract_selector as selector
from motionlayer.bench.campaign import _contract_states as states
from motionlayer.bench.campaign import _contract_words as words
from motionlayer.bench.campaign._contract_recording import Recording
from motionlayer.bench.campaign._contract_watch import Fault, Segment, Watch, segments, watches

RULES: Final[tuple[Callable[[Watch, Segment], Iterator[Fault]], ...]] = (
    states.answered,
    states.stepped,
    states.founded,
    states.goes_on,
    errors.numbered,
    errors.occupied,
    motions.asked_for,
    motions.often_enough,
    motions.as_written,
    motions.followed,
)
"""What holds for every command."""


def judge(recording: Recording) -> list[Fault]:
    """Return every broken rule, in the order of time."""
    found = [*errors.finite(recording), *selector.selected(recording)]
    for watch in watches(recording):
        parts = list(segments(watch))
        for segment in parts:
            for rule in RULES:
                found += rule(watch, segment)
        found += errors.flagged(watch, parts)
        found += motions.moves_for_a_reason(watch)
    return sorted(found, key=lambda fault: fault.tick)


def answers(recording: Recording) -> tuple[int, int]:
    """Return how many command changes State has answered in the same cycle, and how many there were."""
    right = count = 0
    for watch in watches(recording):
        for segment in segments(watch):
            if segment.start:
                count += 1
                expected = words.answer(segment.command, initialised=segment.initialised)
                right += watch.state[segment.start] == expected
    return right, count
