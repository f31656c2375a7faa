"""A profile that takes over inside a cycle where another one ends."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.profile import Limits, plan_passing, plan_position
from motionlayer.runtime.copying import Copies
from motionlayer.store import Ended, Q, Store, Watch

from .exact import DT

LIMITS = Limits(10.0, 100.0, 50.0, 1000.0)


def linked(first: float, speed: float, second: float, offset: float = 0.0) -> tuple[Store, float, float]:
    """Return a store whose column 0 goes to `first`, passes it, and on to `second`; and the durations of both."""
    one = plan_passing(0.0, 0.0, 0.0, first, speed, LIMITS)
    two = plan_position(first, speed, 0.0, second, LIMITS)
    store = Store(1, dt=DT, max_pieces=40)
    store.adopt(0, one.pieces, offset=offset)
    store.append(0, two.pieces)
    return store, one.duration - offset, two.duration


@settings(deadline=None)
@given(first=st.floats(1.0, 5.0), speed=st.floats(0.5, 9.0), way=st.floats(2.0, 5.0), offset=st.floats(0.0, DT))
def test_both_instants_are_reported_and_nothing_is_lost(first: float, speed: float, way: float, offset: float) -> None:
    store, one, two = linked(first, speed, first + way, offset)
    times = []
    for tick in range(1, 100_000):
        for ended in store.sample(tick):
            times.append((tick * DT - ended.early, ended.went_on))
            if ended.went_on:
                assert float(store.table[Q.SET_P, 0]) == pytest.approx(first + speed * ended.early, abs=0.01)
        if len(times) == 2:
            break
    assert [went_on for _, went_on in times] == [True, False]
    assert times[0][0] == pytest.approx(one, abs=1e-12)
    assert times[1][0] == pytest.approx(one + two, abs=1e-12)
    assert store.table[Q.SET_P, 0] == first + way


def test_a_profile_without_duration_hands_over_at_its_tick_and_a_short_one_ends_in_the_same_cycle() -> None:
    store = Store(1, dt=DT, max_pieces=4)
    store.adopt(0, np.array([[0.0, 0.0, 0.0, 0.0, 0.0]]))
    store.append(0, np.array([[0.0, 0.0, 0.0, 0.0, 0.0]]))
    assert store.sample(1) == [Ended(0, DT, went_on=True), Ended(0, DT)]
    assert store.sample(2) == []


def test_what_does_not_fit_or_comes_too_late_is_refused() -> None:
    store, _, _ = linked(1.0, 5.0, 4.0)
    with pytest.raises(ValueError, match="at most 40 are possible together"):
        store.append(0, np.zeros((39, 5)))
    for tick in range(1, 5000):
        store.sample(tick)
    with pytest.raises(ValueError, match="has ended"):
        store.append(0, np.zeros((1, 5)))


def test_adopting_drops_what_was_appended() -> None:
    store, _, _ = linked(1.0, 5.0, 4.0)
    store.adopt(0, plan_position(0.0, 0.0, 0.0, 2.0, LIMITS).pieces)
    ends = [ended for tick in range(1, 5000) for ended in store.sample(tick)]
    assert [ended.went_on for ended in ends] == [False]
    assert store.table[Q.SET_P, 0] == 2.0


@settings(deadline=None)
@given(place=st.floats(0.05, 3.95))
def test_watches_are_exact_on_both_sides_of_the_change(place: float) -> None:
    store, one, _ = linked(1.0, 5.0, 4.0)
    told: list[float] = []
    store.watch(Watch(0, place, told.append))
    tick = 0
    while not told:
        tick += 1
        store.sample(tick)
    time = tick * DT - told[0]
    first = plan_passing(0.0, 0.0, 0.0, 1.0, 5.0, LIMITS).pieces
    second = plan_position(1.0, 5.0, 0.0, 4.0, LIMITS).pieces
    pieces, since = (first, time) if time <= one else (second, time - one)
    k = int(np.searchsorted(pieces[:, 0], since, side="right")) - 1
    t, p, v, a, j = pieces[max(k, 0)]
    s = since - t
    assert p + s * (v + s * (a / 2.0 + s * j / 6.0)) == pytest.approx(place, abs=1e-11)


def test_a_copy_holds_what_is_appended() -> None:
    store, _, _ = linked(1.0, 5.0, 4.0)
    copies = Copies([("store", store)], ())
    runs = []
    for _ in range(2):
        copies.put_back()
        runs.append([(tuple(store.sample(tick)), float(store.table[Q.SET_P, 0])) for tick in range(1, 1500)])
    assert runs[0] == runs[1]
