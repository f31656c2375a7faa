"""What motion-layer says about commands and states of an axis, as numbers: 2.1, 2.2, 5.1 to 5.5, and 9.1 corrected.

The oracle of the motion layer knows the layer from this text alone. Nothing here is taken from its code, so that one
misreading cannot agree with itself.
"""

import re
from typing import Final

NOT_EXIST: Final = 100
INIT: Final = 1000
PREPARE: Final = 3000
STARTUP: Final = 4000
ERROR: Final = 9000
DONE: Final = 10000
"""Values of `E_PROGRESS` that mean the same to every command."""

FINAL: Final = (NOT_EXIST, ERROR, DONE)

NULL: Final = 0
AXIS_INIT: Final = 1
DISABLE: Final = 2
ENABLE: Final = 3
NO_INIT: Final = 9
IDLE: Final = 10
HOME: Final = 11
MOVE_POS: Final = 12
MOVE_VELO: Final = 13
HALT: Final = 14
STOP: Final = 15
SEND_TO_POS: Final = 16
RESET: Final = 19
MOVE_BUFFER: Final = 30
MOVE_BUFFER_VELO: Final = 31
READ: Final = 40
WRITE: Final = 41
WRITE_PERSISTENT: Final = 42

ABSENT: Final = (20, 50, 51, 52, *range(60, 72))
"""Commands that the enumeration knows and an axis without coupling, cam and saw does not carry out."""

LARGEST: Final = 999
"""Command numbers that a state has room for."""

ENDLESS: Final = (MOVE_BUFFER, MOVE_BUFFER_VELO)
"""Commands that end when `eProgress` says so."""

SWITCHING: Final = (AXIS_INIT, DISABLE, ENABLE, IDLE, RESET)
"""Commands whose steps are supervised (D6)."""

CLEARING: Final = (AXIS_INIT, IDLE)
"""Commands whose success clears bError (D14)."""

Steps = dict[int, tuple[int, ...]]

_ONE_STEP: Final[Steps] = {1000: (6000,), 6000: (DONE,)}
_PARAMETER: Final[Steps] = {1000: (6000,), 6000: (7000,), 7000: (DONE,)}

STEPS: Final[dict[int, Steps]] = {
    AXIS_INIT: {1000: (4000,), 4000: (3000,), 3000: (5000, DONE), 5000: (6000,), 6000: (DONE,)},
    DISABLE: _ONE_STEP,
    ENABLE: _ONE_STEP,
    IDLE: {1000: (2000,), 2000: (5000, 3000), 5000: (3000, DONE), 3000: (2000,)},
    HOME: {1000: (4000, 6000), 4000: (6000,), 6000: (DONE,)},
    MOVE_POS: _ONE_STEP,
    MOVE_VELO: _ONE_STEP,
    HALT: _ONE_STEP,
    STOP: _ONE_STEP,
    SEND_TO_POS: _ONE_STEP,
    RESET: _ONE_STEP,
    MOVE_BUFFER: {
        1000: (3000, 4000, DONE),
        3000: (5000, 6000, DONE),
        5000: (6000, DONE),
        6000: (4000, DONE),
        4000: (3000, DONE),
    },
    MOVE_BUFFER_VELO: {1000: (7000, DONE), 7000: (DONE,)},
    READ: _PARAMETER,
    WRITE: _PARAMETER,
    WRITE_PERSISTENT: _PARAMETER,
}
"""Per command: what each progress may be followed by (5.5, 5.8). ERROR may follow each of them."""

CALLS: Final[dict[int, tuple[str, ...]]] = {
    AXIS_INIT: ("reset",),
    DISABLE: ("reset", "disable"),
    ENABLE: ("reset", "enable"),
    IDLE: ("reset", "enable"),
    HOME: ("home",),
    MOVE_POS: ("move_absolute",),
    MOVE_VELO: ("move_velocity",),
    HALT: ("halt",),
    STOP: ("stop",),
    SEND_TO_POS: ("move_absolute",),
    RESET: ("reset",),
    MOVE_BUFFER: ("move_absolute",),
    MOVE_BUFFER_VELO: ("move_velocity",),
    READ: ("read_parameter",),
    WRITE: ("write_parameter",),
    WRITE_PERSISTENT: ("write_parameter",),
}
"""Per command: what it may ask of the axis; all others, NULL among them, ask nothing (5.5, 5.6)."""

MOTIONS: Final = ("move_absolute", "move_velocity", "halt", "stop", "home")
"""What occupies an axis; of these one is carried out, and one more waits in the buffer at most (5.8)."""

ONCE: Final = (MOVE_POS, MOVE_VELO, SEND_TO_POS, RESET, WRITE, WRITE_PERSISTENT)
"""Commands that ask once, in the cycle in which they are seen."""

POSITION: Final = re.compile(r"\bposition=([^,)]+)")
VELOCITY: Final = re.compile(r"\bvelocity=([^,)]+)")
"""Numbers in the call of a move, which read back exactly."""

ENABLED: Final = 0x01
REFERENCED: Final = 0x02
READY: Final = 0x04
BUSY: Final = 0x08
IN_ERROR: Final = 0x10
TIMEOUT: Final = 0x20
"""Bits of the first byte of ST_AXIS_INFO (3.2)."""


def answer(command: int, *, initialised: bool) -> int:
    """Return what State shows in the cycle in which a command is seen (5.2, 5.3; D65)."""
    if command == NULL:
        return DONE if initialised else ERROR
    if command == AXIS_INIT:
        return AXIS_INIT + INIT
    if not initialised:
        return NO_INIT + INIT
    if command in STEPS:
        return command + INIT
    if command in ABSENT:
        return command + NOT_EXIST
    return ERROR + (command if command <= LARGEST else 0)
