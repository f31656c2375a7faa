"""`E_PROGRESS`: how far a job is (motion-layer 2.1)."""

import enum


class Progress(enum.IntEnum):
    """The published state of a job is its command plus one of these (5.1).

    The order of the numbers is not the order of the steps: each job has its own, which its table tells.
    """

    INVALID = 0
    NOT_EXIST = 100
    INIT = 1000
    BUSY = 2000
    PREPARE = 3000
    STARTUP = 4000
    CHECK = 5000
    OCCUPIED = 6000
    WORKING = 7000
    STILL_WORKING = 8000
    ERROR = 9000
    DONE = 10000
