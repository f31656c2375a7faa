"""The sampler against exact fractions."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.store import Ended, Q, Store
from tests.effort import examples

from .exact import CYCLE, DT, Piece, State, after, at, profile, table

# Multiples of a quarter cycle: pieces end inside cycles, several in one, and on ticks.
times = st.one_of(st.integers(1, 40), st.integers(1, 4000)).map(lambda quarters: quarters * CYCLE / 4)
jerks = st.integers(-2, 2).map(lambda sixth: 6 * sixth)
coordinates = st.integers(-100, 100).map(lambda value: Fraction(value, 8))


@st.composite
def profiles(draw: st.DrawFn) -> list[Piece]:
    start = State(draw(coordinates), draw(coordinates), draw(coordinates))
    return profile(start, draw(st.lists(st.tuples(times, jerks), max_size=8)))


offsets = st.integers(0, 8).map(lambda quarters: quarters * CYCLE / 4)


def values(store: Store, column: int) -> tuple[float, float, float]:
    p, v, a = store.table[[Q.SET_P, Q.SET_V, Q.SET_A], column].tolist()
    return p, v, a


@settings(max_examples=examples(150), deadline=None)
@given(profiles(), offsets, st.integers(0, 10**7), st.lists(st.integers(1, 3), min_size=1, max_size=40))
def test_values_and_ends_are_exact(pieces: list[Piece], offset: Fraction, begin: int, steps: list[int]) -> None:
    store = Store(3, dt=DT, max_pieces=9)
    store.sample(begin)
    store.adopt(1, table(pieces), offset=float(offset))
    last = pieces[-1][0]
    ended, tick = [], begin
    for step in [*steps, 4000 * 8]:
        tick += step
        time = (tick - begin) * CYCLE + offset
        reports = store.sample(tick)
        ended += reports
        assert values(store, 1) == tuple(map(float, at(pieces, time)))
        assert reports == ([Ended(1, float(time - last))] if reports else [])
        assert len(ended) == (time >= last)
    assert values(store, 0) == values(store, 2) == (0.0, 0.0, 0.0)


@settings(max_examples=examples(50), deadline=None)
@given(profiles(), offsets)
def test_set_jerk_is_the_mean_over_the_cycle(pieces: list[Piece], offset: Fraction) -> None:
    store = Store(1, dt=DT, max_pieces=9)
    store.adopt(0, table(pieces), offset=float(offset))
    store.sample(1)
    for tick in range(2, 50):
        before = at(pieces, (tick - 1) * CYCLE + offset).a
        store.sample(tick)
        assert store.table[Q.SET_J, 0] == (at(pieces, tick * CYCLE + offset).a - before) / CYCLE


def test_set_jerk_of_the_first_cycle_counts_from_the_setpoint_before() -> None:
    store = Store(1, dt=DT, max_pieces=2)
    store.adopt(0, np.array([[0.0, 0.0, 0.0, 0.0, 600.0], [1.0, 100.0, 300.0, 600.0, 0.0]]))
    store.sample(1)
    assert store.table[Q.SET_J, 0] == 600.0
    store.adopt(0, np.array([[0.0, *values(store, 0), -600.0]]), offset=0.0)
    store.sample(2)
    assert store.table[Q.SET_J, 0] == -600.0


def test_piece_that_begins_on_a_tick_holds_there() -> None:
    # Accelerations that jump show which piece was taken.
    store = Store(1, dt=DT, max_pieces=3)
    store.adopt(0, np.array([[0.0, 0.0, 0.0, 1.0, 0.0], [2 * DT, 0.0, 0.0, 2.0, 0.0], [3 * DT, 0.0, 0.0, 3.0, 0.0]]))
    seen = [(bool(store.sample(tick)), float(store.table[Q.SET_A, 0])) for tick in range(1, 5)]
    assert seen == [(False, 1.0), (False, 2.0), (True, 3.0), (False, 3.0)]


def test_several_pieces_in_one_cycle_report_one_end() -> None:
    quarter = CYCLE / 4
    pieces = profile(State(Fraction(1), Fraction(2), Fraction(0)), [(quarter, 6), (quarter, -6), (quarter, 12)])
    store = Store(1, dt=DT, max_pieces=4)
    store.adopt(0, table(pieces))
    assert store.sample(1) == [Ended(0, DT / 4)]
    assert values(store, 0) == tuple(map(float, at(pieces, CYCLE)))
    assert store.sample(2) == []


def test_profile_of_one_piece_ends_with_the_next_sample() -> None:
    store = Store(1, dt=DT, max_pieces=1)
    store.adopt(0, np.array([[0.0, 5.0, 2.0, 0.0, 0.0]]), offset=DT / 4)
    assert store.sample(1) == [Ended(0, DT + DT / 4)]
    assert store.sample(2) == []
    assert values(store, 0) == (5.0 + 2.0 * (2 * DT + DT / 4), 2.0, 0.0)


def test_ends_of_one_cycle_come_in_order_of_columns() -> None:
    store = Store(4, dt=DT, max_pieces=2)
    for column, time in ((3, 0.5), (0, 0.75), (2, 2.0), (1, 0.25)):
        store.adopt(column, np.array([[0.0, 0.0, 1.0, 0.0, 0.0], [time * DT, time * DT, 1.0, 0.0, 0.0]]))
    assert store.sample(1) == [Ended(0, 0.25 * DT), Ended(1, 0.75 * DT), Ended(3, 0.5 * DT)]
    assert store.sample(2) == [Ended(2, 0.0)]


def test_a_new_profile_replaces_the_one_under_way() -> None:
    store = Store(1, dt=DT, max_pieces=3)
    store.adopt(0, np.array([[0.0, 0.0, 0.0, 1.0, 0.0], [DT, 1.0, 1.0, 0.0, 0.0], [9 * DT, 9.0, 1.0, 0.0, 0.0]]))
    store.sample(1)
    store.sample(2)
    store.adopt(0, np.array([[0.0, 7.0, 0.0, 0.0, 6.0], [4 * DT, 8.0, 0.0, 0.0, 0.0]]))
    assert store.table[Q.SET_V, 0] == 1.0  # the setpoint of the tick stands until the next sample
    seen = [store.sample(tick) for tick in range(3, 12)]
    assert seen == [[], [], [], [Ended(0, 0.0)], [], [], [], [], []]
    assert values(store, 0) == (8.0, 0.0, 0.0)


@pytest.mark.parametrize("ticks", [10**7, 10**9])
def test_no_drift_after_a_long_time(ticks: int) -> None:
    store = Store(1, dt=DT, max_pieces=3)
    cruise = ticks * CYCLE - CYCLE / 2
    start = State(Fraction(1), Fraction(3, 2), Fraction(0))
    pieces = profile(start, [(cruise, 0), (2 * CYCLE, -6)])
    store.adopt(0, table(pieces))
    for tick in range(0, ticks, ticks // 1000):
        assert store.sample(tick) == []
        assert values(store, 0) == tuple(map(float, after(start, Fraction(0), tick * CYCLE)))
    for tick in range(ticks, ticks + 2):
        assert store.sample(tick) == []
        time = tick * CYCLE
        assert values(store, 0) == pytest.approx(tuple(map(float, at(pieces, time))), rel=1e-15)
    assert store.sample(ticks + 2) == [Ended(0, DT / 2)]


@pytest.mark.slow
def test_ten_million_cycles_one_by_one_end_where_one_leap_ends() -> None:
    pieces = np.array([[0.0, 0.1, 0.3, 0.0, 0.0], [9999.9995, 0.1 + 0.3 * 9999.9995, 0.3, 0.0, 0.0]])
    walked, leapt = (Store(1, dt=0.001, max_pieces=2) for _ in range(2))
    for store in (walked, leapt):
        store.adopt(0, pieces)
    ended = [end for tick in range(1, 10**7 + 1) for end in walked.sample(tick)]
    assert ended == leapt.sample(10**7)
    assert values(walked, 0) == values(leapt, 0)


def test_decimal_cycle_is_right_to_rounding() -> None:
    pieces = [[0.0, 0.1, 0.2, 0.3, 0.7], [0.0153, 0.1031, 0.2047, 0.31071, -0.9], [0.5, 0.2, 0.3, 0.0, 0.0]]
    store = Store(1, dt=0.001, max_pieces=3)
    store.adopt(0, np.array(pieces), offset=0.0003)
    for tick in range(1, 600):
        store.sample(tick)
        time = tick * Fraction(0.001) + Fraction(0.0003)
        t, p, v, a, j = [list(map(Fraction, row)) for row in pieces if row[0] <= time][-1]
        exact = after(State(p, v, a), j, time - t)
        assert values(store, 0) == pytest.approx(tuple(map(float, exact)), rel=1e-14, abs=1e-14)
