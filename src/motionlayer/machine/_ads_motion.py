"""`GVL_MOTION.Axis`: one object per axis whose methods ADS clients call; each method is a block of the same name.

A call executes the block once, in the inputs of the next tick, with what the client has sent. What it returns is the
block's ErrorID: 0, and the axis has taken the command; its number comes with it. From then on the members of the object
show what becomes of that command, with the names that blocks have, until the next call. Who shares an axis with other
clients looks at `Command` first: it is the number of the command that the members tell of.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, cast

from motionlayer import fb
from motionlayer.command import ErrorId
from motionlayer.iec import (
    BOOL,
    LREAL,
    STRING,
    UDINT,
    Field,
    IecType,
    Method,
    OutputArray,
    Parameter,
    Struct,
    Symbol,
)
from motionlayer.layer.types import MC_BUFFER_MODE, MC_DIRECTION, MC_HOMING_MODE, NC_BUFFER_MODES, NC_CALIBRATIONS
from motionlayer.machine._ads_functions import switch_power

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF

NAME: Final = "GVL_MOTION.Axis"


class MotionAxis(Struct, iec="FB_MOTION_AXIS", pack=8):
    """An axis with methods, and what has become of the last command that was given by one."""

    name = Field("Name", STRING(31), "of the axis in the machine file")
    command = Field("Command", UDINT, "number of the command, 0 before the first")
    error_id = Field("ErrorID", UDINT, "what went wrong, 0 without")
    busy = Field("Busy", BOOL, "it runs, or waits for its turn")
    active = Field("Active", BOOL, "the axis works on it")
    done = Field("Done", BOOL, "it has come to its end")
    aborted = Field("CommandAborted", BOOL, "another command took over")
    error = Field("Error", BOOL, "it was refused, or ended in error")


BLOCKS: Final[Mapping[str, type[Any]]] = {
    "Reset": fb.MC_Reset,
    "Home": fb.MC_Home,
    "SetPosition": fb.MC_SetPosition,
    "MoveAbsolute": fb.MC_MoveAbsolute,
    "MoveRelative": fb.MC_MoveRelative,
    "MoveAdditive": fb.MC_MoveAdditive,
    "MoveModulo": fb.MC_MoveModulo,
    "MoveVelocity": fb.MC_MoveVelocity,
    "MoveContinuousAbsolute": fb.MC_MoveContinuousAbsolute,
    "MoveContinuousRelative": fb.MC_MoveContinuousRelative,
    "Halt": fb.MC_Halt,
    "Stop": fb.MC_Stop,
}
"""Blocks that execute a command, by the name of the method."""

TYPES: Final[Mapping[str, IecType[Any, Any]]] = {
    "LREAL": LREAL,
    "BOOL": BOOL,
    "MC_BufferMode": MC_BUFFER_MODE,
    "MC_Direction": MC_DIRECTION,
    "MC_HomingMode": MC_HOMING_MODE,
}
"""Types of inputs that methods take; structures of options keep their defaults."""

NUMBERS: Final[Mapping[object, Mapping[int, int]]] = {
    MC_BUFFER_MODE: {number: int(mode) for number, mode in NC_BUFFER_MODES.items()},
    MC_HOMING_MODE: {number: int(mode) for number, mode in NC_CALIBRATIONS.items()},
}
"""The numbers of blocks by those of the compiled interface, where they differ."""

REFUSALS: Final[Mapping[object, ErrorId]] = {
    MC_BUFFER_MODE: ErrorId.BUFFER_MODE,
    MC_HOMING_MODE: ErrorId.MODE_INVALID,
}
"""What a number is refused with that no block has."""

LEFT_OUT: Final = frozenset({"Axis", "Execute", "Enable", "bCalibrationCam"})
"""Inputs that a call has by itself, or that mean something in a cyclic call only."""

_COMMAND: Final = Parameter("Command", UDINT, "number of the command")


class MotionObjects(OutputArray[MotionAxis]):
    """The objects of all axes.

    Args:
        refs: the axes, in the order of their indices 1, 2, 3 …
        tick: returns the present tick.
    """

    def __init__(self, refs: "Sequence[AXIS_REF]", tick: Callable[[], int]) -> None:
        super().__init__(MotionAxis, 1, len(refs), NAME)
        self._refs = refs
        self._tick = tick
        self._last = 0
        self._blocks: dict[int, Any] = {}
        for index, ref in enumerate(refs, 1):
            self[index].name = ref.axis.name[:31]

    def symbol(self) -> Symbol:
        """Return the variable with its methods."""
        methods = (*(self._executing(name, block) for name, block in BLOCKS.items()), self._power(), self._override())
        return Symbol(NAME, self, "axes whose methods can be called", {}, (), methods)

    def publish(self) -> None:
        """Show what has become of the commands."""
        tick = self._tick()
        if tick < self._last:  # the run has been taken back: these commands were never given
            self._forget()
        self._last = tick
        for index, block in list(self._blocks.items()):
            block()
            self._show(index, block)
            if not block.Busy:
                del self._blocks[index]

    def _executing(self, name: str, kind: type[Any]) -> Method:
        """Return the method for a block that executes a command."""
        inputs = _parameters(kind)

        def call(index: int, *values: object) -> tuple[int, int]:
            given = dict(zip(inputs, values, strict=True))
            for one, value in given.items():
                if value not in NUMBERS.get(one.type, (value,)):
                    return self._refused(index, name, one, value)
            block = kind(self._refs[index - 1])
            block(Execute=True, **{one.name: _number(one, value) for one, value in given.items()})
            if kind is fb.MC_Stop:
                block(Execute=False)  # nobody holds the axis locked once it rests: a client may be gone by then
            return self._called(index, block)

        return Method(name, call, inputs, (_COMMAND,), UDINT, (kind.__doc__ or "").partition("\n")[0])

    def _refused(self, index: int, name: str, parameter: Parameter, value: object) -> tuple[int, int]:
        """Let the axis tell that a number means nothing, and return the results of the call."""
        error, allowed = REFUSALS[parameter.type], ", ".join(str(int(one)) for one in NUMBERS[parameter.type])
        detail = f"{parameter.name} = {int(cast('int', value))}, allowed: {allowed}"
        self._refs[index - 1].axis.refuse(name, error, detail)
        return int(error), 0

    def _called(self, index: int, block: Any) -> tuple[int, int]:  # noqa: ANN401 - blocks share their outputs by name
        """Return the results of a call; a command that was refused replaces none that is shown."""
        if block.Error:
            return block.ErrorID, 0
        self._blocks[index] = block
        shown = self[index]
        shown.command = shown.command % 0xFFFF_FFFF + 1
        self._show(index, block)
        return 0, shown.command

    def _show(self, index: int, block: Any) -> None:  # noqa: ANN401
        shown = self[index]
        shown.busy, shown.active, shown.done = block.Busy, block.Active, block.Done
        shown.aborted, shown.error, shown.error_id = block.CommandAborted, block.Error, block.ErrorID

    def _forget(self) -> None:
        self._blocks.clear()
        for shown in self:
            shown.command = shown.error_id = 0
            shown.busy = shown.active = shown.done = shown.aborted = shown.error = False

    def _power(self) -> Method:
        """Return the method that does what MC_Power does in its first call."""
        inputs = (
            Parameter("Enable", BOOL, "controller enable"),
            Parameter("Enable_Positive", BOOL, "release motion in positive direction"),
            Parameter("Enable_Negative", BOOL, "release motion in negative direction"),
        )

        def call(index: int, *bits: bool) -> tuple[int]:
            enable, positive, negative = bits
            command = switch_power(self._refs[index - 1], enable=enable, positive=positive, negative=negative)
            return (0 if command.error is None else int(command.error.id),)

        return Method("Power", call, inputs, (), UDINT, "Switch the controller of an axis on and off.")

    def _override(self) -> Method:
        inputs = (Parameter("VelFactor", LREAL, "factor, 0 to 1"),)

        def call(index: int, factor: float) -> tuple[int]:
            block = fb.MC_SetOverride(self._refs[index - 1])
            block(Enable=True, VelFactor=factor)
            return (block.ErrorID,)

        comment = "Scale the velocity of every motion of an axis."
        return Method("SetOverride", call, inputs, (), UDINT, comment)


def _parameters(kind: type[Any]) -> tuple[Parameter, ...]:
    """Return the inputs of a block that its method takes."""
    declared = {name: one for name, one in kind.INPUTS.items() if name not in LEFT_OUT and one.type in TYPES}
    return tuple(Parameter(name, TYPES[one.type], one.text) for name, one in declared.items())


def _number(parameter: Parameter, value: object) -> object:
    """Return what a block is given for the input of a client, a number that means something."""
    numbers = NUMBERS.get(parameter.type)
    return value if numbers is None else numbers[cast("int", value)]
