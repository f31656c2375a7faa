"""Sampling: the one array pass that every cycle pays for."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.store._layout import PIECE_FIELDS, Q

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# Kernels see plain integers.
SET_P: Final = Q.SET_P
SET_V: Final = Q.SET_V
SET_A: Final = Q.SET_A
SET_J: Final = Q.SET_J
END_TIME: Final = Q.END_TIME
PIECE_TIME: Final = Q.PIECE_TIME
PIECE_P: Final = Q.PIECE_P
PIECE_V: Final = Q.PIECE_V
PIECE_A: Final = Q.PIECE_A
PIECE_J: Final = Q.PIECE_J
TICK: Final = Q.TICK
OFFSET: Final = Q.OFFSET

ENDED: Final = 0
"""A profile came to its last piece."""

WENT_ON: Final = 1
"""A profile ended, and the one appended to it has begun."""


@kernel
def take_over(
    table: Floats,
    pieces: Floats,
    counts: Integers,
    current: Integers,
    appended: Integers,
    column: int,
    profile: Floats,
    count: int,
    tick: float,
    offset: float,
) -> None:
    """Let a column follow the first `count` pieces of a profile, of which `offset` seconds have passed at `tick`."""
    for k in range(count):
        for field in range(PIECE_FIELDS):
            pieces[column, k, field] = profile[k, field]
    counts[column] = count
    appended[column] = 0
    current[column] = 0
    table[TICK, column] = tick
    table[OFFSET, column] = offset
    load_piece(table, pieces, counts, current, column)
    if count == 1:  # over when it begins: its end is found by the next sample
        table[END_TIME, column] = pieces[column, 0, 0]


@kernel
def load_piece(table: Floats, pieces: Floats, counts: Integers, current: Integers, column: int) -> None:
    """Put the current piece of a column into its row values, with the time at which the next one begins."""
    k = current[column]
    table[PIECE_TIME, column] = pieces[column, k, 0]
    table[PIECE_P, column] = pieces[column, k, 1]
    table[PIECE_V, column] = pieces[column, k, 2]
    table[PIECE_A, column] = pieces[column, k, 3]
    table[PIECE_J, column] = pieces[column, k, 4]
    table[END_TIME, column] = pieces[column, k + 1, 0] if k + 1 < counts[column] else np.inf


@kernel
def go_on(table: Floats, pieces: Floats, counts: Integers, current: Integers, column: int, time: float) -> bool:
    """Move a column on to the piece that holds at `time`; tell whether it came to its last one."""
    last = counts[column] - 1
    k = current[column]
    while k < last and time >= pieces[column, k + 1, 0]:
        k += 1
    current[column] = k
    load_piece(table, pieces, counts, current, column)
    return bool(k == last)


@kernel
def begin_appended(
    table: Floats,
    pieces: Floats,
    counts: Integers,
    current: Integers,
    appended: Integers,
    column: int,
    tick: float,
    dt: float,
) -> None:
    """Let a column that came to its last piece before `tick` follow the appended profile from that instant on.

    The profile keeps a clock of its own: its offset at the tick before is how long it still had to wait, negated.
    """
    ended = table[PIECE_TIME, column]
    offset = (tick - 1.0 - table[TICK, column]) * dt + table[OFFSET, column] - ended
    first, count = counts[column], appended[column]
    waiting = pieces[column, first : first + count]  # lies behind where it goes: copying forwards is safe
    take_over(table, pieces, counts, current, appended, column, waiting, count, tick - 1.0, max(offset, -dt))


@kernel
def sample(
    table: Floats,
    pieces: Floats,
    counts: Integers,
    current: Integers,
    appended: Integers,
    generators: int,
    tick: float,
    dt: float,
    passed: Integers,
) -> int:
    """Evaluate all generators at `tick`; write into `passed` which columns ENDED or WENT_ON; return how many entries.

    Two passes: a test that is almost never true, and straight arithmetic that compiles to vector code.
    """
    start, offset, end = table[TICK], table[OFFSET], table[END_TIME]
    count = 0
    for i in range(generators):
        time = (tick - start[i]) * dt + offset[i]
        if time >= end[i] and go_on(table, pieces, counts, current, i, time):
            passed[count, 0] = i
            passed[count, 1] = ENDED
            if appended[i] > 0:
                passed[count, 1] = WENT_ON
                begin_appended(table, pieces, counts, current, appended, i, tick, dt)
                time = dt + offset[i]
                if time >= end[i] and go_on(table, pieces, counts, current, i, time):
                    count += 1
                    passed[count, 0] = i
                    passed[count, 1] = ENDED
            count += 1
    since, p, v = table[PIECE_TIME], table[PIECE_P], table[PIECE_V]
    a, j = table[PIECE_A], table[PIECE_J]
    set_p, set_v, set_a, set_j = table[SET_P], table[SET_V], table[SET_A], table[SET_J]
    rate = 1.0 / dt
    for i in range(generators):
        s = (tick - start[i]) * dt + offset[i] - since[i]
        new_a = a[i] + s * j[i]
        set_j[i] = (new_a - set_a[i]) * rate
        set_a[i] = new_a
        set_v[i] = v[i] + s * (a[i] + s * (0.5 * j[i]))
        set_p[i] = p[i] + s * (v[i] + s * (0.5 * a[i] + s * (j[i] / 6.0)))
    return count


@kernel
def position_at(pieces: Floats, time: float) -> float:
    """Evaluate a profile at `time` seconds since it began."""
    k = pieces.shape[0] - 1
    while k > 0 and time < pieces[k, 0]:
        k -= 1
    s = time - pieces[k, 0]
    p, v, a, j = pieces[k, 1], pieces[k, 2], pieces[k, 3], pieces[k, 4]
    return float(p + s * (v + s * (0.5 * a + s * (j / 6.0))))


@kernel
def passing_time(pieces: Floats, first: float, last: float, position: float) -> float:
    """Return when, between two times of the profile, it passes `position`, by bisection to the last bit."""
    rising = position_at(pieces, last) > position_at(pieces, first)
    way = 1.0 if rising else -1.0  # reached counts as passed in both directions
    for _ in range(64):
        middle = 0.5 * (first + last)
        if way * (position_at(pieces, middle) - position) >= 0.0:
            last = middle
        else:
            first = middle
    return last


@kernel
def add_up(table: Floats, first: int, left: Integers, right: Integers) -> None:
    """Evaluate one level of sums: column `first + k` is the sum of columns `left[k]` and `right[k]`."""
    for k in range(left.shape[0]):
        for q in (SET_P, SET_V, SET_A, SET_J):
            table[q, first + k] = table[q, left[k]] + table[q, right[k]]
