"""Blocks that read and write parameters (function-blocks 2.4, 2.5)."""

import enum
import numbers
from typing import Any, ClassVar, Final, cast

from motionlayer.command import Command, ErrorId
from motionlayer.fb._axis_block import AxisBlock, EnableBlock, Trouble
from motionlayer.fb._axis_ref import AXIS_REF
from motionlayer.fb._inputs import Input, boolean, integer, lreal
from motionlayer.fb._parameter_numbers import MC_AxisParameter
from motionlayer.fb._parameters import PARAMETERS, UNKNOWN, find

KINDS: Final[dict[type, str]] = {float: "a parameter that is an LREAL", bool: "a parameter that is a BOOL"}
"""How a message speaks of the parameters that a block is for."""


class E_ReadMode(enum.IntEnum):  # noqa: N801 - here and below, names of the interface
    """How often a parameter is read."""

    READMODE_ONCE = 1
    READMODE_CYCLIC = 2


class ReadParameter(EnableBlock):
    """What both kinds have in common.

    Attributes:
        Value: of the parameter.
    """

    KIND: ClassVar[type]
    METHOD = "read_parameter"

    ParameterNumber = integer("MC_AxisParameter", 0, "which parameter")
    ReadMode = cast("int", Input("E_ReadMode", E_ReadMode.READMODE_ONCE, "once per rising edge, or in every call"))

    def __init__(self, axis: AXIS_REF | None = None) -> None:
        super().__init__(axis)
        self.Value: float = self.KIND()

    def _act(self) -> Trouble | None:
        if self.ReadMode not in (E_ReadMode.READMODE_ONCE, E_ReadMode.READMODE_CYCLIC):
            return Trouble(ErrorId.PARAMETER, f"ReadMode = {self.ReadMode}, allowed: 1, 2")
        if self.Valid and self.ReadMode == E_ReadMode.READMODE_ONCE:
            return None
        found = find(self.ParameterNumber, self.KIND)
        if found is None:
            allowed = f"the number of {KINDS[self.KIND]}"
            return Trouble(UNKNOWN, f"ParameterNumber = {self.ParameterNumber}, allowed: {allowed}")
        self.Value = found[1].read(self._ref)
        return None

    def _clear(self) -> None:
        self.Value = self.KIND()


class MC_ReadParameter(ReadParameter):  # noqa: N801
    """Read a parameter that is a number."""

    KIND = float


class MC_ReadBoolParameter(ReadParameter):  # noqa: N801
    """Read a parameter that is TRUE or FALSE."""

    KIND = bool


class WriteParameter(AxisBlock):
    """What both kinds have in common."""

    KIND: ClassVar[type]
    PERSISTENT: ClassVar = False

    ParameterNumber = integer("MC_AxisParameter", 0, "which parameter")
    Value: float

    def _issue(self) -> Command[Any]:
        ref, found = self._ref, find(self.ParameterNumber, self.KIND)
        if found is None or found[1].write is None:
            allowed = f"the number of {KINDS[self.KIND]} that can be written"
            return self._refuse("write_parameter", UNKNOWN, "ParameterNumber", allowed)
        given: object = self.Value
        if not isinstance(given, bool if self.KIND is bool else numbers.Real):
            raise TypeError(f"Value is {given!r}, a {type(given).__name__}; it must be a {self.KIND.__name__}")
        return write_parameter(ref, self.ParameterNumber, float(given), persistent=self.PERSISTENT)


def write_parameter(ref: AXIS_REF, number: int, value: float, *, persistent: bool = False) -> Command[Any]:
    """Write a parameter; it holds at once.

    Args:
        ref: the axis.
        number: which parameter.
        value: in its unit; 1.0 or 0.0 for one that is TRUE or FALSE.
        persistent: keep it for the runs to come.

    Returns:
        A command that is done, or refused: number, value or place to keep it is not as it must be.
    """
    parameter = PARAMETERS.get(cast("MC_AxisParameter", number))
    if parameter is None or parameter.write is None:
        detail = f"ParameterNumber = {number}, allowed: the number of a parameter that can be written"
        return ref.axis.refuse("write_parameter", UNKNOWN, detail)
    name = MC_AxisParameter(number).name
    if parameter.kind is bool and value not in (0.0, 1.0):
        return ref.axis.refuse("write_parameter", ErrorId.PARAMETER, f"{name} = {value}, allowed: 0.0, 1.0")
    if persistent and ref.keep is None:
        detail = f"{name}: the machine file names no persistent_file"
        return ref.axis.refuse("write_parameter", ErrorId.FUNCTION_NOT_ALLOWED, detail)
    new = parameter.kind(value)
    command = parameter.write(ref, name, new)
    if not persistent or ref.keep is None or command.error is not None:
        return command
    trouble = ref.keep(ref.axis.name, name, new)
    return ref.axis.refuse("write_parameter", ErrorId.INTERNAL, trouble) if trouble else command


class MC_WriteParameter(WriteParameter):  # noqa: N801
    """Write a parameter that is a number; it holds at once."""

    KIND = float
    Value = lreal(0.0, "new value, in the unit of the parameter")


class MC_WriteBoolParameter(WriteParameter):  # noqa: N801
    """Write a parameter that is TRUE or FALSE; it holds at once."""

    KIND = bool
    Value = boolean("new value")


class MC_WriteParameterPersistent(MC_WriteParameter):  # noqa: N801
    """Write a parameter that is a number, and keep it for the runs to come.

    It is kept in the file that `persistent_file` of the machine file names, and written again at the start of each run.
    """

    PERSISTENT = True


class MC_WriteBoolParameterPersistent(MC_WriteBoolParameter):  # noqa: N801
    """Write a parameter that is TRUE or FALSE, and keep it for the runs to come; see MC_WriteParameterPersistent."""

    PERSISTENT = True
