"""What clients ask of the axes by the NC ports of an ADS server (ads 8.1, 8.3, 8.4), carried out in the cycle."""

import struct
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

from motionlayer.command import Command, ErrorId
from motionlayer.connect.ads import CYCLIC, FUNCTIONS, PARAMETERS, Code, Outcome, Write, axis_address, function
from motionlayer.fb import write_parameter
from motionlayer.machine._ads_nc import FULL_OVERRIDE, WRITABLE
from motionlayer.machine._ads_stops import clear_task, emergency_stop, oriented_stop, parameterised_stop
from motionlayer.nc import ControlDWord, HomeCommand

if TYPE_CHECKING:
    from motionlayer.fb import AXIS_REF

Function = Callable[["AXIS_REF", bytes], Command[Any] | None]
"""Does something with an axis; gets the data of the request."""

_POSITION: Final = struct.Struct("<2Id")
_U16, _U32, _F64 = struct.Struct("<H"), struct.Struct("<I"), struct.Struct("<d")
_POWER: Final = ControlDWord.Enable, ControlDWord.FeedEnablePlus, ControlDWord.FeedEnableMinus
_END_ABSOLUTE, _END_RELATIVE = 1, 2


def _new_end_position(ref: "AXIS_REF", data: bytes) -> Command[Any]:
    """Move to another end position: 1 an absolute one, 2 one relative to the set position."""
    kind, _, position = _POSITION.unpack(data)
    if kind == _END_ABSOLUTE:
        return ref.axis.move_absolute(position)
    if kind == _END_RELATIVE:
        return ref.axis.move_relative(position)
    return ref.axis.refuse("move_absolute", ErrorId.MODE_INVALID, f"end position of kind {kind}, allowed: 1, 2")


_FUNCTIONS: Final[Mapping[int, Function]] = {
    0x01: lambda ref, _data: ref.axis.reset(),
    0x02: lambda ref, _data: ref.axis.stop(),
    0x03: clear_task,
    0x04: emergency_stop,
    0x05: parameterised_stop,
    0x09: oriented_stop,
    0x10: lambda ref, _data: ref.axis.home(cam=bool(ref.PlcToNc.ControlDWord & ControlDWord.HomingSensor)),
    0x11: _new_end_position,
}


def switch_power(ref: "AXIS_REF", *, enable: bool, positive: bool, negative: bool) -> Command[Any]:
    """Switch the controller on or off and release the directions; show in the cyclic interface what was asked."""
    bits = ControlDWord.Enable * enable | ControlDWord.FeedEnablePlus * positive
    bits |= ControlDWord.FeedEnableMinus * negative
    ref.PlcToNc.ControlDWord = ref.PlcToNc.ControlDWord & ControlDWord.HomingSensor | bits
    return ref.axis.enable(positive=positive, negative=negative) if enable else ref.axis.disable()


def _control(ref: "AXIS_REF", data: bytes) -> Command[Any]:
    """Do what the control word says."""
    (word,) = _U32.unpack(data)
    enable, plus, minus = (bool(word & bit) for bit in _POWER)
    return switch_power(ref, enable=enable, positive=plus, negative=minus)


def _control_bit(bit: ControlDWord) -> Function:
    """Return a function that sets or clears one bit of the control word."""

    def switch(ref: "AXIS_REF", data: bytes) -> Command[Any]:
        word = ref.PlcToNc.ControlDWord
        return _control(ref, _U32.pack(word | bit if any(data) else word & ~bit))

    return switch


def _homing_cam(ref: "AXIS_REF", data: bytes) -> None:
    """Show the signal of the homing cam in the cyclic interface, and tell it to a homing that runs."""
    on, word, command = any(data), ref.PlcToNc.ControlDWord, ref.axis.command
    ref.PlcToNc.ControlDWord = word | ControlDWord.HomingSensor if on else word & ~ControlDWord.HomingSensor
    if isinstance(command, HomeCommand):
        command.cam(on=on)


def _override(ref: "AXIS_REF", data: bytes) -> None:
    (steps,) = _U32.unpack(data)
    ref.axis.set_override(steps / FULL_OVERRIDE)
    ref.PlcToNc.Override = steps


_CYCLIC: Final[Mapping[int, Function]] = {
    0x01: _control,
    0x02: _control_bit(ControlDWord.Enable),
    0x03: _control_bit(ControlDWord.FeedEnablePlus),
    0x04: _control_bit(ControlDWord.FeedEnableMinus),
    0x07: _homing_cam,
    0x21: _override,
}


def _parameter(offset: int) -> Function:
    """Return a function that writes a parameter."""
    number = WRITABLE[offset]

    def write(ref: "AXIS_REF", data: bytes) -> Command[Any]:
        shape = _F64 if len(data) == _F64.size else _U16
        return write_parameter(ref, number, float(shape.unpack(data)[0]))

    return write


_BY_BASE: Final[Mapping[int, Mapping[int, Function]]] = {
    PARAMETERS: {offset: _parameter(offset) for offset in WRITABLE},
    FUNCTIONS: _FUNCTIONS,
    CYCLIC: _CYCLIC,
}


class NcFunctions:
    """Carries out what the NC ports are asked for; an act for writes of the kind FUNCTION.

    Args:
        refs: all axes.
    """

    def __init__(self, refs: "Sequence[AXIS_REF]") -> None:
        self._refs = refs

    def __call__(self, write: Write, _client: str) -> Outcome:
        """Do it, and tell the error of a command that was refused.

        Raises:
            ValueError: the data means nothing.
        """
        group, offset, data = function(write)
        base, axis, offset = axis_address(group, offset)
        command = _BY_BASE[base][offset](self._refs[axis - 1], data)
        if command is None or command.error is None:
            return Outcome(Code.NO_ERROR)
        return Outcome(int(command.error.id))
