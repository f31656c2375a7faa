"""Rows of the table. The first four are what the hash of a run is taken over, and stay together."""

import enum
from typing import Final


class Q(enum.IntEnum):
    """Quantity: row of `Store.table`. Units: u, u/s, u/s², u/s³ with the coordinate's own unit u; seconds."""

    SET_P = 0
    SET_V = 1
    SET_A = 2
    ACTUAL_P = 3
    SET_J = 4
    # the piece a generator is on, and where its profile begins
    END_TIME = 5
    PIECE_TIME = 6
    PIECE_P = 7
    PIECE_V = 8
    PIECE_A = 9
    PIECE_J = 10
    TICK = 11
    OFFSET = 12
    # limits in force from this tick on
    MAX_V = 13
    MAX_A = 14
    MAX_D = 15
    MAX_J = 16
    MIN_P = 17
    MAX_P = 18
    # states as numbers
    STATE = 19
    OVERRIDE = 20
    # between coordinate and drive: drive position = position - shift; request, status and input are 0 or 1
    SHIFT = 21
    ENABLE = 22
    READY = 23
    HOME_INPUT = 24
    HOME_LATCH = 25


PIECE_FIELDS: Final = 5
"""A piece is (time since the profile began, p, v, a at its start, jerk)."""
