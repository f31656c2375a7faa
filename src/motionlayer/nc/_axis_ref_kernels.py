"""Filling `NcToPlc` of all axes in one pass.

The buffer is seen as three arrays of the same bytes: float64, int32 and uint16, one row per axis. Numbers of columns
are byte offsets of `NCTOPLC_AXIS_REF` divided by the size of an item.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.nc._actual_kernels import ACCELERATION, VELOCITY
from motionlayer.nc._axis_ref import BUFFERED, HAS_JOB, NCTOPLC_AXIS_REF, OpModeDWord, StateDWord
from motionlayer.store import Q, Status

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Words = NDArray[np.uint16]


def _column(name: str) -> int:
    """Return the column of a field in the array of its type."""
    dtype, offset = NCTOPLC_AXIS_REF.fields[name][:2]  # type: ignore[index]
    return int(offset) // dtype.itemsize


SET_P: Final = Q.SET_P
SET_V: Final = Q.SET_V
SET_A: Final = Q.SET_A
SET_J: Final = Q.SET_J
ACTUAL_P: Final = Q.ACTUAL_P
MIN_P: Final = Q.MIN_P
MAX_P: Final = Q.MAX_P
STATE: Final = Q.STATE
OVERRIDE: Final = Q.OVERRIDE
READY: Final = Q.READY
COMMAND: Final = Q.COMMAND
LAG: Final = Q.LAG
STATUS: Final = Q.STATUS
TARGET: Final = Q.TARGET
FLAGS: Final = Q.FLAGS
ERROR: Final = Q.ERROR
HOMING: Final = Q.HOMING
WINDOWS: Final = Q.WINDOWS

STATE_DWORD: Final = _column("StateDWord")
ERROR_CODE: Final = _column("ErrorCode")
AXIS_STATE: Final = _column("AxisState")
HOMING_STATE: Final = _column("HomingState")
SAF_ENTRIES: Final = _column("SafEntries")
OP_MODE: Final = _column("OpModeDWord")
MODULO_ACT_TURNS: Final = _column("ModuloActTurns")
MODULO_SET_TURNS: Final = _column("ModuloSetTurns")
TIME_STAMP: Final = _column("DcTimeStamp")
CMD_NO: Final = _column("CmdNo")
CMD_STATE: Final = _column("CmdState")
ACT_POS: Final = _column("ActPos")
MODULO_ACT_POS: Final = _column("ModuloActPos")
ACT_VELO: Final = _column("ActVelo")
POS_DIFF: Final = _column("PosDiff")
SET_POS: Final = _column("SetPos")
SET_VELO: Final = _column("SetVelo")
SET_ACC: Final = _column("SetAcc")
TARGET_POS: Final = _column("TargetPos")
MODULO_SET_POS: Final = _column("ModuloSetPos")
SET_JERK: Final = _column("SetJerk")
ACT_POS_RAW: Final = _column("ActPosWithoutPosCorrection")
ACT_ACC: Final = _column("ActAcc")

OPERATIONAL: Final = int(StateDWord.Operational | StateDWord.ControlLoopClosed)
NOT_MOVING: Final = int(StateDWord.NotMoving)
POSITIVE: Final = int(StateDWord.PositiveDirection)
NEGATIVE: Final = int(StateDWord.NegativeDirection)
CONSTANT: Final = int(StateDWord.ConstantVelocity)
HOMING_BUSY: Final = int(StateDWord.HomingBusy)
LOCKED: Final = int(StateDWord.MotionCommandsLocked)
CONTINUOUS: Final = int(StateDWord.ContinuousMotion)
LIMIT_MIN: Final = int(StateDWord.SoftLimitMinExceeded)
LIMIT_MAX: Final = int(StateDWord.SoftLimitMaxExceeded)
DRIVE_ERROR: Final = int(StateDWord.DriveDeviceError)
IO_INVALID: Final = int(StateDWord.IoDataInvalid)
IN_ERROR: Final = int(StateDWord.Error)
WINDOW_SHIFT: Final = int(StateDWord.InPositionArea).bit_length() - 1
"""The bits of `Q.WINDOWS` are those of `InPositionArea` and `InTargetPosition`, from bit 0 on."""

STATUS_ERROR: Final = Status.DRIVE_ERROR | Status.ENCODER_ERROR
STATUS_INVALID: Final = Status.INVALID | Status.LOST
CYCLE_SHIFT: Final = int(OpModeDWord.NcApplicationRequest).bit_length()

ERRORSTOP: Final = 3
STOPPING: Final = 4
HOMING_STATE_OF_AXIS: Final = 5
CONTINUOUS_MOTION: Final = 7

INACTIVE: Final = 0
RUNNING: Final = 1
OVERRIDE_ZERO: Final = 2
CONSTANT_VELOCITY: Final = 3
ACCELERATING: Final = 4
DECELERATING: Final = 5


@kernel
def motion_bits(v: float, a: float, flags: int) -> int:
    """Return the bits of `StateDWord` that follow from the setpoint."""
    if v == 0.0:
        return NOT_MOVING if flags & HAS_JOB == 0 else 0
    bits = POSITIVE if v > 0.0 else NEGATIVE
    return bits | CONSTANT if a == 0.0 else bits


@kernel
def state_bits(state: int, ready: float, status: int) -> int:
    """Return the bits of `StateDWord` that follow from the state and the drive."""
    bits = OPERATIONAL if ready != 0.0 else 0
    if state == HOMING_STATE_OF_AXIS:
        bits |= HOMING_BUSY
    elif state == STOPPING:
        bits |= LOCKED
    elif state == CONTINUOUS_MOTION:
        bits |= CONTINUOUS
    elif state == ERRORSTOP:
        bits |= IN_ERROR
    if status & STATUS_ERROR != 0:
        bits |= DRIVE_ERROR
    if status & STATUS_INVALID != 0:
        bits |= IO_INVALID
    return bits


@kernel
def axis_state(flags: int, v: float, a: float, override: float) -> int:
    """Return `AxisState` of a master axis (function-blocks 3.4)."""
    if flags & HAS_JOB == 0 and v == 0.0:
        return INACTIVE
    if v == 0.0 and a == 0.0:
        return OVERRIDE_ZERO if override == 0.0 else RUNNING
    if a == 0.0:
        return CONSTANT_VELOCITY
    return DECELERATING if v * a < 0.0 else ACCELERATING


@kernel
def turns_of(p: float, period: float) -> float:
    """Return how many periods lie below p, so that what is left is in 0 <= m < period also after rounding."""
    turns = math.floor(p / period)
    return turns + 1.0 if p - turns * period >= period else turns


@kernel
def word(bits: int) -> int:
    """Return an unsigned 32-bit value as the signed one of the same bytes."""
    return bits - (bits >> 31 << 32)


@kernel
def fill(
    table: Floats,
    reals: Floats,
    ints: Ints,
    words: Words,
    actual_motion: Floats,
    periods: Floats,
    op_mode: Ints,
    tick: int,
    cycle_ns: int,
) -> None:
    """Fill the cyclic fields of all axes with what is valid at `tick`."""
    set_p, set_v, set_a, set_j = table[SET_P], table[SET_V], table[SET_A], table[SET_J]
    actual, low, high, target = table[ACTUAL_P], table[MIN_P], table[MAX_P], table[TARGET]
    velocity, acceleration = actual_motion[VELOCITY], actual_motion[ACCELERATION]
    cycles = word((tick & 255) << CYCLE_SHIFT)
    stamp = word(tick * cycle_ns & 0xFFFFFFFF)
    for i in range(reals.shape[0]):
        p, v, a, act, period = set_p[i], set_v[i], set_a[i], actual[i], periods[i]
        flags, state = int(table[FLAGS, i]), int(table[STATE, i])
        bits = flags | motion_bits(v, a, flags) | state_bits(state, table[READY, i], int(table[STATUS, i]))
        bits |= int(table[WINDOWS, i]) << WINDOW_SHIFT
        if act < low[i]:
            bits |= LIMIT_MIN
        elif act > high[i]:
            bits |= LIMIT_MAX
        set_turns, act_turns = turns_of(p, period), turns_of(act, period)
        command = int(table[COMMAND, i])
        ints[i, STATE_DWORD] = word(bits)
        ints[i, ERROR_CODE] = int(table[ERROR, i])
        ints[i, AXIS_STATE] = axis_state(flags, v, a, table[OVERRIDE, i])
        ints[i, HOMING_STATE] = int(table[HOMING, i])
        ints[i, SAF_ENTRIES] = (1 if flags & HAS_JOB != 0 else 0) + (1 if flags & BUFFERED != 0 else 0)
        ints[i, OP_MODE] = op_mode[i] | cycles
        ints[i, MODULO_ACT_TURNS] = int(act_turns)
        ints[i, MODULO_SET_TURNS] = int(set_turns)
        ints[i, TIME_STAMP] = stamp
        words[i, CMD_NO] = command & 0xFFFF
        words[i, CMD_STATE] = 1 if flags & HAS_JOB != 0 else 0
        reals[i, ACT_POS] = act
        reals[i, ACT_POS_RAW] = act
        reals[i, MODULO_ACT_POS] = max(act - act_turns * period, 0.0)
        reals[i, ACT_VELO] = velocity[i]
        reals[i, ACT_ACC] = acceleration[i]
        reals[i, POS_DIFF] = table[LAG, i]
        reals[i, SET_POS] = p
        reals[i, SET_VELO] = v
        reals[i, SET_ACC] = a
        reals[i, SET_JERK] = set_j[i]
        reals[i, TARGET_POS] = target[i] if target[i] == target[i] else p
        reals[i, MODULO_SET_POS] = max(p - set_turns * period, 0.0)
