"""Global symbols against the table of motion-layer 4, with the delivered sizes and with others."""

from typing import Any

import numpy as np
import pytest

from motionlayer.iec import InputArray, OutputArray
from motionlayer.layer._constants import Features, Sizes
from motionlayer.layer._declarations import control_side
from motionlayer.layer._globals import Globals
from motionlayer.layer._mapping_table import INPUTS, OUTPUTS
from motionlayer.layer.types import AxisCommand, Progress
from motionlayer.nc import ActualMotion, AxisRefs
from motionlayer.store import Store

TABLE = """
MAIN_AXIS.eInit                     E_PROGRESS                       2 layer
GVL_AXIS.Ctrl                       ST_AXIS_CTRL                    24 client
GVL_AXIS.State                      ST_AXIS_STATE                   36 layer
GVL_AXIS.Info                       ST_AXIS_INFO                   228 layer
GVL_AXIS.Data                       ST_MOVE_DATA                   300 client
GVL_AXIS.NcParameterIn              ST_NC_PARAMETER                 60 client
GVL_AXIS.NcParameterOut             ST_NC_PARAMETER                 60 layer
GVL_AXIS.HomeParameter              ST_HOMING                      396 client
GVL_AXIS.GearInParameter            ST_GEAR_IN                     216 client
GVL_AXIS.MotionOptions              ST_MOTION_OPTIONS               60 client
GVL_AXIS.LimitSwitches              ST_AXIS_LIMIT_SWITCHES          18 client
GVL_AXIS.SelectorCtrl               ST_PARAMETER_SELECTOR_CTRL      18 client
GVL_AXIS.SelectorState              ST_PARAMETER_SELECTOR_STATE     24 layer
GVL_AXIS.AxisRef                    AXIS_REF                      6816 layer
GVL_NCI.AxisConfig                  ST_3D_Group                     32 client
GVL_NCI.ChannelCtrl                 ST_NCI_CTRL                    262 client
GVL_NCI.ChannelState                ST_NCI_STATE                   272 layer
GVL_NCI.R_ParameterRead             ST_R_Parameter                  96 client
GVL_NCI.R_ParameterWrite            ST_R_Parameter                  96 client
GVL_NCI.ProgramName                 STRING(255)                    256 client
GVL_NCI.ProgramNameActive           STRING(255)                    256 layer
GVL_NCI.M_FunctionCyclic            ST_NCI_M_FUNC                   30 layer
GVL_CAM.Ctrl                        ST_CAM_CTRL                     12 client
GVL_CAM.State                       ST_CAM_STATE                   240 layer
GVL_CAM.Data                        ST_CAM_DATA                    660 client
GVL_CAM.Info                        ST_CAM_INFO                   1176 layer
GVL_CAM.MotionFunction              ST_MOTION_FUNCTION            2904 client
GVL_CAM.MotionFunctionPoint         ST_MOTION_FUNCTION_POINT       288 client
GVL_FLYING_SAW.Ctrl                 ST_FLY_CTRL                     12 client
GVL_FLYING_SAW.State                ST_FLY_STATE                    12 layer
GVL_FLYING_SAW.Data                 ST_FLY_DATA                    324 client
GVL_FLYING_SAW.Options              ST_FLY_OPTIONS                 228 client
GVL_FUNCTIONS.CtrlTrigger           ST_CTRL_TRIGGER                576 client
GVL_FUNCTIONS.StateTrigger          ST_STATE_TRIGGER               480 layer
GVL_FUNCTIONS.CtrlTouchProbe        ST_CTRL_TOUCH_PROBE            384 client
GVL_FUNCTIONS.StateTouchProbe       ST_STATE_TOUCH_PROBE           288 layer
GVL_FUNCTIONS.DigitalInput          ST_MTI_INPUT                    96 client
GVL_FUNCTIONS.DigitalState          ST_MTI_STATUS                   60 client
GVL_FUNCTIONS.DigitalInputDC        ST_DC_Input                    288 client
GVL_FUNCTIONS.DigitalOutPutDCState  ST_DC_State                    192 client
GVL_FUNCTIONS.DigitalOutputDC       ST_DC_Output                   192 layer
GVL_MSG_AXIS.MotionMessages         ST_Message                   36800 layer
GVL_MSG_AXIS.MetricMessages         ST_Message                   36800 layer
GVL_MSG_AXIS.MotionMessageCtrl      ST_MESSAGE_CTRL                  2 layer
GVL_MSG_AXIS.MotionMessageState     ST_MESSAGE_STATE                 2 layer
GVL_MSG_AXIS.MetricMessageCtrl      ST_MESSAGE_CTRL                  2 layer
GVL_MSG_AXIS.MetricMessageState     ST_MESSAGE_STATE                 2 layer
GVL_MSG_AXIS.MessageMotionIndex     UINT                             2 layer
GVL_MSG_AXIS.MessageMotionError     UINT                             2 layer
GVL_MSG_AXIS.MessageMetricIndex     UINT                             2 layer
GVL_MSG_AXIS.MessageMetricError     UINT                             2 layer
GVL_MSG_AXIS.MessageLevel           E_MessageType                    4 client
GVL_MSG_AXIS.MessageLevelAxisPtp    E_MessageType                   24 client
GVL_MSG_AXIS.MessageLevelAxisCam    E_MessageType                   24 client
GVL_MSG_AXIS.MessageLevelAxisFly    E_MessageType                   24 client
GVL_MSG_AXIS.MessageLevelNciChn     E_MessageType                    4 client
GVL_MSG_AXIS.MessageLevelTriggerBox E_MessageType                   48 client
GVL_MSG_AXIS.MessageLevelTouchProbe E_MessageType                   48 client
GVL_MSG_AXIS.LOG_DIR                STRING(80)                      81 layer
GVL_MSG_AXIS.LOG_FILE               STRING(80)                      81 layer
GVL_MSG_AXIS.LOG_FILE_METRIC        STRING(80)                      81 layer
GVL_MSG_AXIS.sLocalTime             STRING(80)                      81 layer
GVL_MSG_AXIS.dtLocalTime            DT                               4 layer
GVL_MSG.ApplicationMessages         ST_Message                  368000 layer
GVL_MSG.ApplicationMessageCtrl      ST_MESSAGE_CTRL                  2 layer
GVL_MSG.ApplicationMessageState     ST_MESSAGE_STATE                 2 layer
GVL_MSG.MessageApplicationIndex     UINT                             2 layer
GVL_MSG.MessageApplicationError     UINT                             2 layer
GVL_MSG.TransportMessages           ST_Message                  368000 layer
GVL_MSG.TransportMessageCtrl        ST_MESSAGE_CTRL                  2 layer
GVL_MSG.TransportMessageState       ST_MESSAGE_STATE                 2 layer
GVL_MSG.MessageTransportIndex       UINT                             2 layer
GVL_MSG.MessageTransportError       UINT                             2 layer
GVL_MSG.MetricsMessages             ST_Message                  368000 layer
GVL_MSG.MetricsMessageCtrl          ST_MESSAGE_CTRL                  2 layer
GVL_MSG.MetricsMessageState         ST_MESSAGE_STATE                 2 layer
GVL_MSG.MessageMetricsIndex         UINT                             2 layer
GVL_MSG.MessageMetricsError         UINT                             2 layer
GVL_MSG.ProductMessages             ST_Message                  368000 layer
GVL_MSG.ProductMessageCtrl          ST_MESSAGE_CTRL                  2 layer
GVL_MSG.ProductMessageState         ST_MESSAGE_STATE                 2 layer
GVL_MSG.MessageProductIndex         UINT                             2 layer
GVL_MSG.MessageProductError         UINT                             2 layer
GVL_MSG.MessageLevelStation         E_MessageType                    4 client
GVL_MSG.MessageLevelMover           E_MessageType                    4 client
GVL_MSG.MessageLevelProcess         E_MessageType                    4 client
GVL_MSG.MAX_MESSAGE                 UINT                             2 layer
"""
ROWS = [row.split() for row in TABLE.strip().splitlines()]

CONSTANTS = {
    "MAX_STATION": 1,
    "MAX_MOVER": 1,
    "MAX_PROCESS": 1,
    "MAX_AXIS": 6,
    "MAX_RETRY": 5,
    "NCI_ACTIVE": False,
    "CAM_ACTIVE": False,
    "XFC_ACTIVE": False,
    "FLY_SAW_ACTIVE": False,
    "CONFIG_NAME": "NCI_NOT_ACTIVE",
    "NCI_DIR": "/usr/local/etc/TwinCAT/Mc/Nci/",
    "MAX_NCI_CH": 1,
    "MAX_PATH_STEPS": 5,
    "MAX_MC_AXIS": 3,
    "MAX_AUX_AXIS": 2,
    "MAX_CAM_CH": 1,
    "MAX_MTI_CH": 1,
    "MAX_R_PARA": 10,
    "MAX_MOTION_FUNCTION_POINTS": 10,
    "MAX_TRIGGER_BOX": 12,
    "MAX_TOUCH_PROBE": 12,
    "MAX_TRIGGER_COUNT": 4,
}
"""Motion-layer 1.5, without anything built in."""


@pytest.fixture(scope="module")
def shared() -> Globals:
    return Globals(Sizes(6, max_other_message=2000), Features())


@pytest.mark.parametrize(("name", "of", "total", "writer"), ROWS, ids=[row[0] for row in ROWS])
def test_symbols_of_the_table(shared: Globals, name: str, of: str, total: str, writer: str) -> None:
    place = shared.symbols.find(name)
    source: Any = place.symbol.source
    assert source.of.name == of
    assert place.size == len(source.memory) == int(total)
    assert isinstance(source, InputArray if writer == "client" else OutputArray)
    assert place.symbol.comment


@pytest.mark.parametrize("name", CONSTANTS)
def test_constants_with_and_without_their_list(shared: Globals, name: str) -> None:
    assert shared.symbols.read(name) == shared.symbols.read(f"PLC_CONSTANT.{name}") == CONSTANTS[name]
    with pytest.raises(PermissionError):
        shared.symbols.write(name, CONSTANTS[name], "client")


BESIDE = {
    "PLC_VERSION.VERSION",
    "GVL_MSG_AXIS.MAX_MESSAGE",
    "GVL_MSG_AXIS.MessageMotionLost",
    "GVL_MSG_AXIS.MessageMetricLost",
    "GVL_MSG.MessageApplicationLost",
    "GVL_MSG.MessageTransportLost",
    "GVL_MSG.MessageMetricsLost",
    "GVL_MSG.MessageProductLost",
}
"""Constants of motion-layer 1.5 that are in other lists, and what this runtime adds."""


def test_no_symbol_beside_those_of_the_spec(shared: Globals) -> None:
    told = {row[0] for row in ROWS} | {f"PLC_CONSTANT.{name}" for name in CONSTANTS}
    programs = {f"{name}.eInit" for name in ("FUNCTIONS", "NCI", "CAM", "FLYING_SAW")}
    assert {one.name for one in shared.symbols} == told | programs | BESIDE


def test_start_values_are_those_declared(shared: Globals) -> None:
    assert shared.symbols.read("GVL_AXIS.Data[6].rOverride") == 100.0
    assert shared.symbols.read("GVL_CAM.Data[1].stCamScalingData.rMasterScaling") == 1.0
    assert shared.symbols.read("GVL_NCI.R_ParameterRead[1]._nStart") == 901
    assert shared.symbols.read("PLC_VERSION.VERSION") == "V 01.01.00"
    assert shared.symbols.read("MAIN_AXIS.eInit") is Progress.INVALID


@pytest.mark.parametrize(
    ("name", "alias"),
    [
        ("GVL_NCI.ChannelCtrl[1].eCmd", "GVL_NCI.stChannelCtrl[1].eCmd"),
        ("GVL_NCI.ChannelState[1].eState", "GVL_NCI.stChannelState[1].eState"),
        ("MAIN_AXIS.eInit", "MAIN.eInit"),
        ("GVL_MSG_AXIS.MessageLevel", "GVL_MSG.MessageLevel"),
        ("GVL_MSG_AXIS.sLocalTime", "GVL_MSG.sLocalTime"),
        ("GVL_MSG_AXIS.dtLocalTime", "GVL_MSG.dtLocalTime"),
    ],
)
def test_other_names_lead_to_the_same_memory(shared: Globals, name: str, alias: str) -> None:
    assert shared.symbols.find(alias).symbol is shared.symbols.find(name).symbol


def test_a_client_writes_by_symbol_what_a_program_reads_as_an_object() -> None:
    made = Globals(Sizes(2), Features())
    made.symbols.write("gvl_axis.ctrl[2].ecmd", AxisCommand.MOVE_POS, "client")
    assert made.axis.ctrl[2].cmd is AxisCommand.MOVE_POS
    assert made.axis.ctrl.take() == [2]


def test_other_sizes() -> None:
    sizes = Sizes(64, 3, 1, 2, max_trigger_count=1, max_r_para=20, max_motion_function_points=100, max_message=50)
    made = Globals(sizes, Features(nci=True, windows=True))
    assert made.axis.ctrl.count == 64
    assert made.nci.r_read.size == 8 + 21 * 8
    assert made.functions.trigger_ctrl.size == 24
    assert made.cam.function.size == 4804
    assert (made.messages.motion.messages.count, made.symbols.read("GVL_MSG_AXIS.MAX_MESSAGE")) == (50, 50)
    assert made.symbols.read("MAX_R_PARA") == 20
    assert made.symbols.read("NCI_DIR") == "C:\\TwinCAT\\Mc\\Nci\\"
    assert made.symbols.read("GVL_MSG_AXIS.LOG_DIR") == "C:\\TwinCAT\\#MsgFiles\\"
    assert (made.symbols.read("NCI_ACTIVE"), made.symbols.read("CONFIG_NAME")) == (True, "NCI_Spec_Ch_")


def test_images_of_the_nc_are_shown_as_they_are_when_somebody_reads() -> None:
    store = Store(2, dt=0.001, max_pieces=2)
    images = AxisRefs(store, ActualMotion(store, 2), [360.0, 360.0], [0, 0])
    made = Globals(Sizes(2), Features(), images)
    rng = np.random.default_rng(1)
    for image in (images.nc_to_plc, images.plc_to_nc):
        image.view(np.uint8)[:] = rng.integers(0, 256, image.nbytes, np.uint8)
    source, size = made.axis.ref, 1136
    assert source.read(size + 8 + 128, 256) == images.nc_to_plc[1].tobytes()
    assert source.read(size + 8, 128) == images.plc_to_nc[1].tobytes()
    images.nc_to_plc["ActPos"] = 12.5, 99.25
    assert made.symbols.read("GVL_AXIS.AxisRef[2].NcToPlc.ActPos") == 99.25


@pytest.mark.parametrize(
    ("name", "written"),
    [
        ("GVL_AXIS.Ctrl", True),
        ("GVL_AXIS.State", False),
        ("GVL_AXIS.LimitSwitches", None),
        ("GVL_NCI.R_ParameterRead", False),
        ("GVL_NCI.R_ParameterWrite", True),
        ("GVL_CAM.MotionFunction", None),
        ("MAIN_AXIS.eInit", False),
    ],
)
def test_what_a_control_side_writes_reads_and_reaches_by_symbol(
    shared: Globals, name: str, written: bool | None
) -> None:
    assert shared_with(shared)[name] is written


def test_images_of_the_nc_and_terminals_are_no_matter_of_a_control_side(shared: Globals) -> None:
    told = shared_with(shared)
    assert not {"GVL_AXIS.AxisRef", "GVL_FUNCTIONS.DigitalInput", "GVL_FUNCTIONS.DigitalOutputDC"} & set(told)
    mapped = {name for name, written in told.items() if written is not None}
    assert mapped == {row.symbol for row in INPUTS + OUTPUTS} | {"MAIN_AXIS.eInit"}


def shared_with(shared: Globals) -> dict[str, bool | None]:
    """Return the variables of a control side: writes an image, reads one, has none."""
    lists = control_side(shared, "test").lists
    return {f"{group.name}.{one.name}": one.written for group in lists for one in group.variables}
