"""Profiles in dyadic numbers, and their exact values: what the sampler is held against, bit for bit.

With a cycle of 1/1024 s, dyadic times and jerks divisible by six, every intermediate result of the sampler is a
float64 without rounding, so it must equal the fractions.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

DT: Final = 1.0 / 1024.0
CYCLE: Final = Fraction(DT)


class State(NamedTuple):
    p: Fraction
    v: Fraction
    a: Fraction


Piece = tuple[Fraction, State, Fraction]


def after(state: State, jerk: Fraction, s: Fraction) -> State:
    p, v, a = state
    return State(p + v * s + a * s * s / 2 + jerk * s**3 / 6, v + a * s + jerk * s * s / 2, a + jerk * s)


def profile(start: State, phases: Sequence[tuple[Fraction, int]]) -> list[Piece]:
    """Return the pieces of these phases (duration, jerk) and an endless last one at constant velocity of their end."""
    time, state, pieces = Fraction(0), start, []
    for duration, jerk in phases:
        pieces.append((time, state, Fraction(jerk)))
        time, state = time + duration, after(state, Fraction(jerk), duration)
    pieces.append((time, state._replace(a=Fraction(0)), Fraction(0)))
    return pieces


def table(pieces: Sequence[Piece]) -> NDArray[np.float64]:
    rows = [[float(value) for value in (time, *state, jerk)] for time, state, jerk in pieces]
    return np.array(rows)


def at(pieces: Sequence[Piece], time: Fraction) -> State:
    """Return the state at a time since the profile began."""
    begin, state, jerk = [piece for piece in pieces if piece[0] <= time][-1]
    return after(state, jerk, time - begin)
