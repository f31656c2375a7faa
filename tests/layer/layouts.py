"""The tables of motion-layer 3 as they stand there: size, pack mode, format, and a line per member.

A line is offset (`byte` or `byte.bit`), name, type, declared start value where it is none of 0, FALSE and empty.
"""

from typing import Final, NamedTuple


class Told(NamedTuple):
    """What a table tells of a structure.

    Attributes:
        size: in bytes.
        pack: pack mode, 8 where it is the default.
        format: of `struct`; a byte of BITs is one `B`, and nested structures are spelt out.
        rows: offset, name, type and start value of each member.
    """

    size: int
    pack: int
    format: str
    rows: str


TABLES: Final = {
    "ST_AXIS_CTRL": Told(
        4,
        2,
        "<2H",
        """
        0 | eCmd | E_AXIS_CTRL
        2 | eProgress | E_PROGRESS
        """,
    ),
    "ST_AXIS_STATE": Told(
        6,
        2,
        "<HI",
        """
        0 | eState | E_AXIS_STATE
        2 | eAxisEncoder | E_AxisEncoderType
        """,
    ),
    "ST_AXIS_INFO": Told(
        38,
        2,
        "<BxI3d2I",
        """
        0.0 | bEnabled | BIT
        0.1 | bReferenced | BIT
        0.2 | bReady | BIT
        0.3 | bBusy | BIT
        0.4 | bError | BIT
        0.5 | bTimeout | BIT
        0.6 | bInTarget | BIT
        0.7 | bStandstill | BIT
        2 | nErrorId | UDINT
        6 | rActPos | LREAL
        14 | rActVelo | LREAL
        22 | rPosDiff | LREAL
        30 | dwCoupleState | DWORD
        34 | nNcAxisId | UDINT
        """,
    ),
    "ST_MOVE_DATA": Told(
        50,
        2,
        "<6dh",
        """
        0 | rSetPos | LREAL
        8 | rSetVelo | LREAL
        16 | rOverride | LREAL | 100.0
        24 | rAcc | LREAL
        32 | rDec | LREAL
        40 | rJerk | LREAL
        48 | iDirection | INT
        """,
    ),
    "ST_MOTION_OPTIONS": Told(
        10,
        2,
        "<Hd",
        """
        0 | eBufferMode | MC_BufferMode
        2 | rDistance | LREAL
        """,
    ),
    "ST_NC_PARAMETER": Told(
        10,
        2,
        "<hd",
        """
        0 | ParameterNumber | MC_AxisParameter
        2 | rValue | LREAL
        """,
    ),
    "ST_HOMING": Told(
        66,
        2,
        "<Bxdh6x?xh4xdh6xdI4xB7x",
        """
        0.0 | bExecute | BIT
        2 | stHomingParam | ST_HomeParams
        """,
    ),
    "ST_HomeParams": Told(
        64,
        8,
        "<dh6x?xh4xdh6xdI4xB7x",
        """
        0 | Position | LREAL
        8 | HomingMode | MC_HomingMode
        16 | Options | ST_HomingOptions
        56.0 | InvertHomeSensor | BIT
        56.1 | SimulateHomeSensor | BIT
        56.2 | UseLimitMin | BIT | TRUE
        56.3 | InvertLimitMin | BIT
        56.4 | HomeOnLimitMin | BIT
        56.5 | UseLimitMax | BIT | TRUE
        56.6 | InvertLimitMax | BIT
        56.7 | HomeOnLimitMax | BIT
        """,
    ),
    "ST_HomingOptions": Told(
        40,
        8,
        "<?xh4xdh6xdI4x",
        """
        0 | ClearPositionLag | BOOL
        2 | SearchDirection | MC_Direction | MC_Undefined_Direction
        8 | SearchVelocity | LREAL
        16 | SyncDirection | MC_Direction | MC_Undefined_Direction
        24 | SyncVelocity | LREAL
        32 | ReferenceMode | E_EncoderReferenceMode | ENCODERREFERENCEMODE_DEFAULT
        """,
    ),
    "ST_GEAR_IN": Told(
        36,
        2,
        "<?xh4B4f3f",
        """
        0 | bAdvancedSlaveDynamics | BOOL
        2 | nMultiMasterSyncMode | INT
        4 | nAxisIndexMaster | ARRAY[1..4] OF BYTE
        8 | rGearRatio | ARRAY[1..4] OF REAL
        24 | Acceleration | REAL
        28 | Deceleration | REAL
        32 | Jerk | REAL
        """,
    ),
    "ST_AXIS_LIMIT_SWITCHES": Told(
        3,
        8,
        "<3?",
        """
        0 | bMinimum | BOOL
        1 | bMaximum | BOOL
        2 | bCalibrate | BOOL
        """,
    ),
    "ST_PARAMETER_SELECTOR_CTRL": Told(
        18,
        8,
        "<h3Hhd",
        """
        0 | Selector | E_AXIS_SELECTOR
        2 | Axis | UINT
        4 | Control | ST_AXIS_CTRL
        8 | Data | ST_NC_PARAMETER
        """,
    ),
    "ST_PARAMETER_SELECTOR_STATE": Told(
        24,
        8,
        "<H2xIHIhd",
        """
        0 | AxisIndex | UINT
        4 | AxisId | UDINT
        8 | State | ST_AXIS_STATE
        14 | Info | ST_NC_PARAMETER
        """,
    ),
    "ST_NCI_CTRL": Told(
        262,
        2,
        "<Hf256s",
        """
        0 | eCmd | E_NCI_CTRL | INIT
        2 | rOverride | REAL | 47.11
        6 | sProgramName | STRING(255)
        """,
    ),
    "ST_NCI_STATE": Told(
        272,
        2,
        "<HBx2Hd256s",
        """
        0 | eState | E_NCI_STATE
        2.0 | bMFuncReq | BIT
        4 | nMFunc | WORD
        6 | nItpState | UINT
        8 | rAxisOverride | LREAL
        16 | sProgramNameActive | STRING(255)
        """,
    ),
    "ST_3D_Group": Told(
        32,
        2,
        "<8I",
        """
        0 | nXAxisId | UDINT | 1
        4 | nYAxisId | UDINT | 2
        8 | nZAxisId | UDINT | 3
        12 | nQ1AxisId | UDINT
        16 | nQ2AxisId | UDINT
        20 | nQ3AxisId | UDINT
        24 | nQ4AxisId | UDINT
        28 | nQ5AxisId | UDINT
        """,
    ),
    "ST_R_Parameter": Told(
        96,
        2,
        "<2i11d",
        """
        0 | _nStart | DINT | 901
        4 | _nCount | DINT | 4
        8 | _rValue | ARRAY[0..MAX_R_PARA] OF LREAL
        """,
    ),
    "ST_NCI_M_FUNC": Told(
        30,
        2,
        "<5I2HIH",
        """
        0 | FastMFuncMask | ARRAY[1..5] OF DWORD
        20 | HskMFuncNo | UINT
        22 | HskMFuncReq | WORD
        24 | HFuncValue | UDINT
        28 | MFuncGranted | UINT
        """,
    ),
    "ST_CAM_STATE": Told(
        40,
        2,
        "<BxH8H8HI",
        """
        0.0 | bError | BIT
        2 | eState | E_AXIS_STATE
        4 | wCamCouplingState | ARRAY[0..7] OF WORD
        20 | nCamCouplingTableId | ARRAY[0..7] OF UINT
        36 | nNumPointsRead | UDINT
        """,
    ),
    "ST_CAM_DATA": Told(
        110,
        2,
        "<BxH2dH4IH3dBxH2dH2d2HI",
        """
        0.0 | bAtMasterPosition | BIT
        2 | nMasterIndex | UINT
        4 | rMasterPosition | LREAL
        12 | rActivationPosition | LREAL
        20 | nActivationMode | UINT
        22 | nCamTableId | UDINT
        26 | nPointId | UDINT
        30 | nPointIndex | UDINT
        34 | nNumPoints | UDINT
        38 | stReadValuesParameter | ST_CAM_READ_VALUES_PARAMETER
        64 | stCamScalingData | ST_CAM_SCALING_DATA
        102 | stOptions | ST_CAM_OPTIONS
        """,
    ),
    "ST_CAM_READ_VALUES_PARAMETER": Told(
        26,
        2,
        "<H3d",
        """
        0 | nValueSelectMask | UINT
        2 | rValueMasterStart | LREAL
        10 | rValueMasterEnd | LREAL
        18 | rIncrement | LREAL
        """,
    ),
    "ST_CAM_SCALING_DATA": Told(
        38,
        2,
        "<BxH2dH2d",
        """
        0.0 | bMasterRelative | BIT
        0.1 | bSlaveRelative | BIT
        2 | nMasterScalingMode | UINT
        4 | rMasterOffset | LREAL
        12 | rMasterScaling | LREAL | 1.0
        20 | nSlaveScalingMode | UINT
        22 | rSlaveOffset | LREAL
        30 | rSlaveScaling | LREAL | 1.0
        """,
    ),
    "ST_CAM_OPTIONS": Told(
        8,
        2,
        "<2HI",
        """
        0 | nInterpolationType | UINT
        2 | nCamOperationMode | UINT
        4 | nReferenceCamTableId | UDINT
        """,
    ),
    "ST_CAM_INFO": Told(
        196,
        2,
        "<Bxh5H17dHd3Hd2HIHd2H",
        """
        0.0 | bPeriodic | BIT
        0.1 | bMasterAbsolute | BIT
        0.2 | bSlaveAbsolute | BIT
        0.3 | bScalingPending | BIT
        0.4 | bCamDataQueued | BIT
        0.5 | bCamTableQueued | BIT
        2 | nTableType | INT
        4 | nInterpolationType | UINT
        6 | nNumberOfRows | UINT
        8 | nNumberOfColumns | UINT
        10 | nMasterAxisId | UINT
        12 | nSlaveAxisId | UINT
        14 | rMasterCamStartPos | LREAL
        22 | rSlaveCamStartPos | LREAL
        30 | rRawMasterPeriod | LREAL
        38 | rRawSlaveStroke | LREAL
        46 | rMasterAxisCouplingPos | LREAL
        54 | rSlaveAxisCouplingPos | LREAL
        62 | rMasterOffset | LREAL
        70 | rSlaveOffset | LREAL
        78 | rMasterScaling | LREAL
        86 | rSlaveScaling | LREAL
        94 | rSumOfSlaveStrokes | LREAL
        102 | rSumOfSuperpositionDistance | LREAL
        110 | rActualMasterAxisPos | LREAL
        118 | rActualSlaveAxisPos | LREAL
        126 | rActualMasterCamPos | LREAL
        134 | rActualSlaveCamPos | LREAL
        142 | rActualPhaseShift | LREAL
        150 | nScalingActivationMode | UINT
        152 | rScalingActivationPos | LREAL
        160 | nScalingMasterScalingMode | UINT
        162 | nScalingSlaveScalingMode | UINT
        164 | nOnlineChangeActivationMode | UINT
        166 | rOnlineChangeActivationPos | LREAL
        174 | nOnlineChangeMasterScalingMode | UINT
        176 | nOnlineChangeSlaveScalingMode | UINT
        178 | nCamExchangeCamTableID | UDINT
        182 | nCamExchangeActivationMode | UINT
        184 | rCamExchangeActivationPos | LREAL
        192 | nCamExchangeMasterScalingMode | UINT
        194 | nCamExchangeSlaveScalingMode | UINT
        """,
    ),
    "ST_MOTION_FUNCTION_POINT": Told(
        48,
        2,
        "<4H5d",
        """
        0 | nPointIndex | UINT
        2 | nFunctionType | UINT
        4 | wPointType | WORD
        6 | nRelIndexNextPoint | UINT
        8 | rMasterPos | LREAL
        16 | rSlavePos | LREAL
        24 | rSlaveVelo | LREAL
        32 | rSlaveAcc | LREAL
        40 | rSlaveJerk | LREAL
        """,
    ),
    "ST_MOTION_FUNCTION": Told(
        484,
        2,
        "<4H5d4H5d4H5d4H5d4H5d4H5d4H5d4H5d4H5d4H5d2H",
        """
        0 | stMotionFunction | ARRAY[1..MAX_MOTION_FUNCTION_POINTS] OF ST_MOTION_FUNCTION_POINT
        480 | nMotionFunctionSize | UINT
        482 | nPoints | UINT
        """,
    ),
    "ST_FLY_DATA": Told(
        54,
        2,
        "<5dBxId",
        """
        0 | rDeltaToMasterPos | LREAL
        8 | rModuloSyncPosSlave | LREAL
        16 | rMasterStartDistance | LREAL
        24 | rDelta | LREAL | 0.1
        32 | rGearNumerator | LREAL
        40 | iGearDenumerator | USINT | 1
        42 | nMasterAxisId | UDINT
        46 | rModulo | LREAL
        """,
    ),
    "ST_FLY_OPTIONS": Told(
        38,
        2,
        "<2dh20?",
        """
        0 | PositionLimitMin | LREAL
        8 | PositionLimitMax | LREAL
        16 | SyncMode | ST_FLY_SYNC_MODE
        """,
    ),
    "ST_FLY_SYNC_MODE": Told(
        22,
        8,
        "<h20?",
        """
        0 | GearInSyncMode | INT
        2 | GearInSync_CheckMask_MinPos | BOOL
        3 | GearInSync_CheckMask_MaxPos | BOOL
        4 | GearInSync_CheckMask_MaxVelo | BOOL
        5 | GearInSync_CheckMask_MaxAcc | BOOL
        6 | GearInSync_CheckMask_MaxDec | BOOL
        7 | GearInSync_CheckMask_MaxJerk | BOOL
        8 | GearInSync_CheckMask_OptionalMinPos | BOOL
        9 | GearInSync_CheckMask_OptionalMaxPos | BOOL
        10 | GearInSync_CheckMask_OvershootPos | BOOL
        11 | GearInSync_CheckMask_UndershootPos | BOOL
        12 | GearInSync_CheckMask_OvershootVelo | BOOL
        13 | GearInSync_CheckMask_UndershootVelo | BOOL
        14 | GearInSync_CheckMask_OvershootVeloZero | BOOL
        15 | GearInSync_CheckMask_UndershootVeloZero | BOOL
        16 | GearInSync_OpMask_RollbackLock | BOOL
        17 | GearInSync_OpMask_InstantStopOnRollback | BOOL
        18 | GearInSync_OpMask_PreferConstVelo | BOOL
        19 | GearInSync_OpMask_IgnoreMasterAcc | BOOL
        20 | GearInSync_OpMask_IgnoreSlaveAcc | BOOL
        21 | GearInSync_OpMask_DetailedErrorCodes | BOOL
        """,
    ),
    "ST_CTRL_TOUCH_PROBE": Told(
        32,
        8,
        "<B3x2Ih2x2d",
        """
        0.0 | Enable | BIT
        4 | AxisId | UDINT
        8 | SensorIndex | UDINT
        12 | Direction | INT | 1
        16 | PositionStart | LREAL
        24 | PositionEnd | LREAL
        """,
    ),
    "ST_STATE_TOUCH_PROBE": Told(
        24,
        8,
        "<H6x2d",
        """
        0 | State | UINT
        8 | LatchPositive | LREAL
        16 | LatchNegative | LREAL
        """,
    ),
    "ST_MTI_INPUT": Told(
        8,
        8,
        "<B3xI",
        """
        0.0 | EventState | BIT
        4 | EventTime | UDINT
        """,
    ),
    "ST_MTI_STATUS": Told(
        5,
        8,
        "<5B",
        """
        0 | EventCount | USINT
        1.0 | InputState | BIT
        1.1 | InputBufferOverflow | BIT
        2 | InputCycleCounter | ST_2BIT
        3 | CountsInBuffer | USINT
        4 | InputOrderFeedback | USINT
        """,
    ),
    "ST_CTRL_TRIGGER": Told(
        48,
        8,
        "<B7B2I4d",
        """
        0 | Control | T_TriggerControlBits
        1 | byc | ARRAY[1..7] OF BYTE
        8 | AxisId | UDINT
        12 | TriggerCount | UDINT
        16 | TriggerPosition | ARRAY[1..MAX_TRIGGER_COUNT] OF LREAL
        """,
    ),
    "ST_STATE_TRIGGER": Told(
        40,
        8,
        "<2H4x4d",
        """
        0 | State | UINT
        2 | Init | UINT
        8 | FlashPosition | ARRAY[1..MAX_TRIGGER_COUNT] OF LREAL
        """,
    ),
    "ST_DC_Input": Told(
        24,
        8,
        "<2B6x2Q",
        """
        0.0 | Input | BIT
        1 | Status | USINT
        8 | LatchPositive | ULINT
        16 | LatchNegative | ULINT
        """,
    ),
    "ST_DC_Output": Told(
        16,
        8,
        "<QB4?3x",
        """
        0 | dcStartTime | ULINT
        8 | nActivate | BYTE
        9 | Ch1_Output | BOOL
        10 | Ch1_Tristate | BOOL
        11 | Ch2_Output | BOOL
        12 | Ch2_Tristate | BOOL
        """,
    ),
    "ST_Message": Told(
        184,
        8,
        "<iIi4xQ25s128s7x",
        """
        0 | eType | e_MessageType
        4 | eDevice | e_Device
        8 | eSubdevice | e_SubDevice
        16 | iErrorNumber | ULINT
        24 | tTime | STRING(24)
        49 | sText | STRING(127)
        """,
    ),
    "ST_CAM_CTRL": Told(
        2,
        2,
        "<H",
        """
        0 | eCmd | E_AXIS_CTRL
        """,
    ),
    "ST_FLY_CTRL": Told(
        2,
        2,
        "<H",
        """
        0 | eCmd | E_AXIS_CTRL
        """,
    ),
    "ST_FLY_STATE": Told(
        2,
        2,
        "<H",
        """
        0 | eState | E_AXIS_STATE
        """,
    ),
    "ST_2BIT": Told(
        1,
        8,
        "<B",
        """
        0.0 | b1 | BIT
        0.1 | b2 | BIT
        """,
    ),
    "T_TriggerControlBits": Told(
        1,
        8,
        "<B",
        """
        0.0 | Enable | BIT
        0.1 | Init | BIT
        0.2 | NoFeedback | BIT
        0.3 | b3 | BIT
        0.4 | b4 | BIT
        0.5 | b5 | BIT
        0.6 | b6 | BIT
        0.7 | b7 | BIT
        """,
    ),
    "ST_DC_State": Told(
        16,
        8,
        "<QB7x",
        """
        0 | SysTime | ULINT
        8 | Feedback | USINT
        """,
    ),
    "ST_MESSAGE_CTRL": Told(
        2,
        8,
        "<H",
        """
        0 | Cmd | E_MESSAGE_CTRL
        """,
    ),
    "ST_MESSAGE_STATE": Told(
        2,
        8,
        "<H",
        """
        0 | State | E_MESSAGE_STATE
        """,
    ),
    "ST_Index_Group": Told(
        32,
        2,
        "<8I",
        """
        0 | nXAxisIdx | UDINT | 1
        4 | nYAxisIdx | UDINT | 2
        8 | nZAxisIdx | UDINT | 3
        12 | nQ1AxisIdx | UDINT
        16 | nQ2AxisIdx | UDINT
        20 | nQ3AxisIdx | UDINT
        24 | nQ4AxisIdx | UDINT
        28 | nQ5AxisIdx | UDINT
        """,
    ),
}
"""By declared name."""
