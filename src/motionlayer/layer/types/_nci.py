"""NCI channels (motion-layer 3.4)."""

from typing import Final

from motionlayer.iec import BIT, DINT, DWORD, LREAL, REAL, STRING, UDINT, UINT, WORD, Array, Field, Struct
from motionlayer.layer.types._commands import NciCommand
from motionlayer.layer.types._enumerations import E_NCI_CTRL, E_NCI_STATE

MAX_R_PARA: Final = 10
"""Last R parameter of a structure, as delivered; the machine file may say another."""

FAST_M_MASKS: Final = 5
"""Words of the mask of fast M functions."""


class NciCtrl(Struct, iec="ST_NCI_CTRL", pack=2):
    """Command of a channel."""

    cmd = Field("eCmd", E_NCI_CTRL, "command", default=NciCommand.INIT)
    override = Field("rOverride", REAL, "override (percent), applied in every cycle", default=47.11)
    program_name = Field("sProgramName", STRING(255), "full path of the NC program")


class NciState(Struct, iec="ST_NCI_STATE", pack=2):
    """Answer of a channel."""

    state = Field("eState", E_NCI_STATE, "command + progress")
    m_function_request = Field("bMFuncReq", BIT, "an M function waits for its acknowledgement")
    m_function = Field("nMFunc", WORD, "its number")
    interpreter_state = Field("nItpState", UINT, "E_NCI_INTERPRETER_STATE")
    override = Field("rAxisOverride", LREAL, "override in force (percent)")
    program_name = Field("sProgramNameActive", STRING(255), "last loaded program")


class AxisGroup(Struct, iec="ST_3D_Group", pack=2):
    """Axes of a channel, by their ids in the NC; 0 for none."""

    x = Field("nXAxisId", UDINT, "X", default=1)
    y = Field("nYAxisId", UDINT, "Y", default=2)
    z = Field("nZAxisId", UDINT, "Z", default=3)
    q1 = Field("nQ1AxisId", UDINT, "auxiliary axis 1")
    q2 = Field("nQ2AxisId", UDINT, "auxiliary axis 2")
    q3 = Field("nQ3AxisId", UDINT, "auxiliary axis 3")
    q4 = Field("nQ4AxisId", UDINT, "auxiliary axis 4")
    q5 = Field("nQ5AxisId", UDINT, "auxiliary axis 5")


class IndexGroup(Struct, iec="ST_Index_Group", pack=2):
    """Axes of a channel, by their indices; used by nothing."""

    x = Field("nXAxisIdx", UDINT, "X", default=1)
    y = Field("nYAxisIdx", UDINT, "Y", default=2)
    z = Field("nZAxisIdx", UDINT, "Z", default=3)
    q1 = Field("nQ1AxisIdx", UDINT, "auxiliary axis 1")
    q2 = Field("nQ2AxisIdx", UDINT, "auxiliary axis 2")
    q3 = Field("nQ3AxisIdx", UDINT, "auxiliary axis 3")
    q4 = Field("nQ4AxisIdx", UDINT, "auxiliary axis 4")
    q5 = Field("nQ5AxisIdx", UDINT, "auxiliary axis 5")


class RParameters(Struct, iec="ST_R_Parameter", pack=2):
    """R parameters of a channel, _nStart and the ones behind it; the room is MAX_R_PARA + 1."""

    start = Field("_nStart", DINT, "first R number: 0 to 899 of the channel, 900 to 999 of all", default=901)
    count = Field("_nCount", DINT, "how many", default=4)
    values = Field("_rValue", Array(LREAL, (0, MAX_R_PARA)), "their values")


class MFunctions(Struct, iec="ST_NCI_M_FUNC", pack=2):
    """M and H functions of a channel."""

    fast_mask = Field("FastMFuncMask", Array(DWORD, (1, FAST_M_MASKS)), "fast M functions, one bit each")
    handshake_number = Field("HskMFuncNo", UINT, "M function that waits for its acknowledgement")
    handshake_request = Field("HskMFuncReq", WORD, "0 for none")
    h_value = Field("HFuncValue", UDINT, "value of the H function")
    granted = Field("MFuncGranted", UINT, "acknowledgement of the layer")
