"""The state machine of an axis: one table.

The states are those of PLCopen with the numbers of `MC_AxisStates`. A command meets the table before anything else:
an entry that is an `ErrorId` refuses it and nothing changes. Three machines touch: this one, the power of the drive
(request and readiness are values in the store) and the job (what the axis is executing). The table decides, the
other two deliver its events:

- a command brings MOVE, MOVE_ENDLESS, HALT, STOP, EMERGENCY_STOP, HOME, ENABLE, DISABLE or RESET when it is called;
- `enable()` without a direction in which the axis moves brings FEED_LOST;
- the drive brings READY and, at rest, OFF; readiness lost in motion is a FAULT;
- the sampler brings AT_REST when the job has come to its end;
- a monitor brings FAULT, which wins over everything.

DISABLE makes a moving axis brake; AT_REST and OFF take it on from there. RESET in ERRORSTOP waits for rest.
Sources: function-blocks 1.2 and 1.3; that a disabled axis brakes first is decision 0004.
"""

import enum
from typing import Final

from motionlayer.command import ErrorId


class AxisState(enum.IntEnum):
    """`MC_AxisStates`."""

    UNDEFINED = 0
    DISABLED = 1
    STANDSTILL = 2
    ERRORSTOP = 3
    STOPPING = 4
    HOMING = 5
    DISCRETE_MOTION = 6
    CONTINUOUS_MOTION = 7
    SYNCHRONIZED_MOTION = 8

    def __str__(self) -> str:
        """Return the name that PLCopen gives it."""
        return _NAMES[self]


class AxisEvent(enum.Enum):
    """What can happen to an axis."""

    __hash__ = object.__hash__  # members are single: that of `Enum` is Python code, and every command asks for it

    ENABLE = "enable"
    READY = "ready"
    DISABLE = "disable"
    OFF = "off"
    RESET = "reset"
    RESET_OFF = "reset without power"
    MOVE = "move"
    MOVE_ENDLESS = "move endless"
    HALT = "halt"
    STOP = "stop"
    HOME = "home"
    AT_REST = "at rest"
    EMERGENCY_STOP = "emergency stop"
    FEED_LOST = "feed enable lost"
    FAULT = "fault"


NEED_POWER: Final = frozenset(
    {
        AxisEvent.MOVE,
        AxisEvent.MOVE_ENDLESS,
        AxisEvent.HALT,
        AxisEvent.STOP,
        AxisEvent.EMERGENCY_STOP,
        AxisEvent.HOME,
    }
)
"""Commands that a switched-off drive does not take, even before it has followed the request."""

_NAMES: Final = (
    "Undefined",
    "Disabled",
    "StandStill",
    "ErrorStop",
    "Stopping",
    "Homing",
    "DiscreteMotion",
    "ContinuousMotion",
    "SynchronizedMotion",
)

_S, _E = AxisState, AxisEvent

_NO_POWER: Final = ErrorId.NOT_ENABLED
_ERROR: Final = ErrorId.CANNOT_START
_LOCKED: Final = ErrorId.LOCKED_BY_STOP

TRANSITIONS: Final[dict[AxisState, dict[AxisEvent, AxisState | ErrorId]]] = {
    _S.DISABLED: {
        _E.ENABLE: _S.DISABLED,
        _E.READY: _S.STANDSTILL,
        _E.DISABLE: _S.DISABLED,
        _E.OFF: _S.DISABLED,
        _E.RESET_OFF: _S.DISABLED,
        _E.MOVE: _NO_POWER,
        _E.MOVE_ENDLESS: _NO_POWER,
        _E.HALT: _NO_POWER,
        _E.STOP: _NO_POWER,
        _E.EMERGENCY_STOP: _NO_POWER,
        _E.HOME: _NO_POWER,
        _E.FAULT: _S.ERRORSTOP,
    },
    _S.STANDSTILL: {
        _E.ENABLE: _S.STANDSTILL,
        _E.DISABLE: _S.STANDSTILL,
        _E.OFF: _S.DISABLED,
        _E.RESET: _S.STANDSTILL,
        _E.MOVE: _S.DISCRETE_MOTION,
        _E.MOVE_ENDLESS: _S.CONTINUOUS_MOTION,
        _E.HALT: _S.DISCRETE_MOTION,
        _E.STOP: _S.STOPPING,
        _E.EMERGENCY_STOP: _S.STOPPING,
        _E.HOME: _S.HOMING,
        _E.FAULT: _S.ERRORSTOP,
    },
    _S.DISCRETE_MOTION: {
        _E.ENABLE: _S.DISCRETE_MOTION,
        _E.DISABLE: _S.STOPPING,
        _E.RESET: _S.DISCRETE_MOTION,
        _E.MOVE: _S.DISCRETE_MOTION,
        _E.MOVE_ENDLESS: _S.CONTINUOUS_MOTION,
        _E.HALT: _S.DISCRETE_MOTION,
        _E.STOP: _S.STOPPING,
        _E.EMERGENCY_STOP: _S.STOPPING,
        _E.HOME: _ERROR,
        _E.AT_REST: _S.STANDSTILL,
        _E.FEED_LOST: _S.STOPPING,
        _E.FAULT: _S.ERRORSTOP,
    },
    _S.CONTINUOUS_MOTION: {
        _E.ENABLE: _S.CONTINUOUS_MOTION,
        _E.DISABLE: _S.STOPPING,
        _E.RESET: _S.CONTINUOUS_MOTION,
        _E.MOVE: _S.DISCRETE_MOTION,
        _E.MOVE_ENDLESS: _S.CONTINUOUS_MOTION,
        _E.HALT: _S.DISCRETE_MOTION,
        _E.STOP: _S.STOPPING,
        _E.EMERGENCY_STOP: _S.STOPPING,
        _E.HOME: _ERROR,
        _E.AT_REST: _S.STANDSTILL,
        _E.FEED_LOST: _S.STOPPING,
        _E.FAULT: _S.ERRORSTOP,
    },
    _S.STOPPING: {
        _E.ENABLE: _LOCKED,
        _E.DISABLE: _S.STOPPING,
        _E.RESET: _S.STOPPING,
        _E.MOVE: _LOCKED,
        _E.MOVE_ENDLESS: _LOCKED,
        _E.HALT: _LOCKED,
        _E.STOP: ErrorId.STOP_ACTIVE,
        _E.EMERGENCY_STOP: _S.STOPPING,
        _E.HOME: _LOCKED,
        _E.AT_REST: _S.STANDSTILL,
        _E.FAULT: _S.ERRORSTOP,
    },
    _S.HOMING: {
        _E.ENABLE: _S.HOMING,
        _E.DISABLE: _S.STOPPING,
        _E.RESET: _S.HOMING,
        _E.MOVE: _ERROR,
        _E.MOVE_ENDLESS: _ERROR,
        _E.HALT: _ERROR,
        _E.STOP: _S.STOPPING,
        _E.EMERGENCY_STOP: _S.STOPPING,
        _E.HOME: _ERROR,
        _E.AT_REST: _S.STANDSTILL,
        _E.FEED_LOST: _S.STOPPING,
        _E.FAULT: _S.ERRORSTOP,
    },
    _S.ERRORSTOP: {
        _E.ENABLE: _ERROR,
        _E.READY: _S.ERRORSTOP,
        _E.DISABLE: _S.ERRORSTOP,
        _E.OFF: _S.ERRORSTOP,
        _E.RESET: _S.STANDSTILL,
        _E.RESET_OFF: _S.DISABLED,
        _E.MOVE: _ERROR,
        _E.MOVE_ENDLESS: _ERROR,
        _E.HALT: _ERROR,
        _E.STOP: _ERROR,
        _E.EMERGENCY_STOP: _ERROR,
        _E.HOME: _ERROR,
        _E.AT_REST: _S.ERRORSTOP,
        _E.FAULT: _S.ERRORSTOP,
    },
}
"""Per state and event: the next state, or the error that refuses the command. What is missing cannot happen."""
