"""The numerical control: axes (point to point), built on profiles and the setpoint store."""

from motionlayer.nc._actual import ActualMotion
from motionlayer.nc._axis import Axis
from motionlayer.nc._axis_ref import (
    NCTOPLC_AXIS_REF,
    PLCTONC_AXIS_REF,
    ControlDWord,
    OpModeDWord,
    StateDWord,
)
from motionlayer.nc._axis_refs import AxisRefs
from motionlayer.nc._config import (
    AxisConfig,
    BufferMode,
    Calibration,
    Direction,
    HomeConfig,
    HomingMode,
    JogMode,
    ManualConfig,
    ModuloConfig,
)
from motionlayer.nc._home_keywords import HomeKeywords
from motionlayer.nc._homing import HomeCommand
from motionlayer.nc._keywords import (
    BrakeKeywords,
    BufferKeywords,
    ContinuousKeywords,
    EndlessKeywords,
    HaltKeywords,
    JogKeywords,
    MoveKeywords,
    RampKeywords,
)
from motionlayer.nc._monitors import MonitorConfig
from motionlayer.nc._motion import AxisCommand, HeldCommand
from motionlayer.nc._planning import ROW_PIECES
from motionlayer.nc._reaction import REACTIONS, ErrorGroup, GroupReaction, Reaction
from motionlayer.nc._stage import AxisStage
from motionlayer.nc._states import TRANSITIONS, AxisEvent, AxisState
from motionlayer.nc._stopping import stopping
from motionlayer.nc._subdevices import axis_device

__all__ = [
    "NCTOPLC_AXIS_REF",
    "PLCTONC_AXIS_REF",
    "REACTIONS",
    "ROW_PIECES",
    "TRANSITIONS",
    "ActualMotion",
    "Axis",
    "AxisCommand",
    "AxisConfig",
    "AxisEvent",
    "AxisRefs",
    "AxisStage",
    "AxisState",
    "BrakeKeywords",
    "BufferKeywords",
    "BufferMode",
    "Calibration",
    "ContinuousKeywords",
    "ControlDWord",
    "Direction",
    "EndlessKeywords",
    "ErrorGroup",
    "GroupReaction",
    "HaltKeywords",
    "HeldCommand",
    "HomeCommand",
    "HomeConfig",
    "HomeKeywords",
    "HomingMode",
    "JogKeywords",
    "JogMode",
    "ManualConfig",
    "ModuloConfig",
    "MonitorConfig",
    "MoveKeywords",
    "OpModeDWord",
    "RampKeywords",
    "Reaction",
    "StateDWord",
    "axis_device",
    "stopping",
]
