"""The numerical control: axes (point to point), built on profiles and the setpoint store."""

from motionlayer.nc._axis import Axis
from motionlayer.nc._config import AxisConfig, Direction, HomeConfig, HomingMode
from motionlayer.nc._monitors import MonitorConfig
from motionlayer.nc._motion import AxisCommand
from motionlayer.nc._reaction import REACTIONS, ErrorGroup, GroupReaction, Reaction
from motionlayer.nc._stage import AxisStage
from motionlayer.nc._states import TRANSITIONS, AxisEvent, AxisState
from motionlayer.nc._stopping import stopping

__all__ = [
    "REACTIONS",
    "TRANSITIONS",
    "Axis",
    "AxisCommand",
    "AxisConfig",
    "AxisEvent",
    "AxisStage",
    "AxisState",
    "Direction",
    "ErrorGroup",
    "GroupReaction",
    "HomeConfig",
    "HomingMode",
    "MonitorConfig",
    "Reaction",
    "stopping",
]
