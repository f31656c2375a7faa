"""Rows of the table. The first four are what the hash of a run is taken over, and stay together."""

from typing import Final


class Q:
    """Quantity: row of `Store.table`. Units: u, u/s, u/s², u/s³ with the coordinate's own unit u; seconds.

    Plain integers: an enumeration would double the time of every single access. A compiled kernel knows numbers of its
    own module, but no attributes of a class: each module of kernels names the rows that it works on.
    """

    SET_P: Final = 0
    SET_V: Final = 1
    SET_A: Final = 2
    ACTUAL_P: Final = 3
    SET_J: Final = 4
    # the piece a generator is on, and where its profile begins
    END_TIME: Final = 5
    PIECE_TIME: Final = 6
    PIECE_P: Final = 7
    PIECE_V: Final = 8
    PIECE_A: Final = 9
    PIECE_J: Final = 10
    TICK: Final = 11
    OFFSET: Final = 12
    # limits in force from this tick on
    MAX_V: Final = 13
    MAX_A: Final = 14
    MAX_D: Final = 15
    MAX_J: Final = 16
    MIN_P: Final = 17
    MAX_P: Final = 18
    # states as numbers
    STATE: Final = 19
    OVERRIDE: Final = 20
    # between coordinate and drive: drive position = position - shift; request, status and input are 0 or 1
    SHIFT: Final = 21
    ENABLE: Final = 22
    READY: Final = 23
    HOME_INPUT: Final = 24
    HOME_LATCH: Final = 25
    # what the override scales: kind of job (see `JOB_*`), its target and velocity before the override
    JOB_KIND: Final = 26
    JOB_TARGET: Final = 27
    JOB_V: Final = 28
    COMMAND: Final = 29
    REQUEST: Final = 30
    # set(n - dead time) - actual(n); bits of `Status`; 1 asks the drive to clear its errors, which sets it to 0
    LAG: Final = 31
    STATUS: Final = 32
    DRIVE_RESET: Final = 33
    # where the motion in force ends, NaN where it does not
    TARGET: Final = 34
    # for the image of the cyclic interface: bits of `StateDWord` that change with commands, not with cycles; id of
    # the axis error; phase of the homing; bits of the monitors' windows
    FLAGS: Final = 35
    ERROR: Final = 36
    HOMING: Final = 37
    WINDOWS: Final = 38
    # what the drive is asked to latch, one of `Latch`, which sets it to 0 when it has come; the drive position of that
    LATCH_ASKED: Final = 39
    LATCH_P: Final = 40

    COUNT: Final = 41


class Status:
    """Bits of the row `Q.STATUS`: what a drive reports beside its readiness. Errors stay until they are reset."""

    DRIVE_ERROR: Final = 1
    ENCODER_ERROR: Final = 2
    INVALID: Final = 4
    """No communication: the actual values are those of an earlier tick."""
    LOST: Final = 8
    """Error: invalid for too many cycles."""


class Latch:
    """Value of the row `Q.LATCH_ASKED`: what a drive is asked to latch; 0 for nothing."""

    ZERO_PULSE: Final = 1
    OVERFLOW: Final = 2
    """Of the encoder's count."""
    RISING: Final = 3
    """Edge of the latch input, by hardware."""
    FALLING: Final = 4
    SOFT_RISING: Final = 5
    """The same by the program of the drive, which reads its input once per cycle."""
    SOFT_FALLING: Final = 6


JOB_OTHER: Final = 0
"""Nothing, or a motion that the override leaves alone."""

JOB_POSITION: Final = 1
"""Towards rest at `JOB_TARGET`."""

JOB_VELOCITY: Final = 2
"""Towards the signed velocity `JOB_TARGET`."""

JOB_COMPOUND: Final = 3
"""A motion of several parts, which only its axis can plan anew."""

JOB_BRAKE: Final = 4
"""A brake, which the override leaves alone, and a motion after it, which only its axis can plan anew."""

PIECE_FIELDS: Final = 5
"""A piece is (time since the profile began, p, v, a at its start, jerk)."""
