"""Commands and data of cams (motion-layer 3.5). u is the unit of the axis that a value speaks of."""

from typing import Final

from motionlayer.iec import BIT, LREAL, UDINT, UINT, WORD, Array, Field, Struct
from motionlayer.layer.types._enumerations import E_AXIS_CTRL, E_AXIS_STATE

COUPLINGS: Final = 8
"""Cams that may drive one slave at the same time."""

MAX_MOTION_FUNCTION_POINTS: Final = 10
"""Points of a motion function, as delivered; the machine file may say another."""


class CamCtrl(Struct, iec="ST_CAM_CTRL", pack=2):
    """Command of a cam."""

    cmd = Field("eCmd", E_AXIS_CTRL, "command")


class CamState(Struct, iec="ST_CAM_STATE", pack=2):
    """Answer of a cam."""

    error = Field("bError", BIT, "the last command failed")
    state = Field("eState", E_AXIS_STATE, "command + progress")
    coupling_states = Field(
        "wCamCouplingState",
        Array(WORD, (0, COUPLINGS - 1)),
        "bit 0 activation pending, 1 deactivation pending, 2 active, 6 data queued, 7 scaling pending",
    )
    coupling_tables = Field("nCamCouplingTableId", Array(UINT, (0, COUPLINGS - 1)), "ids of their tables")
    points_read = Field("nNumPointsRead", UDINT, "points that the last reading brought")


class CamReadValues(Struct, iec="ST_CAM_READ_VALUES_PARAMETER", pack=2):
    """Which values of a cam are read."""

    mask = Field("nValueSelectMask", UINT, "which quantities")
    start = Field("rValueMasterStart", LREAL, "first position of the master (u)")
    end = Field("rValueMasterEnd", LREAL, "last position of the master (u)")
    increment = Field("rIncrement", LREAL, "from one position to the next (u)")


class CamScaling(Struct, iec="ST_CAM_SCALING_DATA", pack=2):
    """How a cam is stretched and shifted."""

    master_relative = Field("bMasterRelative", BIT, "the offset of the master counts from its present position")
    slave_relative = Field("bSlaveRelative", BIT, "the offset of the slave counts from its present position")
    master_mode = Field("nMasterScalingMode", UINT, "MC_CamScalingMode")
    master_offset = Field("rMasterOffset", LREAL, "added to the positions of the master (u)")
    master_scaling = Field("rMasterScaling", LREAL, "factor of the master", default=1.0)
    slave_mode = Field("nSlaveScalingMode", UINT, "MC_CamScalingMode")
    slave_offset = Field("rSlaveOffset", LREAL, "added to the positions of the slave (u)")
    slave_scaling = Field("rSlaveScaling", LREAL, "factor of the slave", default=1.0)


class CamOptions(Struct, iec="ST_CAM_OPTIONS", pack=2):
    """Options of a coupling."""

    interpolation = Field("nInterpolationType", UINT, "MC_InterpolationType")
    operation = Field("nCamOperationMode", UINT, "MC_CamOperationMode")
    reference_table = Field("nReferenceCamTableId", UDINT, "table that an added or exchanged one refers to")


class CamData(Struct, iec="ST_CAM_DATA", pack=2):
    """Data of the commands of a cam."""

    at_master_position = Field("bAtMasterPosition", BIT, "CAM_INFO: what would be at rMasterPosition")
    master_index = Field("nMasterIndex", UINT, "index of the master")
    master_position = Field("rMasterPosition", LREAL, "position of the master for CAM_INFO (u)")
    activation_position = Field("rActivationPosition", LREAL, "where a change comes into force (u)")
    activation_mode = Field("nActivationMode", UINT, "MC_CamActivationMode")
    table = Field("nCamTableId", UDINT, "id of the table")
    point_id = Field("nPointId", UDINT, "id of the first point")
    point_index = Field("nPointIndex", UDINT, "its index in the array of points")
    points = Field("nNumPoints", UDINT, "how many points, 0 for all")
    read_values = Field("stReadValuesParameter", CamReadValues, "CAM_RD_MOTION_FUNCTIONS_VALUES: which values")
    scaling = Field("stCamScalingData", CamScaling, "how the cam is stretched and shifted")
    options = Field("stOptions", CamOptions, "options of the coupling")


class MotionFunctionPoint(Struct, iec="ST_MOTION_FUNCTION_POINT", pack=2):
    """A point of a motion function, and the law of motion from it to the next."""

    index = Field("nPointIndex", UINT, "id of the point")
    function = Field("nFunctionType", UINT, "MC_MotionFunctionType")
    kind = Field("wPointType", WORD, "MC_MotionPointType")
    next_point = Field("nRelIndexNextPoint", UINT, "how many points on the next one is")
    master_position = Field("rMasterPos", LREAL, "position of the master (u)")
    slave_position = Field("rSlavePos", LREAL, "position of the slave (u)")
    slave_velocity = Field("rSlaveVelo", LREAL, "its first derivative by the position of the master")
    slave_acceleration = Field("rSlaveAcc", LREAL, "its second derivative")
    slave_jerk = Field("rSlaveJerk", LREAL, "its third derivative")


class MotionFunction(Struct, iec="ST_MOTION_FUNCTION", pack=2):
    """A motion function; the room is MAX_MOTION_FUNCTION_POINTS."""

    points = Field(
        "stMotionFunction", Array(MotionFunctionPoint, (1, MAX_MOTION_FUNCTION_POINTS)), "points of the function"
    )
    size = Field("nMotionFunctionSize", UINT, "bytes of the table in the library")
    used = Field("nPoints", UINT, "points that are used")
