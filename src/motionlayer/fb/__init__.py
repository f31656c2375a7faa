"""Function blocks of PLCopen, as objects that a program calls once per cycle."""

from motionlayer.fb._axis_ref import AXIS_REF
from motionlayer.fb._block import Block
from motionlayer.fb._braking import MC_Halt, MC_Stop
from motionlayer.fb._helpers import MC_CalcDynamicsByRampTime, MC_OverrideFilter
from motionlayer.fb._jog import MC_Jog
from motionlayer.fb._moves import (
    MC_MoveAbsolute,
    MC_MoveAdditive,
    MC_MoveContinuousAbsolute,
    MC_MoveContinuousRelative,
    MC_MoveModulo,
    MC_MoveRelative,
    MC_MoveVelocity,
    ST_MoveOptions,
)
from motionlayer.fb._parameter_blocks import (
    E_ReadMode,
    MC_ReadBoolParameter,
    MC_ReadParameter,
    MC_WriteBoolParameter,
    MC_WriteBoolParameterPersistent,
    MC_WriteParameter,
    MC_WriteParameterPersistent,
    write_parameter,
)
from motionlayer.fb._parameter_numbers import MC_AxisParameter
from motionlayer.fb._parameters import PARAMETERS
from motionlayer.fb._power import MC_Power, MC_Reset, MC_SetOverride
from motionlayer.fb._reading import MC_ReadActualPosition, MC_ReadActualVelocity, MC_ReadAxisError, MC_ReadStatus
from motionlayer.fb._reference_modes import HOMING_METHODS, E_EncoderReferenceMode
from motionlayer.fb._referencing import (
    DEFAULT_HOME_POSITION,
    MC_Home,
    MC_SetPosition,
    ST_HomingOptions,
    ST_SetPositionOptions,
)
from motionlayer.fb._status import ST_AxisStatus
from motionlayer.nc import AxisState as MC_AxisStates
from motionlayer.nc import BufferMode as MC_BufferMode
from motionlayer.nc import Calibration as MC_HomingMode
from motionlayer.nc import Direction as MC_Direction
from motionlayer.nc import JogMode as E_JogMode

__all__ = [
    "AXIS_REF",
    "DEFAULT_HOME_POSITION",
    "HOMING_METHODS",
    "PARAMETERS",
    "Block",
    "E_EncoderReferenceMode",
    "E_JogMode",
    "E_ReadMode",
    "MC_AxisParameter",
    "MC_AxisStates",
    "MC_BufferMode",
    "MC_CalcDynamicsByRampTime",
    "MC_Direction",
    "MC_Halt",
    "MC_Home",
    "MC_HomingMode",
    "MC_Jog",
    "MC_MoveAbsolute",
    "MC_MoveAdditive",
    "MC_MoveContinuousAbsolute",
    "MC_MoveContinuousRelative",
    "MC_MoveModulo",
    "MC_MoveRelative",
    "MC_MoveVelocity",
    "MC_OverrideFilter",
    "MC_Power",
    "MC_ReadActualPosition",
    "MC_ReadActualVelocity",
    "MC_ReadAxisError",
    "MC_ReadBoolParameter",
    "MC_ReadParameter",
    "MC_ReadStatus",
    "MC_Reset",
    "MC_SetOverride",
    "MC_SetPosition",
    "MC_Stop",
    "MC_WriteBoolParameter",
    "MC_WriteBoolParameterPersistent",
    "MC_WriteParameter",
    "MC_WriteParameterPersistent",
    "ST_AxisStatus",
    "ST_HomingOptions",
    "ST_MoveOptions",
    "ST_SetPositionOptions",
    "write_parameter",
]
