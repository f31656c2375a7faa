"""What an axis is told and what it answers (motion-layer 3.2). u is the unit of the axis."""

from typing import Final

from motionlayer.iec import BIT, BOOL, BYTE, DWORD, INT, LREAL, REAL, UDINT, Array, Field, Struct
from motionlayer.layer.types._enumerations import (
    E_AXIS_CTRL,
    E_AXIS_ENCODER_TYPE,
    E_AXIS_STATE,
    E_PROGRESS,
    MC_AXIS_PARAMETER,
    MC_BUFFER_MODE,
)

MASTERS: Final = 4
"""Masters of a coupling to several."""


class AxisCtrl(Struct, iec="ST_AXIS_CTRL", pack=2):
    """Command of an axis: a change of eCmd starts a job."""

    cmd = Field("eCmd", E_AXIS_CTRL, "command")
    progress = Field("eProgress", E_PROGRESS, "PROGRESS_DONE ends the endless jobs: buffered moves, multi-master")


class AxisState(Struct, iec="ST_AXIS_STATE", pack=2):
    """Answer of an axis."""

    state = Field("eState", E_AXIS_STATE, "command + progress")
    encoder = Field("eAxisEncoder", E_AXIS_ENCODER_TYPE, "type of the encoder, read at initialisation")


class AxisInfo(Struct, iec="ST_AXIS_INFO", pack=2):
    """What an axis is doing, in every cycle."""

    enabled = Field("bEnabled", BIT, "the axis follows its setpoints")
    referenced = Field("bReferenced", BIT, "its positions are those of the machine")
    ready = Field("bReady", BIT, "initialised, enabled and without error")
    busy = Field("bBusy", BIT, "a job is under way")
    error = Field("bError", BIT, "the axis or its job is in error")
    timeout = Field("bTimeout", BIT, "the job took longer than it may")
    in_target = Field("bInTarget", BIT, "inside the target window")
    standstill = Field("bStandstill", BIT, "nothing moves")
    error_id = Field("nErrorId", UDINT, "number of the error, 0 without")
    position = Field("rActPos", LREAL, "actual position (u)")
    velocity = Field("rActVelo", LREAL, "actual velocity (u/s)")
    lag = Field("rPosDiff", LREAL, "set position less actual position (u)")
    couple_state = Field("dwCoupleState", DWORD, "0 single, 1 master, 2 master and slave, 3 slave")
    nc_axis_id = Field("nNcAxisId", UDINT, "id of the axis in the NC")


class MoveData(Struct, iec="ST_MOVE_DATA", pack=2):
    """Where to and how fast."""

    position = Field("rSetPos", LREAL, "target position (u)")
    velocity = Field("rSetVelo", LREAL, "velocity (u/s)")
    override = Field("rOverride", LREAL, "override (percent), applied in every cycle", default=100.0)
    acceleration = Field("rAcc", LREAL, "acceleration (u/s²), 0 for that of the machine file")
    deceleration = Field("rDec", LREAL, "deceleration (u/s²), 0 for that of the machine file")
    jerk = Field("rJerk", LREAL, "jerk (u/s³), 0 for that of the machine file")
    direction = Field("iDirection", INT, "AXIS_MOVE_VELO: 1 positive, 3 and -1 negative")


class MotionOptions(Struct, iec="ST_MOTION_OPTIONS", pack=2):
    """Options of some jobs."""

    buffer_mode = Field("eBufferMode", MC_BUFFER_MODE, "of the buffered moves")
    distance = Field("rDistance", LREAL, "AXIS_SEND_TO_POS: done after this way (u)")


class NcParameter(Struct, iec="ST_NC_PARAMETER", pack=2):
    """A parameter of an axis."""

    number = Field("ParameterNumber", MC_AXIS_PARAMETER, "which parameter")
    value = Field("rValue", LREAL, "its value; 1.0 for TRUE, 0.0 for FALSE")


class GearIn(Struct, iec="ST_GEAR_IN", pack=2):
    """Coupling to one or more masters."""

    advanced_slave_dynamics = Field("bAdvancedSlaveDynamics", BOOL, "option of the coupling to several masters")
    sync_mode = Field("nMultiMasterSyncMode", INT, "E_GearInMultiMasterSyncMode: how the slave joins")
    masters = Field("nAxisIndexMaster", Array(BYTE, (1, MASTERS)), "indices of the masters; 0 ends the list")
    ratios = Field("rGearRatio", Array(REAL, (1, MASTERS)), "way of the slave per way of each master")
    acceleration = Field("Acceleration", REAL, "of the slave while it joins (u/s²)")
    deceleration = Field("Deceleration", REAL, "of the slave while it joins (u/s²)")
    jerk = Field("Jerk", REAL, "of the slave while it joins (u/s³)")


class LimitSwitches(Struct, iec="ST_AXIS_LIMIT_SWITCHES"):
    """Switches of an axis; TRUE is pressed."""

    minimum = Field("bMinimum", BOOL, "lower limit switch")
    maximum = Field("bMaximum", BOOL, "upper limit switch")
    calibrate = Field("bCalibrate", BOOL, "calibration cam")
