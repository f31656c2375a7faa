"""`Method`: what clients call by the symbol of an object; remote procedure call in the words of the interface."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from motionlayer.iec._type import IecType

Call = Callable[..., tuple[Any, ...]]
"""Gets the index of the object (None of a single one), then the inputs in order; returns the outputs in order."""


class Parameter(NamedTuple):
    """An input or an output of a method.

    Attributes:
        name: as declared.
        type: its type.
        comment: what it means, with its unit.
    """

    name: str
    type: IecType[Any, Any]
    comment: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Method:
    """A method of every element of a variable, or of the single object that it is.

    Attributes:
        name: as declared, `MoveAbsolute`.
        call: carries it out. Its result is the value that the method returns, where it has one, then its outputs.
        inputs: in the order of the declaration.
        outputs: likewise.
        returns: type of the value that the method returns; None without.
        comment: what it does.
    """

    name: str
    call: Call
    inputs: tuple[Parameter, ...] = ()
    outputs: tuple[Parameter, ...] = ()
    returns: IecType[Any, Any] | None = None
    comment: str = ""

    @property
    def results(self) -> tuple[IecType[Any, Any], ...]:
        """The types of what `call` returns."""
        first = () if self.returns is None else (self.returns,)
        return (*first, *(one.type for one in self.outputs))
