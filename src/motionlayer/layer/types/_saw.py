"""Flying saw (motion-layer 3.6). u is the unit of the axis that a value speaks of."""

from motionlayer.iec import BOOL, INT, LREAL, UDINT, USINT, Field, Struct
from motionlayer.layer.types._enumerations import E_AXIS_CTRL, E_AXIS_STATE


class FlyCtrl(Struct, iec="ST_FLY_CTRL", pack=2):
    """Command of a flying saw."""

    cmd = Field("eCmd", E_AXIS_CTRL, "command")


class FlyState(Struct, iec="ST_FLY_STATE", pack=2):
    """Answer of a flying saw."""

    state = Field("eState", E_AXIS_STATE, "command + progress")


class FlyData(Struct, iec="ST_FLY_DATA", pack=2):
    """Where and how the slave joins its master."""

    master_distance = Field("rDeltaToMasterPos", LREAL, "from the master, when commanded, to where they meet (u)")
    slave_position = Field("rModuloSyncPosSlave", LREAL, "where the slave then is within its turn (u)")
    start_distance = Field("rMasterStartDistance", LREAL, "way of the master before the slave starts (u), 0 for none")
    tolerance = Field("rDelta", LREAL, "how late it may be (u)", default=0.1)
    gear_numerator = Field("rGearNumerator", LREAL, "ratio, numerator")
    gear_denominator = Field("iGearDenumerator", USINT, "ratio, denominator", default=1)
    master_axis_id = Field("nMasterAxisId", UDINT, "id of the master in the NC")
    modulo = Field("rModulo", LREAL, "length of a turn (u)")


class FlySyncMode(Struct, iec="ST_FLY_SYNC_MODE"):
    """What is watched while the slave joins; the bytes of ST_SyncMode of the library."""

    mode = Field("GearInSyncMode", INT, "E_GearInSyncMode")
    check_min_position = Field("GearInSync_CheckMask_MinPos", BOOL, "least position")
    check_max_position = Field("GearInSync_CheckMask_MaxPos", BOOL, "largest position")
    check_max_velocity = Field("GearInSync_CheckMask_MaxVelo", BOOL, "largest velocity")
    check_max_acceleration = Field("GearInSync_CheckMask_MaxAcc", BOOL, "largest acceleration")
    check_max_deceleration = Field("GearInSync_CheckMask_MaxDec", BOOL, "largest deceleration")
    check_max_jerk = Field("GearInSync_CheckMask_MaxJerk", BOOL, "largest jerk")
    check_optional_min = Field("GearInSync_CheckMask_OptionalMinPos", BOOL, "the limit PositionLimitMin")
    check_optional_max = Field("GearInSync_CheckMask_OptionalMaxPos", BOOL, "the limit PositionLimitMax")
    check_overshoot = Field("GearInSync_CheckMask_OvershootPos", BOOL, "no way beyond the meeting point")
    check_undershoot = Field("GearInSync_CheckMask_UndershootPos", BOOL, "no way back behind the start")
    check_overshoot_velocity = Field("GearInSync_CheckMask_OvershootVelo", BOOL, "not faster than when joined")
    check_undershoot_velocity = Field("GearInSync_CheckMask_UndershootVelo", BOOL, "not slower than at the start")
    check_overshoot_zero = Field("GearInSync_CheckMask_OvershootVeloZero", BOOL, "velocity does not pass zero upwards")
    check_undershoot_zero = Field("GearInSync_CheckMask_UndershootVeloZero", BOOL, "nor downwards")
    rollback_lock = Field("GearInSync_OpMask_RollbackLock", BOOL, "the slave does not turn back with its master")
    stop_on_rollback = Field("GearInSync_OpMask_InstantStopOnRollback", BOOL, "it stops at once when the master does")
    prefer_constant_velocity = Field("GearInSync_OpMask_PreferConstVelo", BOOL, "a phase of constant velocity")
    ignore_master_acceleration = Field("GearInSync_OpMask_IgnoreMasterAcc", BOOL, "the master counts as uniform")
    ignore_slave_acceleration = Field("GearInSync_OpMask_IgnoreSlaveAcc", BOOL, "the slave counts as uniform")
    detailed_errors = Field("GearInSync_OpMask_DetailedErrorCodes", BOOL, "errors tell which check failed")


class FlyOptions(Struct, iec="ST_FLY_OPTIONS", pack=2):
    """Limits and checks."""

    limit_min = Field("PositionLimitMin", LREAL, "optional lower limit (u)")
    limit_max = Field("PositionLimitMax", LREAL, "optional upper limit (u)")
    sync = Field("SyncMode", FlySyncMode, "what is watched")
