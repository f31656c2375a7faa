"""Sums, placing, watching, copies."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.profile import MAX_PIECES, Limits, plan_position
from motionlayer.runtime.copying import Copies
from motionlayer.store import Ended, Q, Store, Watch
from tests.effort import examples

from .exact import DT

SETPOINT = [Q.SET_P, Q.SET_V, Q.SET_A, Q.SET_J]
LIMITS = Limits(10.0, 100.0, 50.0, 1000.0)


def moving(sums: list[tuple[int, int]] | None = None) -> Store:
    """Return a store with three generators on their ways."""
    store = Store(3, dt=0.001, max_pieces=MAX_PIECES, sums=sums or [])
    for column in range(3):
        store.adopt(column, plan_position(0.0, 0.0, 0.0, 1.0 + column, LIMITS).pieces, offset=0.0001 * column)
    return store


def setpoint(store: Store, column: int) -> list[float]:
    values: list[float] = store.table[SETPOINT, column].tolist()
    return values


def test_sums_are_evaluated_by_level() -> None:
    store = moving([(0, 1), (3, 2), (4, 4), (3, 4)])
    for tick in range(1, 1500):
        store.sample(tick)
        set_rows = store.table[SETPOINT]
        for column, (left, right) in enumerate([(0, 1), (3, 2), (4, 4), (3, 4)], 3):
            assert (set_rows[:, column] == set_rows[:, left] + set_rows[:, right]).all()
    assert set_rows[0].tolist() == [1.0, 2.0, 3.0, 3.0, 6.0, 12.0, 9.0]


@pytest.mark.parametrize("sums", [[(3, 0)], [(0, 4), (3, 1)], [(0, 1), (4, 0)], [(-1, 0)], [(0, -2)], [(0, 99)]])
def test_ring_or_stranger_in_a_sum_is_refused(sums: list[tuple[int, int]]) -> None:
    with pytest.raises(ValueError, match="both must stand before it"):
        Store(3, dt=DT, max_pieces=4, sums=sums)


def test_a_column_is_a_view_of_the_table() -> None:
    store = Store(3, dt=1e-3, max_pieces=4)
    column = store.column(1)
    column[Q.SET_P] = 7.0
    store.table[Q.SET_V] = [1.0, 2.0, 3.0]
    assert store.table[Q.SET_P].tolist() == [0.0, 7.0, 0.0]
    assert column[Q.SET_V] == 2.0
    assert len(column) == Q.COUNT


def test_profile_with_too_many_pieces_is_refused_and_changes_nothing() -> None:
    store = moving()
    arrays = store.table, store.pieces, store.counts, store.current, store.appended
    before = [array.copy() for array in arrays]
    with pytest.raises(ValueError):
        store.adopt(0, np.zeros((MAX_PIECES + 1, 5)))
    for old, new in zip(before, arrays, strict=True):
        assert np.array_equal(old, new)


def test_place_changes_the_setpoint_at_once_and_for_good() -> None:
    store = moving()
    for tick in range(1, 1500):
        store.sample(tick)
    store.place(1, -7.25)
    assert setpoint(store, 1) == [-7.25, 0.0, 0.0, 0.0]
    others = store.table[:, [0, 2]].copy()
    for tick in range(1500, 1600):
        assert store.sample(tick) == []  # nothing ended: nothing was under way
        assert setpoint(store, 1) == [-7.25, 0.0, 0.0, 0.0]
    assert (store.table[:, [0, 2]] == others).all()


def test_restored_store_goes_on_bit_for_bit() -> None:
    store = moving([(0, 1)])
    for tick in range(1, 100):
        store.sample(tick)
    kept = Copies([("store", store)], ())

    def rest() -> list[tuple[list[Ended], bytes]]:
        return [(store.sample(tick), store.table.tobytes()) for tick in range(100, 600)]

    first = rest()
    store.adopt(2, plan_position(3.0, 0.0, 0.0, 50.0, LIMITS).pieces)
    store.place(0, 99.0)
    store.status_changed.append(1)
    store.sample(601)
    table = store.table
    kept.put_back()
    assert (store.tick, store.table is table, store.status_changed) == (99, True, [])  # views stay valid
    assert rest() == first


def test_store_without_generators() -> None:
    store = Store(0, dt=DT, max_pieces=1)
    assert store.sample(1) == []


def passed(store: Store, column: int, position: float, ticks: int) -> list[tuple[int, float]]:
    """Return (tick, early) of a watch."""
    told: list[float] = []
    store.watch(Watch(column, position, told.append))
    found = []
    for tick in range(store.tick + 1, store.tick + ticks + 1):
        store.sample(tick)
        found += [(tick, early) for early in told]
        told.clear()
    return found


@pytest.mark.parametrize(("velocity", "offset"), [(2.0, 0.0), (-2.0, 0.0), (2.0, DT / 4), (-2.0, DT / 4)])
def test_watch_tells_once_when_a_position_is_passed(velocity: float, offset: float) -> None:
    store = Store(2, dt=DT, max_pieces=1)
    store.adopt(1, np.array([[0.0, 0.0, velocity, 0.0, 0.0]]), offset=offset)
    assert passed(store, 1, velocity * 10.75 * DT, 50) == [(11, 0.25 * DT + offset)]


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_watch_on_a_tick_and_at_rest(way: float) -> None:
    store = Store(1, dt=DT, max_pieces=2)
    rest = way * 7.5 * DT
    store.adopt(0, np.array([[0.0, 0.0, way, 0.0, 0.0], [7.5 * DT, rest, 0.0, 0.0, 0.0]]))
    assert passed(store, 0, way * 4 * DT, 5) == [(4, 0.0)]
    assert passed(store, 0, rest, 20) == [(8, 0.5 * DT)]  # where it stops counts as passed, when it gets there
    assert passed(store, 0, rest, 20) == []  # where it stands does not
    assert passed(store, 0, rest + way * DT, 20) == []


def test_the_end_of_a_profile_that_a_watch_has_replaced_is_not_that_of_the_new_one() -> None:
    store = Store(2, dt=DT, max_pieces=2)
    short, long = (np.array([[0.0, 0.0, 1.0, 0.0, 0.0], [n * DT, n * DT, 0.0, 0.0, 0.0]]) for n in (7.5, 3.5))
    for column in range(2):
        store.adopt(column, short)
    store.watch(Watch(0, 7.25 * DT, lambda _early: store.adopt(0, long)))
    ended = [(tick, one.column) for tick in range(1, 20) for one in store.sample(tick)]
    assert ended == [(8, 1), (12, 0)]


@settings(max_examples=examples(50), deadline=None)
@given(st.integers(1, 999), st.booleans())
def test_watch_finds_the_time_on_a_curve(share: int, back: bool) -> None:
    way = -5.0 if back else 5.0
    plan = plan_position(0.0, 0.0, 0.0, way, LIMITS)
    store = Store(1, dt=0.001, max_pieces=MAX_PIECES)
    store.adopt(0, plan.pieces, offset=0.0004)
    position = way * share / 1000
    [(tick, early)] = passed(store, 0, position, 2000)
    assert 0.0 <= early <= 0.001
    time = tick * 0.001 + 0.0004 - early
    t, p, v, a, j = plan.pieces[plan.pieces[:, 0] <= time][-1]
    s = time - t
    assert p + s * (v + s * (a / 2 + s * j / 6)) == pytest.approx(position, abs=1e-12)
