"""`GlobalList`: variables that share a namespace, with what a symbol and a control side are told of them."""

import enum
from collections.abc import Collection
from typing import Any, NamedTuple, TypeAlias, TypeVar

from motionlayer.iec import InputArray, OutputArray, SymbolTable
from motionlayer.iec.export import Constant, Start, Variable

AnyVariable: TypeAlias = InputArray[Any] | OutputArray[Any]
V = TypeVar("V", bound=AnyVariable)


class Reach(enum.Enum):
    """How a control side reaches a variable (motion-layer 7)."""

    IMAGE = "image"
    """It writes an image of an input, and reads one of an output."""
    READ_IMAGE = "read image"
    """It reads an image, although clients may write the variable by symbol."""
    SYMBOL = "symbol"
    """By symbol, or by an image that a map has been asked for."""
    NOT = "not"
    """Not at all: the variable is for the NC or for terminals of the motion side."""


class Entry(NamedTuple):
    """A variable of a list.

    Attributes:
        variable: it, with its name.
        comment: what it is.
        aliases: other names of the same, with their namespaces.
        reach: how a control side reaches it.
        start: start values unlike those of its type.
    """

    variable: AnyVariable
    comment: str
    aliases: tuple[str, ...]
    reach: Reach
    start: Start | None

    def written(self, mapped: Collection[str]) -> bool | None:
        """Tell whether a control side writes an image of it (True), reads one (False), or has none (None)."""
        if self.reach is Reach.SYMBOL:
            return True if self.variable.name in mapped else None
        return isinstance(self.variable, InputArray) and self.reach is Reach.IMAGE


class GlobalList:
    """A global variable list; those that derive from it have an attribute for each variable.

    Attributes:
        entries: the variables in the order of their declaration.
    """

    def __init__(self) -> None:
        self.entries: list[Entry] = []

    def add(
        self, variable: V, comment: str, *aliases: str, reach: Reach = Reach.IMAGE, start: Start | None = None
    ) -> V:
        """Note a variable, and return it; see `Entry`."""
        self.entries.append(Entry(variable, comment, aliases, reach, start))
        return variable

    def add_constant(self, namespace: str, told: Constant, *aliases: str) -> None:
        """Note a variable that holds a constant."""
        variable: OutputArray[Any] = OutputArray(told.type, None, None, f"{namespace}.{told.name}")
        variable.value = told.value
        self.add(variable, told.comment, *aliases)

    def register(self, table: SymbolTable) -> None:
        """Make a symbol of each variable."""
        for one in self.entries:
            table.add(one.variable.name, one.variable, comment=one.comment, aliases=one.aliases)

    def exported(self, mapped: Collection[str] = ()) -> list[Variable]:
        """Return the variables as a control side declares them; `mapped` names those that maps hold."""
        return [
            Variable(
                one.variable.name.partition(".")[2],
                one.variable.type,
                one.comment,
                one.written(mapped),
                start=one.start,
            )
            for one in self.entries
            if one.reach is not Reach.NOT
        ]
