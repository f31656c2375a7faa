"""`GVL_NCI`, `GVL_CAM`, `GVL_FLYING_SAW`, `GVL_FUNCTIONS`: what is beside the axes (motion-layer 4)."""

from motionlayer.iec import STRING, InputArray, OutputArray
from motionlayer.layer._constants import Sizes
from motionlayer.layer._global_list import GlobalList, Reach
from motionlayer.layer.types import (
    AxisGroup,
    CamCtrl,
    CamData,
    CamInfo,
    CamState,
    FlyCtrl,
    FlyData,
    FlyOptions,
    FlyState,
    MFunctions,
    MotionFunction,
    MotionFunctionPoint,
    NciCtrl,
    NciState,
    ProbeInput,
    ProbeStatus,
    RParameters,
    TouchProbeCtrl,
    TouchProbeState,
    TriggerCtrl,
    TriggerInput,
    TriggerOutput,
    TriggerOutputState,
    TriggerState,
    resized,
)


class NciGlobals(GlobalList):
    """Variables of `GVL_NCI`, one element per channel.

    Attributes:
        group: axes of the channel.
        ctrl: command.
        state: what has become of it.
        r_read: R parameters that were read; a client says which.
        r_write: R parameters to be written.
        program: program that a client may keep here; not used.
        program_active: last loaded program.
        m_functions: M and H functions, in every cycle.
    """

    def __init__(self, sizes: Sizes) -> None:
        super().__init__()
        last, name = sizes.max_nci_channels, "GVL_NCI"
        parameters = resized(RParameters, "values", sizes.max_r_para)
        self.group = self.add(InputArray(AxisGroup, 1, last, f"{name}.AxisConfig"), "axes of the channel")
        self.ctrl = self.add(InputArray(NciCtrl, 1, last, f"{name}.ChannelCtrl"), "command", f"{name}.stChannelCtrl")
        self.state = self.add(OutputArray(NciState, 1, last, f"{name}.ChannelState"), "state", f"{name}.stChannelState")
        self.r_read = self.add(
            InputArray(parameters, 1, last, f"{name}.R_ParameterRead"), "R parameters read", reach=Reach.READ_IMAGE
        )
        self.r_write = self.add(InputArray(parameters, 1, last, f"{name}.R_ParameterWrite"), "R parameters to write")
        self.program = self.add(InputArray(STRING(255), 1, last, f"{name}.ProgramName"), "not used", reach=Reach.SYMBOL)
        self.program_active = self.add(
            OutputArray(STRING(255), 1, last, f"{name}.ProgramNameActive"), "last loaded", reach=Reach.SYMBOL
        )
        self.m_functions = self.add(
            OutputArray(MFunctions, 1, last, f"{name}.M_FunctionCyclic"), "M and H functions", reach=Reach.SYMBOL
        )


class CamGlobals(GlobalList):
    """Variables of `GVL_CAM`, one element per axis.

    Attributes:
        ctrl: command.
        state: what has become of it.
        data: parameters.
        info: information on the coupling.
        function: motion function that is read or written.
        point: the same of a single point.
    """

    def __init__(self, sizes: Sizes) -> None:
        super().__init__()
        last, name = sizes.max_axis, "GVL_CAM"
        functions = resized(MotionFunction, "points", sizes.max_motion_function_points)
        self.ctrl = self.add(InputArray(CamCtrl, 1, last, f"{name}.Ctrl"), "command")
        self.state = self.add(OutputArray(CamState, 1, last, f"{name}.State"), "state")
        self.data = self.add(InputArray(CamData, 1, last, f"{name}.Data"), "parameters")
        self.info = self.add(OutputArray(CamInfo, 1, last, f"{name}.Info"), "information on the coupling")
        self.function = self.add(
            InputArray(functions, 1, last, f"{name}.MotionFunction"), "points of a cam", reach=Reach.SYMBOL
        )
        self.point = self.add(
            InputArray(MotionFunctionPoint, 1, last, f"{name}.MotionFunctionPoint"),
            "a single point",
            reach=Reach.SYMBOL,
        )


class SawGlobals(GlobalList):
    """Variables of `GVL_FLYING_SAW`, one element per axis.

    Attributes:
        ctrl: command.
        state: what has become of it.
        data: where and how slave and master meet.
        options: limits and checks.
    """

    def __init__(self, sizes: Sizes) -> None:
        super().__init__()
        last, name = sizes.max_axis, "GVL_FLYING_SAW"
        self.ctrl = self.add(InputArray(FlyCtrl, 1, last, f"{name}.Ctrl"), "command")
        self.state = self.add(OutputArray(FlyState, 1, last, f"{name}.State"), "state")
        self.data = self.add(InputArray(FlyData, 1, last, f"{name}.Data"), "where and how they meet")
        self.options = self.add(InputArray(FlyOptions, 1, last, f"{name}.Options"), "limits and checks")


class FunctionGlobals(GlobalList):
    """Variables of `GVL_FUNCTIONS`: trigger boxes and touch probes with their terminals.

    Attributes:
        trigger_ctrl: command of a trigger box.
        trigger_state: what has become of it.
        probe_ctrl: command of a touch probe.
        probe_state: what has become of it.
        probe_input: events of the terminal of a touch probe.
        probe_status: its status.
        trigger_input: feedback of a trigger box.
        trigger_output_status: status of its output terminal.
        trigger_output: its output.
    """

    def __init__(self, sizes: Sizes) -> None:
        super().__init__()
        boxes, probes, name = sizes.max_trigger_box, sizes.max_touch_probe, "GVL_FUNCTIONS"
        ctrl = resized(TriggerCtrl, "positions", sizes.max_trigger_count)
        state = resized(TriggerState, "positions", sizes.max_trigger_count)
        self.trigger_ctrl = self.add(InputArray(ctrl, 1, boxes, f"{name}.CtrlTrigger"), "command")
        self.trigger_state = self.add(OutputArray(state, 1, boxes, f"{name}.StateTrigger"), "state")
        self.probe_ctrl = self.add(InputArray(TouchProbeCtrl, 1, probes, f"{name}.CtrlTouchProbe"), "command")
        self.probe_state = self.add(OutputArray(TouchProbeState, 1, probes, f"{name}.StateTouchProbe"), "state")
        self._add_terminals(name, boxes, probes)

    def _add_terminals(self, name: str, boxes: int, probes: int) -> None:
        self.probe_input = self.add(
            InputArray(ProbeInput, 1, probes, f"{name}.DigitalInput"), "events of a terminal", reach=Reach.NOT
        )
        self.probe_status = self.add(
            InputArray(ProbeStatus, 1, probes, f"{name}.DigitalState"), "status of a terminal", reach=Reach.NOT
        )
        self.trigger_input = self.add(
            InputArray(TriggerInput, 1, boxes, f"{name}.DigitalInputDC"), "feedback of a terminal", reach=Reach.NOT
        )
        self.trigger_status = self.add(
            InputArray(TriggerOutputState, 1, boxes, f"{name}.DigitalOutPutDCState"),
            "status of an output terminal",
            reach=Reach.NOT,
        )
        self.trigger_output = self.add(
            OutputArray(TriggerOutput, 1, boxes, f"{name}.DigitalOutputDC"), "output", reach=Reach.NOT
        )
