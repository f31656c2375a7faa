"""Enumerations of the motion libraries that are visible on the interface (motion-layer 2.9).

The numbers of `BufferMode` and `HomingMode` are those of the compiled libraries. `motionlayer.nc` counts its own
through, as function-blocks 2.3 and 2.10 do; `NC_BUFFER_MODES` and `NC_CALIBRATIONS` lead from the one to the other.
"""

import enum
from collections.abc import Mapping
from typing import Final

from motionlayer import nc


class BufferMode(enum.IntEnum):
    """`MC_BufferMode`: when a motion begins that is given while another one runs."""

    ABORTING = 0
    BUFFERED = 1
    BLENDING_LOW = 18
    BLENDING_PREVIOUS = 19
    BLENDING_NEXT = 20
    BLENDING_HIGH = 21


NC_BUFFER_MODES: Final[Mapping[int, nc.BufferMode]] = {mode.value: nc.BufferMode[mode.name] for mode in BufferMode}
"""The mode of the NC by the number on the interface."""


class HomingMode(enum.IntEnum):
    """`MC_HomingMode`: how an axis is referenced."""

    DEFAULT = 0
    ABS_SWITCH = 1
    LIMIT_SWITCH = 2
    REF_PULSE = 3
    DIRECT = 4
    ABSOLUTE = 5
    BLOCK = 6
    FORCE_CALIBRATION = 7
    RESET_CALIBRATION = 8


NC_CALIBRATIONS: Final[Mapping[int, nc.Calibration]] = {
    HomingMode.DEFAULT: nc.Calibration.DEFAULT,
    HomingMode.DIRECT: nc.Calibration.DIRECT,
    HomingMode.FORCE_CALIBRATION: nc.Calibration.FORCE,
    HomingMode.RESET_CALIBRATION: nc.Calibration.RESET,
}
"""What the NC is told by the number on the interface; it has nothing for the others."""


class MultiMasterSyncMode(enum.IntEnum):
    """`E_GearInMultiMasterSyncMode`."""

    VELOSYNC = 0
    POSSYNC1 = 1
    POSSYNC2 = 2


class GearInSyncMode(enum.IntEnum):
    """`E_GearInSyncMode`: what the flying saw synchronises by."""

    POSITIONBASED = 0
    TIMEBASED = 1


class SignalEdge(enum.IntEnum):
    """`E_SignalEdge`."""

    RISING = 0
    FALLING = 1
