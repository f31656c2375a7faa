"""Encoder 0x4400, controller 0x4500, drive 0x4600."""

from typing import Final

from motionlayer.command._errors._id import ErrorId as E
from motionlayer.command._errors._text import ErrorText

DEVICES: Final = {
    E.ENCODER_TYPE: ErrorText("type of the encoder not valid"),
    E.SCALING_FACTOR: ErrorText("scaling factor not valid"),
    E.MODULO_FACTOR: ErrorText("modulo factor outside 1 to 1e9"),
    E.REFERENCE_POSITION: ErrorText("reference position not valid"),
    E.MODULO_TOLERANCE: ErrorText("tolerance window of the modulo start not valid"),
    E.REFERENCE_MODE: ErrorText(
        "reference mode not valid or not supported",
        "take one of the reference modes in the message, or give the drive the signal in the machine file",
        "MC_Home, by its `ReferenceMode`",
    ),
    E.SET_POSITION_RANGE: ErrorText(
        "the set position would leave the range of values",
        "stay within the range in the message",
        "moves, homing and setting a position, by their position",
    ),
    E.LIMIT_MIN_PARAMETER: ErrorText("minimum software limit not valid"),
    E.LIMIT_MAX_PARAMETER: ErrorText("maximum software limit not valid"),
    E.LATCH_ARMED_BY_HOMING: ErrorText("the latch is already armed by a homing"),
    E.PROBE_ARMED: ErrorText("the touch probe is already armed"),
    E.ENCODER_FUNCTION_UNSUPPORTED: ErrorText("function of the encoder not supported"),
    E.ENCODER_FUNCTION_ACTIVE: ErrorText("function of the encoder already active"),
    E.BELOW_MINIMUM: ErrorText(
        "start at or below the minimum software limit",
        "move in positive direction",
        "moves that begin outside and lead farther out",
    ),
    E.ABOVE_MAXIMUM: ErrorText(
        "start at or above the maximum software limit",
        "move in negative direction",
        "moves that begin outside and lead farther out",
    ),
    E.MINIMUM_PASSED: ErrorText(
        "minimum software limit reached in motion",
        "reset, then move away from it",
        "endless motion, and the monitor of the actual position",
    ),
    E.MAXIMUM_PASSED: ErrorText(
        "maximum software limit reached in motion",
        "reset, then move away from it",
        "endless motion, and the monitor of the actual position",
    ),
    E.ENCODER: ErrorText(
        "encoder error", "reset, enable, then home: the position may have moved", "the drive, by its status"
    ),
    E.ENCODER_DATA_INVALID: ErrorText("no valid data from the encoder for too many cycles"),
    E.LAG_PARAMETER: ErrorText("lag window not valid"),
    E.PROPORTIONAL_GAIN: ErrorText("proportional gain not valid"),
    E.LAG: ErrorText(
        "position lag too large for too long", "see lag and lag_time; look for what holds it", "the lag monitor"
    ),
    E.VELOCITY_LAG: ErrorText(
        "velocity lag too large for too long",
        "see velocity_lag and velocity_lag_time; look for what holds the axis",
        "the monitor of the velocity lag",
    ),
    E.REFERENCE_VELOCITY: ErrorText("reference velocity not valid"),
    E.OUTPUT_LIMITS: ErrorText("limits of the output not valid"),
    E.DRIVE_NOT_READY: ErrorText(
        "the drive is not ready",
        "mend its error, then reset and enable",
        "the drive, by its status; the motion layer, when it does not follow in time",
    ),
    E.COMMUNICATION_COUNTER: ErrorText(
        "communication counter of the drive wrong", "look for the connection to the drive"
    ),
    E.IO_DATA_INVALID: ErrorText(
        "no valid data from the drive for too many cycles",
        "reset, then enable",
        "the drive, after `patience` cycles without communication",
    ),
}
