"""All global variables of the layer, and their symbols (motion-layer 4, aliases of 1.7).

What clients write is an `InputArray`, what the layer writes an `OutputArray`. Every variable is there, whether or not
the layer carries out what it is for.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

from motionlayer.iec import STRING, InputArray, OutputArray, SymbolTable, Variable
from motionlayer.iec.export import Constant
from motionlayer.layer._axis_ref_array import AxisRefArray
from motionlayer.layer._constants import VERSION, Features, Sizes, constants
from motionlayer.layer._function_globals import CamGlobals, FunctionGlobals, NciGlobals, SawGlobals
from motionlayer.layer._global_list import GlobalList, Reach
from motionlayer.layer._message_globals import MessageGlobals, OtherMessageGlobals
from motionlayer.layer.types import (
    E_PROGRESS,
    AxisCtrl,
    AxisInfo,
    AxisState,
    GearIn,
    Homing,
    LimitSwitches,
    MotionOptions,
    MoveData,
    NcParameter,
    SelectorCtrl,
    SelectorState,
)

if TYPE_CHECKING:
    from motionlayer.nc import AxisRefs

CONSTANTS: Final = "PLC_CONSTANT"


class AxisGlobals(GlobalList):
    """Variables of `GVL_AXIS`, one element per axis but for the selector.

    Args:
        sizes: how many axes there are.
        images: their cyclic interface; None on a control side.
        references: positions that the homings of the axes begin with, u; empty where they are not known.

    Attributes:
        ctrl: command.
        state: what has become of it.
        info: what the axis is doing.
        data: positions, velocities, dynamics, override.
        parameter_in: parameter to be read or written.
        parameter_out: parameter read or written.
        homing: how the axis is homed.
        gear: how it is coupled.
        options: buffer mode, distance.
        switches: limit switches and calibration cam.
        selector_ctrl: command of the parameter selector.
        selector_state: what has become of it.
        ref: cyclic images of the NC.
    """

    def __init__(self, sizes: Sizes, images: "AxisRefs | None", references: Sequence[float]) -> None:
        super().__init__()
        last, name = sizes.max_axis, "GVL_AXIS"
        self.ctrl = self.add(InputArray(AxisCtrl, 1, last, f"{name}.Ctrl"), "command")
        self.state = self.add(OutputArray(AxisState, 1, last, f"{name}.State"), "state")
        self.info = self.add(OutputArray(AxisInfo, 1, last, f"{name}.Info"), "what the axis is doing")
        self.data = self.add(InputArray(MoveData, 1, last, f"{name}.Data"), "where to and how fast")
        self.parameter_in = self.add(InputArray(NcParameter, 1, last, f"{name}.NcParameterIn"), "parameter asked for")
        self.parameter_out = self.add(OutputArray(NcParameter, 1, last, f"{name}.NcParameterOut"), "parameter handled")
        start = [{"stHomingParam": {"Position": one}} for one in references] if any(references) else None
        self.homing = self.add(
            InputArray(Homing, 1, last, f"{name}.HomeParameter"), "how the axis is homed", start=start
        )
        for index, reference in enumerate(references, 1):
            self.homing[index].parameters.position = reference
        self.gear = self.add(InputArray(GearIn, 1, last, f"{name}.GearInParameter"), "how it is coupled")
        self.options = self.add(InputArray(MotionOptions, 1, last, f"{name}.MotionOptions"), "options of jobs")
        self.switches = self.add(
            InputArray(LimitSwitches, 1, last, f"{name}.LimitSwitches"), "switches of the machine", reach=Reach.SYMBOL
        )
        self.selector_ctrl = self.add(
            InputArray(SelectorCtrl, None, None, f"{name}.SelectorCtrl"), "parameter asked for"
        )
        self.selector_state = self.add(OutputArray(SelectorState, None, None, f"{name}.SelectorState"), "its answer")
        self.ref = self.add(AxisRefArray(images, last), "images of the NC", reach=Reach.NOT)


class ProgramGlobals(GlobalList):
    """How far the start-up of each program is, as an output of the process; `PROGRESS_DONE` is ready.

    Attributes:
        axis: of `MAIN_AXIS`, for which a client waits before it uses anything.
        functions: of `FUNCTIONS`.
        nci: of `NCI`.
        cam: of `CAM`.
        saw: of `FLYING_SAW`.
    """

    def __init__(self) -> None:
        super().__init__()
        self.axis = self._program("MAIN_AXIS", "MAIN.eInit")
        self.functions = self._program("FUNCTIONS")
        self.nci = self._program("NCI")
        self.cam = self._program("CAM")
        self.saw = self._program("FLYING_SAW")

    def _program(self, name: str, *aliases: str) -> OutputArray[Any]:
        return self.add(OutputArray(E_PROGRESS, None, None, f"{name}.eInit"), "start-up; 10000 is ready", *aliases)


class Globals:
    """All global variables.

    Args:
        sizes: how many of each there are.
        features: what is built in.
        images: of the axes; None on a control side, whose axes are in another machine.
        references: what `home.position` is for each axis, u; a control side does not know it.

    Attributes:
        sizes: as given.
        features: as given.
        symbols: all variables by name.
        axis: `GVL_AXIS`.
        program: `eInit` of all programs.
        functions: `GVL_FUNCTIONS`.
        nci: `GVL_NCI`.
        cam: `GVL_CAM`.
        saw: `GVL_FLYING_SAW`.
        messages: `GVL_MSG_AXIS`.
        other_messages: `GVL_MSG`.
    """

    def __init__(
        self,
        sizes: Sizes,
        features: Features,
        images: "AxisRefs | None" = None,
        references: Sequence[float] = (),
    ) -> None:
        self.sizes = sizes
        self.features = features
        self.axis = AxisGlobals(sizes, images, references)
        self.program = ProgramGlobals()
        self.functions = FunctionGlobals(sizes)
        self.nci = NciGlobals(sizes)
        self.cam = CamGlobals(sizes)
        self.saw = SawGlobals(sizes)
        self.messages = MessageGlobals(sizes, features)
        self.other_messages = OtherMessageGlobals(sizes)
        self.symbols = SymbolTable()
        for group in (*self._groups, _constant_list(sizes, features)):
            group.register(self.symbols)

    @property
    def lists(self) -> Mapping[str, GlobalList]:
        """Variables that a control side shares with the layer, by the name of their list."""
        return {
            "GVL_AXIS": self.axis,
            "GVL_FUNCTIONS": self.functions,
            "GVL_NCI": self.nci,
            "GVL_CAM": self.cam,
            "GVL_FLYING_SAW": self.saw,
        }

    @property
    def arrays(self) -> Mapping[str, Variable[Any]]:
        """All variables by the names of their symbols."""
        return {one.variable.name: one.variable for group in self._groups for one in group.entries}

    @property
    def _groups(self) -> tuple[GlobalList, ...]:
        return *self.lists.values(), self.program, self.messages, self.other_messages


def _constant_list(sizes: Sizes, features: Features) -> GlobalList:
    made = GlobalList()
    for one in constants(sizes, features):
        made.add_constant(CONSTANTS, one, one.name)
    made.add_constant("PLC_VERSION", Constant("VERSION", STRING(80), VERSION, "of the interface"))
    return made
