"""Error ids with name, meaning and advice.

Source: TwinCAT NC error codes, meanings in own words. From 0xF000 on they are our own.
"""

import enum
from typing import Final, NamedTuple


class ErrorId(enum.IntEnum):
    """What a command or an axis reports."""

    INTERNAL = 0x4000
    VELOCITY = 0x4221
    TARGET_OUTSIDE_LIMITS = 0x4222
    JERK = 0x422E
    ACCELERATION = 0x422F
    DECELERATION = 0x4230
    STOP_ACTIVE = 0x425D
    NOT_ENABLED = 0x4260
    TARGET_NOT_FINITE = 0x427B
    OVERRUN = 0x427F
    LOCKED_BY_STOP = 0x42EF
    TARGET_TIMEOUT = 0x435C
    BELOW_MINIMUM = 0x4460
    ABOVE_MAXIMUM = 0x4461
    MINIMUM_PASSED = 0x4462
    MAXIMUM_PASSED = 0x4463
    ENCODER = 0x4464
    LAG = 0x4550
    DRIVE_NOT_READY = 0x4650
    IO_DATA_INVALID = 0x4655
    CANNOT_START = 0x4B01
    PARAMETER = 0x4B06
    PROGRAM_FAILED = 0xF000


class ErrorText(NamedTuple):
    """What an error means, and what to do about it."""

    text: str
    advice: str


ERRORS: Final[dict[ErrorId, ErrorText]] = {
    ErrorId.INTERNAL: ErrorText("internal error", "please report it with the input that the message holds"),
    ErrorId.VELOCITY: ErrorText("velocity not positive or above the maximum", "see max_velocity"),
    ErrorId.TARGET_OUTSIDE_LIMITS: ErrorText("target outside the software limits", "see software_limit_min/max"),
    ErrorId.JERK: ErrorText("jerk not positive or above the maximum", "see max_jerk"),
    ErrorId.ACCELERATION: ErrorText("acceleration not positive or above the maximum", "see max_acceleration"),
    ErrorId.DECELERATION: ErrorText("deceleration not positive or above the maximum", "see max_deceleration"),
    ErrorId.STOP_ACTIVE: ErrorText("a stop is active already", "wait until it has ended"),
    ErrorId.NOT_ENABLED: ErrorText("the axis is not enabled", "enable it and wait for the command to be done"),
    ErrorId.TARGET_NOT_FINITE: ErrorText("target is not a finite number", "command a finite position or distance"),
    ErrorId.OVERRUN: ErrorText(
        "the way to the target would leave the software limits",
        "brake harder, or stop before the new command",
    ),
    ErrorId.LOCKED_BY_STOP: ErrorText("the axis is locked by a stop", "wait until the stop has ended"),
    ErrorId.TARGET_TIMEOUT: ErrorText(
        "the axis has not come into its target window in time", "see target_window; look for what holds it"
    ),
    ErrorId.BELOW_MINIMUM: ErrorText("start at or below the minimum software limit", "move in positive direction"),
    ErrorId.ABOVE_MAXIMUM: ErrorText("start at or above the maximum software limit", "move in negative direction"),
    ErrorId.MINIMUM_PASSED: ErrorText("minimum software limit reached in motion", "reset, then move away from it"),
    ErrorId.MAXIMUM_PASSED: ErrorText("maximum software limit reached in motion", "reset, then move away from it"),
    ErrorId.ENCODER: ErrorText("encoder error", "reset, enable, then home: the position may have moved"),
    ErrorId.LAG: ErrorText("position lag too large for too long", "see lag and lag_time; look for what holds it"),
    ErrorId.DRIVE_NOT_READY: ErrorText("the drive is not ready", "mend its error, then reset and enable"),
    ErrorId.IO_DATA_INVALID: ErrorText("no valid data from the drive for too many cycles", "reset, then enable"),
    ErrorId.CANNOT_START: ErrorText(
        "the axis cannot start this in its state",
        "reset() an axis in ErrorStop; wait for the end of a homing, or stop() it",
    ),
    ErrorId.PROGRAM_FAILED: ErrorText("a program failed", "see the exception that left it"),
    ErrorId.PARAMETER: ErrorText("parameter out of range", "see the range in the message"),
}
