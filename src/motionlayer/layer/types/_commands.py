"""Commands of axes, cams and flying saws, and of the NCI (motion-layer 2.2, 2.3).

A state holds the number of its command plus a `Progress`; therefore every command has a state of the same number, and
the state enumerations name what a state holds after the progress is taken off.
"""

import enum
from typing import Final


class AxisCommand(enum.IntEnum):
    """`E_AXIS_CTRL`: what is dropped into the command field of an axis, a cam or a flying saw."""

    NULL = 0
    INIT = 1
    DISABLE = 2
    ENABLE = 3
    IDLE = 10
    HOME = 11
    MOVE_POS = 12
    MOVE_VELO = 13
    HALT = 14
    STOP = 15
    SEND_TO_POS = 16
    RESET = 19
    STARTUP = 20

    # endless jobs, fed with further motions
    MOVE_BUFFER = 30
    MOVE_BUFFER_VELO = 31

    PARAMETER_READ = 40
    PARAMETER_WRITE = 41
    PARAMETER_WRITE_PERSISTENT = 42

    GEAR_IN = 50
    GEAR_OUT = 51
    GEAR_IN_MULTIMASTER = 52

    CAM_INIT = 60
    CAM_IN = 61
    CAM_OUT = 62
    CAM_SCALING = 63
    CAM_INFO = 64
    CAM_RD_MOTION_FUNCTION = 65
    CAM_RD_MOTION_FUNCTION_POINT = 66
    CAM_RD_MOTION_FUNCTIONS_VALUES = 67
    CAM_WRT_MOTION_FUNCTION = 68
    CAM_WRT_MOTION_FUNCTION_POINT = 69

    FLY_GEAR_IN_POS = 70
    FLY_GEAR_IN_VELO = 71


NO_INIT: Final = 9
"""`AXIS_NO_INIT`, a state only: the command came before `AxisCommand.INIT` was done."""


class NciCommand(enum.IntEnum):
    """`E_NCI_CTRL`, and the same members `E_NCI_STATE`."""

    NULL = 0
    INIT = 1
    IDLE = 2
    RESET = 3
    LOAD_PROG = 4
    FEED_TABLE = 5
    BUILD_GROUP = 6
    CLEAR_GROUP = 7
    START = 10
    STOP = 11
    STO_STOP = 12
    RESTART_STEP_ON = 13
    M_FUNC_QUIT = 20
    READ_R_PARA = 30
    WRITE_R_PARA = 40
