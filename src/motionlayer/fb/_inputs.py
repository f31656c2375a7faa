"""Inputs of a block: name, IEC type, default and meaning, declared once in the body of its class.

    class MC_MoveAbsolute(Motion):
        Position = lreal(0.0, "target, u")

To a type checker an input is a value of its type; the class keeps an `Input`, and an instance its value.
"""

import enum
import numbers
from typing import Final, NamedTuple, TypeVar, cast

from motionlayer import nc

NAMES: Final[dict[type[enum.IntEnum], str]] = {
    nc.BufferMode: "MC_BufferMode",
    nc.Direction: "MC_Direction",
    nc.JogMode: "E_JogMode",
    nc.Calibration: "MC_HomingMode",
}
"""Enumerations with the names of the interface."""

COMPILED_BUFFER_MODES: Final = {
    18: nc.BufferMode.BLENDING_LOW,
    19: nc.BufferMode.BLENDING_PREVIOUS,
    20: nc.BufferMode.BLENDING_NEXT,
    21: nc.BufferMode.BLENDING_HIGH,
}
"""Numbers that `MC_BufferMode` has in the compiled libraries and on the interface of the motion layer; taken too."""

BUFFER_MODES: Final = "0 to 5, 18 to 21"
"""Numbers that are taken, for messages."""

E = TypeVar("E", bound=enum.IntEnum)
S = TypeVar("S")


class Input(NamedTuple):
    """One input of a block.

    Attributes:
        type: IEC type, or the name of an enumeration.
        default: value of an input that was never given.
        text: meaning, with the unit.
    """

    type: str
    default: object
    text: str


def lreal(default: float, text: str) -> float:
    """Declare an input of type LREAL."""
    return cast("float", Input("LREAL", default, text))


def boolean(text: str, *, default: bool = False) -> bool:
    """Declare an input of type BOOL."""
    return cast("bool", Input("BOOL", default, text))


def integer(type_: str, default: int, text: str) -> int:
    """Declare an input of an integer type."""
    return cast("int", Input(type_, default, text))


def enumeration(default: E, text: str) -> E:
    """Declare an input of an enumeration; any integer may be given, what it means is checked at the edge."""
    return cast("E", Input(NAMES[type(default)], default, text))


def structure(kind: type[S], text: str) -> S:
    """Declare an input that is a structure; every block has one of its own."""
    return cast("S", Input(kind.__name__, kind, text))


def real(block: object, name: str) -> float:
    """Return an input that is a number.

    Raises:
        TypeError: it is none.
    """
    value = getattr(block, name)
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{type(block).__name__}: {name} is {value!r}; it must be a number")
    return float(value)


def member_of(kind: type[E], value: int) -> E | None:
    """Return the member with a value, None if there is none.

    Raises:
        TypeError: it is not an integer.
    """
    if isinstance(value, bool) or not isinstance(value, int):
        raise TypeError(
            f"{value!r} is not of {NAMES.get(kind, kind.__name__)}: give one of {', '.join(kind.__members__)}"
        )
    try:
        return kind(value)
    except ValueError:
        return None


def buffer_mode_of(value: int) -> nc.BufferMode | None:
    """Return the buffer mode with a number of either kind, None if there is none.

    Raises:
        TypeError: it is not an integer.
    """
    member = member_of(nc.BufferMode, value)
    return COMPILED_BUFFER_MODES.get(value) if member is None else member
