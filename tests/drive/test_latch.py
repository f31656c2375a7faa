"""What a drive latches: multiples and edges on the way between two ticks, against a walk in small steps."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.drive import Latches, LatchSignals
from motionlayer.drive._latch import passed_edge, passed_multiple, seen_edge
from motionlayer.store import Latch, Q, Store

PLACES = st.integers(-40, 40)
"""In quarters of a unit: exact, and often just on an edge."""

STEPS = 10
"""Of the walk per quarter; it stands on every edge."""


def walk(old: int, new: int) -> list[float]:
    """Return the places between two quarters, both included, in the direction of the motion."""
    count = abs(new - old) * STEPS
    return [(old * (count - k) + new * k) / (4.0 * count) for k in range(count + 1)] if count else [old / 4.0]


@settings(deadline=None)  # the first call compiles
@given(PLACES, PLACES, st.integers(-8, 8), st.integers(1, 20))
def test_the_first_multiple_on_the_way_is_found(old: int, new: int, offset: int, period: int) -> None:
    found = passed_multiple(old / 4.0, new / 4.0, offset / 4.0, period / 4.0)
    turns = [math.floor((place * 4.0 - offset) / period) for place in walk(old, new)]
    first = next((k for k in range(1, len(turns)) if turns[k] != turns[k - 1]), None)
    if first is None:
        assert math.isnan(found)
    else:
        assert found == (offset + period * max(turns[first], turns[first - 1])) / 4.0


@settings(deadline=None)  # the first call compiles
@given(PLACES, PLACES, PLACES, st.integers(1, 20), st.booleans())
def test_an_edge_is_where_the_input_changes_on_the_way(old: int, new: int, low: int, width: int, rising: bool) -> None:
    """A walk finds the edge no more than a step late; that is in the direction of the motion."""
    least, most = low / 4.0, (low + width) / 4.0
    places = walk(old, new)
    on = [least <= place <= most for place in places]
    edges = [k for k in range(1, len(on)) if on[k] != on[k - 1] and on[k] == rising]
    found = passed_edge(old / 4.0, new / 4.0, least, most, rising)
    assert math.isnan(found) == (not edges)
    if edges:
        assert found in (least, most)
        assert min(places[edges[0] - 1 : edges[0] + 1]) <= found <= max(places[edges[0] - 1 : edges[0] + 1])


@settings(deadline=None)  # the first call compiles
@given(PLACES, PLACES, PLACES, st.integers(1, 20), st.booleans())
def test_a_program_sees_an_edge_only_where_it_lasts_to_the_next_cycle(
    old: int, new: int, low: int, width: int, rising: bool
) -> None:
    least, most = low / 4.0, (low + width) / 4.0
    seen = seen_edge(old / 4.0, new / 4.0, least, most, rising)
    on = [least <= place / 4.0 <= most for place in (old, new)]
    assert math.isnan(seen) == (on != [not rising, rising])
    assert math.isnan(seen) or seen == new / 4.0
    assert math.isnan(seen) or not math.isnan(passed_edge(old / 4.0, new / 4.0, least, most, rising))


@pytest.mark.parametrize(
    ("asked", "place"),
    [
        (Latch.ZERO_PULSE, 1.5),
        (Latch.OVERFLOW, 3.0),
        (Latch.RISING, 4.125),
        (Latch.FALLING, 4.375),
        (Latch.SOFT_RISING, None),
        (Latch.SOFT_FALLING, None),
    ],
)
def test_only_what_is_asked_for_is_latched_and_only_once(asked: int, place: float | None) -> None:
    """The input is on for less than a step, which its program never sees."""
    store = Store(2, dt=0.001, max_pieces=4)
    latches = Latches(store, {1: LatchSignals(pulse=1.5, period=10.0, turn=3.0, low=4.125, high=4.375)})
    store.table[Q.SHIFT] = 100.0
    store.table[Q.ACTUAL_P] = 100.0
    store.table[Q.LATCH_ASKED] = asked
    for position in np.arange(1.0, 14.0):
        store.table[Q.ACTUAL_P] = 100.0 + position
        latches.inputs(0)
    assert store.table[Q.LATCH_ASKED].tolist() == [asked, asked if place is None else 0.0]
    assert store.status_changed == ([] if place is None else [1])
    assert store.table[Q.LATCH_P, 1] == (place or 0.0)


@settings(deadline=None)  # the first call compiles
@given(PLACES, PLACES, st.sampled_from(range(1, 7)))
def test_a_drive_without_a_signal_latches_nothing(old: int, new: int, asked: int) -> None:
    store = Store(1, dt=0.001, max_pieces=4)
    store.table[Q.ACTUAL_P] = old
    latches = Latches(store, {0: LatchSignals()})
    store.table[Q.ACTUAL_P], store.table[Q.LATCH_ASKED] = new, asked
    latches.inputs(1)
    assert store.table[Q.LATCH_ASKED, 0] == asked
