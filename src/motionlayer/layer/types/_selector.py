"""Parameters beside the command of an axis (motion-layer 3.3)."""

from motionlayer.iec import UDINT, UINT, Field, Struct
from motionlayer.layer.types._axis import AxisCtrl, AxisState, NcParameter
from motionlayer.layer.types._enumerations import E_AXIS_SELECTOR


class SelectorCtrl(Struct, iec="ST_PARAMETER_SELECTOR_CTRL"):
    """Command of the parameter selector."""

    selector = Field("Selector", E_AXIS_SELECTOR, "what the number means")
    axis = Field("Axis", UINT, "index or id of the axis")
    control = Field("Control", AxisCtrl, "command; its eProgress is not used")
    data = Field("Data", NcParameter, "number and value")


class SelectorState(Struct, iec="ST_PARAMETER_SELECTOR_STATE"):
    """Answer of the parameter selector."""

    axis_index = Field("AxisIndex", UINT, "index of the axis, 0 for none")
    axis_id = Field("AxisId", UDINT, "its id in the NC")
    state = Field("State", AxisState, "command + progress; eAxisEncoder stays 0")
    info = Field("Info", NcParameter, "number and value handled")
