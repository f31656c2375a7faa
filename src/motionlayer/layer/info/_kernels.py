"""Filling `ST_AXIS_INFO` of all axes in one pass; numbers of columns are words."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.nc import NCTOPLC_AXIS_REF, OpModeDWord, StateDWord

Words = NDArray[np.uint16]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def _word(name: str) -> int:
    """Return the first word of a field of `NcToPlc`."""
    return int(NCTOPLC_AXIS_REF.fields[name][1]) // 2  # type: ignore[index]


STATE_DWORD: Final = _word("StateDWord")
ERROR_CODE: Final = _word("ErrorCode")
COUPLE_STATE: Final = _word("CoupleState")
AXIS_ID: Final = _word("AxisId")
OP_MODE: Final = _word("OpModeDWord")
ACT_POS: Final = _word("ActPos")
ACT_VELO: Final = _word("ActVelo")
POS_DIFF: Final = _word("PosDiff")

HOMED: Final = int(StateDWord.Homed)
NOT_MOVING: Final = int(StateDWord.NotMoving)
IN_TARGET: Final = int(StateDWord.InTargetPosition)
HAS_JOB: Final = int(StateDWord.HasJob)
CLOSED: Final = int(StateDWord.ControlLoopClosed)
IN_ERROR: Final = int(StateDWord.Error)
WATCHED: Final = int(OpModeDWord.TargetPositionMonitoring)

# Bits of Flag, and of the first byte of ST_AXIS_INFO.
INITIALISED: Final = 1
JOB_ERROR: Final = 2
JOB_TIMEOUT: Final = 4
REQUESTED: Final = 8

ENABLED: Final = 1
REFERENCED: Final = 2
READY: Final = 4
BUSY: Final = 8
ERROR: Final = 16
TIMEOUT: Final = 32
INTARGET: Final = 64
STANDSTILL: Final = 128

# Words of ST_AXIS_INFO behind the bits.
ERROR_ID: Final = 1
POSITION: Final = 3
VELOCITY: Final = 7
LAG: Final = 11
COUPLING: Final = 15
ID: Final = 17
LREAL_WORDS: Final = 4


# Rows of what is kept per axis: flags and error number of its controller, error number of the axis and its switch in
# the call before, and places that a call has found.
FLAGS: Final = 0
ERRORS: Final = 1
LAST_ERROR: Final = 2
LAST_SWITCH: Final = 3
NEW_ERRORS: Final = 4
TURNED: Final = 5
ROWS: Final = 6

COUNT_BITS: Final = 32


@kernel
def dword(words: Words, i: int, at: int) -> int:
    """Return an unsigned value of 32 bits."""
    low, high = np.int64(words[i, at]), np.int64(words[i, at + 1])  # signed, so that it goes with other integers
    return low | high << 16  # type: ignore[return-value]


@kernel
def info_bits(state: int, watched: int, flags: int, error: bool) -> int:
    """Return the bits of an axis.

    An axis that watches no target window is in its target when it does not move.
    """
    bits = ENABLED if state & CLOSED != 0 else 0
    busy = state & HAS_JOB != 0 or flags & REQUESTED != 0
    if state & HOMED != 0:
        bits |= REFERENCED
    if flags & INITIALISED != 0 and bits & ENABLED != 0 and not busy and not error:
        bits |= READY
    if busy:
        bits |= BUSY
    if error:
        bits |= ERROR
    if flags & JOB_TIMEOUT != 0:
        bits |= TIMEOUT
    if state & (IN_TARGET if watched != 0 else NOT_MOVING) != 0:
        bits |= INTARGET
    if state & NOT_MOVING != 0 and not error:
        bits |= STANDSTILL
    return bits


@kernel
def copy(source: Words, shown: Words, i: int, at: int, to: int, count: int) -> None:
    """Copy words of a row."""
    for k in range(count):
        shown[i, to + k] = source[i, at + k]


@kernel
def fill_info(source: Words, shown: Words, memory: Ints, switches: Floats) -> int:
    """Fill Info of all axes; put places with a new error into `NEW_ERRORS`, those of turned switches into `TURNED`.

    Args:
        source: `NcToPlc`, one row per axis.
        shown: `ST_AXIS_INFO`, one row per axis.
        memory: rows `FLAGS` to `TURNED`, one column per axis.
        switches: of the drives, 1.0 is on.

    Returns:
        How many new errors there are, and above `COUNT_BITS` how many switches have turned.
    """
    errors, turned = 0, 0
    for i in range(source.shape[0]):
        state, code, flags = dword(source, i, STATE_DWORD), dword(source, i, ERROR_CODE), memory[FLAGS, i]
        error = flags & JOB_ERROR != 0 or state & IN_ERROR != 0 or code != 0
        watched = dword(source, i, OP_MODE) & WATCHED
        shown[i, 0] = info_bits(state, watched, flags, error)
        number = memory[ERRORS, i] if memory[ERRORS, i] != 0 else code
        shown[i, ERROR_ID] = number & 0xFFFF
        shown[i, ERROR_ID + 1] = number >> 16
        copy(source, shown, i, ACT_POS, POSITION, LREAL_WORDS)
        copy(source, shown, i, ACT_VELO, VELOCITY, LREAL_WORDS)
        copy(source, shown, i, POS_DIFF, LAG, LREAL_WORDS)
        copy(source, shown, i, COUPLE_STATE, COUPLING, 2)
        copy(source, shown, i, AXIS_ID, ID, 2)
        if code != memory[LAST_ERROR, i]:
            memory[LAST_ERROR, i] = code
            if code != 0:
                memory[NEW_ERRORS, errors] = i
                errors += 1
        on = int(switches[i])
        if on != memory[LAST_SWITCH, i]:
            memory[LAST_SWITCH, i] = on
            memory[TURNED, turned] = i
            turned += 1
    return errors | turned << COUNT_BITS
