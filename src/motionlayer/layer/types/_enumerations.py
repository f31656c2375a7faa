"""The enumerations of the interface as IEC types: what a field of a structure is declared with (motion-layer 2).

Members are named in Python without the prefix of the interface; `prefix` puts it back, and `names` says what no prefix
can. A state is the number of a command plus a progress: its type has the names of the commands, and its value is hardly
ever one of them.
"""

from typing import Any, Final

from motionlayer import fb, nc
from motionlayer.event import Device, Level, Subdevice
from motionlayer.iec import DINT, DWORD, INT, UDINT, UINT, Enumeration
from motionlayer.layer.types._axis_kinds import AxisEncoderType, AxisSelector
from motionlayer.layer.types._cam_kinds import (
    CamActivationMode,
    CamOperationMode,
    CamScalingMode,
    InterpolationType,
    MotionFunctionType,
    MotionPointType,
    TableType,
)
from motionlayer.layer.types._checks import CheckState, MessageCheck, XfcCheck
from motionlayer.layer.types._commands import NO_INIT, AxisCommand, NciCommand
from motionlayer.layer.types._library_kinds import (
    BufferMode,
    GearInSyncMode,
    HomingMode,
    MultiMasterSyncMode,
    SignalEdge,
)
from motionlayer.layer.types._message_kinds import MessageBatch, MessageCommand, MessageFlow
from motionlayer.layer.types._nci_states import InterpreterState, NciChannelError
from motionlayer.layer.types._progress import Progress

_KEPT: Final = ("CAM_", "FLY_")
"""Commands of cams and saws, whose names have no prefix in front."""

E_PROGRESS: Final = Enumeration("E_PROGRESS", UINT, Progress, prefix="PROGRESS_")
E_AXIS_CTRL: Final = Enumeration("E_AXIS_CTRL", UINT, AxisCommand, prefix="AXIS_", keep=_KEPT)
E_AXIS_STATE: Final = Enumeration(
    "E_AXIS_STATE", UINT, AxisCommand, prefix="AXIS_", keep=_KEPT, further={"AXIS_NO_INIT": NO_INIT}
)
E_AXIS_SELECTOR: Final = Enumeration("E_AXIS_SELECTOR", INT, AxisSelector, prefix="SELECT_")
E_AXIS_ENCODER_TYPE: Final = Enumeration("E_AxisEncoderType", UDINT, AxisEncoderType)

E_NCI_CTRL: Final = Enumeration("E_NCI_CTRL", UINT, NciCommand)
E_NCI_STATE: Final = Enumeration("E_NCI_STATE", UINT, NciCommand)
E_NCI_INTERPRETER_STATE: Final = Enumeration(
    "E_NCI_INTERPRETER_STATE", DWORD, InterpreterState, prefix="NCI_INTERPRETER_"
)
E_NCI_CHANNEL_ERROR: Final = Enumeration(
    "E_NCI_CHANNEL_ERROR",
    INT,
    NciChannelError,
    names={
        "NULL": "e_Null",
        "INVALID_REFERENCE_CHANNEL_REF": "e_InvalidReference_ChannelRef",
        "AXIS_CONFIGURATION_MISMATCH_MC_AXIS": "e_AxisConfigurationMismatch_McAxis",
        "AXIS_CONFIGURATION_MISMATCH_AUX_AXIS": "e_AxisConfigurationMismatch_AuxAxis",
    },
)

E_CHECK_STATE: Final = Enumeration(
    "E_CHECK_STATE",
    UINT,
    CheckState,
    prefix="CHECK_",
    keep=("AXIS_", "NCI_", "CAM_", "FLYING_", "PARAMETER_"),
    names={"NCI_R_PARAMETER_WRITE_POINTER_INVALID": "NCI_R_PARAMETER_wRITE_POINTER_INVALID"},
)
E_XFC_CHECK: Final = Enumeration("E_XFC_CHECK", INT, XfcCheck, prefix="XFC_CHECK_")
E_MESSAGE_CHECK: Final = Enumeration("E_MESSAGE_CHECK", UINT, MessageCheck, prefix="MSG_CHECK_")

E_MESSAGE_TYPE: Final = Enumeration(
    "E_MessageType",
    DINT,
    Level,
    names={level.name: f"eMessage{level.name.capitalize()}" for level in Level},
    further={"eMessageEmpty": 0},
)
E_MESSAGE_CTRL: Final = Enumeration("E_MESSAGE_CTRL", UINT, MessageCommand, prefix="MSG_CTRL_")
E_MESSAGE_STATE: Final = Enumeration("E_MESSAGE_STATE", UINT, MessageCommand, prefix="MSG_STATE_")
E_MESSAGE_FLOW: Final = Enumeration("E_MESSAGE_FLOW", UINT, MessageFlow, prefix="MSG_FLOW_")
E_MESSAGE_BATCH: Final = Enumeration("E_MESSAGE_BATCH", UINT, MessageBatch, prefix="MSG_BATCH_")
E_DEVICE: Final = Enumeration("e_Device", UDINT, Device)
E_SUBDEVICE: Final = Enumeration("e_Subdevice", DINT, Subdevice)

MC_DIRECTION: Final = Enumeration(
    "MC_Direction",
    INT,
    nc.Direction,
    names={
        "POSITIVE": "MC_Positive_Direction",
        "SHORTEST_WAY": "MC_Shortest_Way",
        "NEGATIVE": "MC_Negative_Direction",
        "CURRENT": "MC_Current_Direction",
        "UNDEFINED": "MC_Undefined_Direction",
    },
)
MC_BUFFER_MODE: Final = Enumeration(
    "MC_BufferMode",
    UINT,
    BufferMode,
    names={
        "ABORTING": "MC_Aborting",
        "BUFFERED": "MC_Buffered",
        "BLENDING_LOW": "MC_BlendingLow",
        "BLENDING_PREVIOUS": "MC_BlendingPrevious",
        "BLENDING_NEXT": "MC_BlendingNext",
        "BLENDING_HIGH": "MC_BlendingHigh",
    },
)
MC_HOMING_MODE: Final = Enumeration(
    "MC_HomingMode",
    INT,
    HomingMode,
    names={
        "DEFAULT": "MC_DefaultHoming",
        "ABS_SWITCH": "MC_AbsSwitch",
        "LIMIT_SWITCH": "MC_LimitSwitch",
        "REF_PULSE": "MC_RefPulse",
        "DIRECT": "MC_Direct",
        "ABSOLUTE": "MC_Absolute",
        "BLOCK": "MC_Block",
        "FORCE_CALIBRATION": "MC_ForceCalibration",
        "RESET_CALIBRATION": "MC_ResetCalibration",
    },
)
MC_AXIS_PARAMETER: Final = Enumeration("MC_AxisParameter", INT, fb.MC_AxisParameter)
E_ENCODER_REFERENCE_MODE: Final = Enumeration(
    "E_EncoderReferenceMode",
    UDINT,
    fb.E_EncoderReferenceMode,
    prefix="ENCODERREFERENCEMODE_",
    further={"ENCODERREFERENCEMODE_APPLICATION": 20},
)
E_MULTI_MASTER_SYNC_MODE: Final = Enumeration("E_GearInMultiMasterSyncMode", INT, MultiMasterSyncMode)
E_GEAR_IN_SYNC_MODE: Final = Enumeration("E_GearInSyncMode", INT, GearInSyncMode, prefix="GEARINSYNCMODE_")
E_SIGNAL_EDGE: Final = Enumeration(
    "E_SignalEdge", UINT, SignalEdge, names={"RISING": "RisingEdge", "FALLING": "FallingEdge"}
)

MC_INTERPOLATION_TYPE: Final = Enumeration(
    "MC_InterpolationType", UINT, InterpolationType, prefix="MC_INTERPOLATIONTYPE_"
)
MC_CAM_OPERATION_MODE: Final = Enumeration("MC_CamOperationMode", UINT, CamOperationMode, prefix="CAMOPERATIONMODE_")
MC_CAM_SCALING_MODE: Final = Enumeration("MC_CamScalingMode", UINT, CamScalingMode, prefix="MC_CAMSCALING_")
MC_CAM_ACTIVATION_MODE: Final = Enumeration(
    "MC_CamActivationMode",
    UINT,
    CamActivationMode,
    prefix="MC_CAMACTIVATION_",
    names={"ATMASTERAXISPOS_POSITIVEDIRECTION": "MC_CAMACTIVATION_ATMASTERAXISPOS_POSITVEDIRECTION"},
)
MC_TABLE_TYPE: Final = Enumeration("MC_TableType", INT, TableType, prefix="MC_TABLETYPE_")
MC_MOTION_POINT_TYPE: Final = Enumeration("MC_MotionPointType", INT, MotionPointType, prefix="MOTIONPOINTTYPE_")
MC_MOTION_FUNCTION_TYPE: Final = Enumeration("MC_MotionFunctionType", INT, MotionFunctionType, prefix="MOTIONFUNCTYPE_")

ENUMERATIONS: Final[tuple[Enumeration[Any], ...]] = (
    E_PROGRESS,
    E_AXIS_CTRL,
    E_AXIS_STATE,
    E_AXIS_SELECTOR,
    E_AXIS_ENCODER_TYPE,
    E_NCI_CTRL,
    E_NCI_STATE,
    E_NCI_INTERPRETER_STATE,
    E_NCI_CHANNEL_ERROR,
    E_CHECK_STATE,
    E_XFC_CHECK,
    E_MESSAGE_CHECK,
    E_MESSAGE_TYPE,
    E_MESSAGE_CTRL,
    E_MESSAGE_STATE,
    E_MESSAGE_FLOW,
    E_MESSAGE_BATCH,
    E_DEVICE,
    E_SUBDEVICE,
)
"""Those of the motion layer itself."""

LIBRARY_ENUMERATIONS: Final[tuple[Enumeration[Any], ...]] = (
    MC_DIRECTION,
    MC_BUFFER_MODE,
    MC_HOMING_MODE,
    MC_AXIS_PARAMETER,
    E_ENCODER_REFERENCE_MODE,
    E_MULTI_MASTER_SYNC_MODE,
    E_GEAR_IN_SYNC_MODE,
    E_SIGNAL_EDGE,
    MC_INTERPOLATION_TYPE,
    MC_CAM_OPERATION_MODE,
    MC_CAM_SCALING_MODE,
    MC_CAM_ACTIVATION_MODE,
    MC_TABLE_TYPE,
    MC_MOTION_POINT_TYPE,
    MC_MOTION_FUNCTION_TYPE,
)
"""Those of the libraries it stands on; a control side that links these libraries has them already."""
