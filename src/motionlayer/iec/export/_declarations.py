"""What is exported: types in an order in which each is declared before it is used, constants and variables."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np

from motionlayer.iec import LREAL, Array, Enumeration, IecType, Member, Real, String, StructType

AnyEnumeration: TypeAlias = Enumeration[Any]
AnyStruct: TypeAlias = StructType[Any]
Start: TypeAlias = Mapping[str, Any] | Sequence[Any] | bool | float | str
"""A start value: of a structure those members, by their names, that may begin with another one than declared, one at
least; of an array of structures, with one index, all elements."""


@dataclass(frozen=True, slots=True)
class Constant:
    """A constant of the interface.

    Attributes:
        name: as declared.
        type: its type, a scalar.
        value: a value of the type.
        comment: what it is for.
    """

    name: str
    type: IecType[Any, Any]
    value: bool | float | str
    comment: str = ""


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable, as the control side sees it.

    Attributes:
        name: as declared, without the list.
        type: its type.
        comment: what it is for.
        written: the control side writes an image of it (True), reads one (False), or reaches it by symbol alone (None).
        optional: a motion side may lack it.
        start: start value of this machine; None for that of the type.
    """

    name: str
    type: IecType[Any, Any]
    comment: str = ""
    written: bool | None = None
    optional: bool = False
    start: Start | None = None


@dataclass(frozen=True, slots=True)
class VariableList:
    """A global variable list.

    Attributes:
        name: `GVL_AXIS`.
        variables: in their order.
        used: the motion side does something with them; who carries variables need not carry others.
    """

    name: str
    variables: Sequence[Variable]
    used: bool = True


@dataclass(frozen=True, slots=True)
class Declarations:
    """Everything that a control side is told.

    Attributes:
        title: first line of each file.
        types: enumerations and structures; those that they are made of need not be named.
        libraries: enumerations and structures of libraries that a controller may have linked already.
        constants: constants, in the list `constant_list`.
        lists: variables.
        constant_list: name of the list of constants.
        start: variable that tells how far the start-up of the motion layer is, `MAIN_AXIS.eInit`; empty where no layer
            is told of.
        aliases: other names of types. C# has none that outlast a file; there the types have their own names alone.
    """

    title: str
    types: Sequence[IecType[Any, Any]]
    libraries: Sequence[IecType[Any, Any]] = ()
    constants: Sequence[Constant] = ()
    lists: Sequence[VariableList] = ()
    constant_list: str = "PLC_CONSTANT"
    start: str = ""
    aliases: Mapping[str, IecType[Any, Any]] = field(default_factory=dict)
    _order: list[IecType[Any, Any]] = field(init=False, default_factory=list)

    def __post_init__(self) -> None:
        variables = (one.type for group in self.lists for one in group.variables)
        self._order.extend(ordered([*self.libraries, *self.types, *variables]))

    def enumerations(self, *, library: bool | None = None) -> list[AnyEnumeration]:
        """Return the enumerations; `library` chooses those of libraries, or the others."""
        return [one for one in self._order if isinstance(one, Enumeration) and self._chosen(one, library)]

    def structs(self, *, library: bool | None = None) -> list[AnyStruct]:
        """Return the structures, those that others are made of first."""
        return [one for one in self._order if isinstance(one, StructType) and self._chosen(one, library)]

    def _chosen(self, kind: IecType[Any, Any], library: bool | None) -> bool:
        return library is None or library == (kind in self.libraries)


def ordered(types: Iterable[IecType[Any, Any]]) -> list[IecType[Any, Any]]:
    """Return the named types among them and in them, each once, a part before the whole.

    Raises:
        ValueError: two different types have one name.
    """
    found: dict[str, IecType[Any, Any]] = {}
    for kind in types:
        for one in _parts(kind):
            known = found.setdefault(one.name.lower(), one)
            if known is not one:
                raise ValueError(f"two different types are named {one.name}; a declaration can hold only one of them")
    return list(found.values())


def element(kind: IecType[Any, Any]) -> IecType[Any, Any]:
    """Return the type of the elements of an array, of whatever depth; any other type itself."""
    while isinstance(kind, Array):
        kind = kind.of
    return kind


def counts(kind: IecType[Any, Any]) -> list[int]:
    """Return the number of elements of each dimension of an array, outermost first; nothing for any other type."""
    found: list[int] = []
    while isinstance(kind, Array):
        found += kind.bounds.shape
        kind = kind.of
    return found


def runs(struct: AnyStruct) -> Iterator[list[Member]]:
    """Yield the members of a structure, those that share a byte together."""
    run: list[Member] = []
    for one in struct.fields:
        if run and not one.bit:
            yield run
            run = []
        run.append(one)
    if run:
        yield run


def number(kind: IecType[Any, Any], value: float) -> str:
    """Return the shortest text of a number that reads back as the same value of the type; a REAL has fewer digits.

    Raises:
        ValueError: it is NaN or infinite, which no language here writes as a constant.
    """
    if not isinstance(kind, Real):
        return str(int(value))
    if not math.isfinite(value):
        raise ValueError(f"a start value {value} cannot be declared; it must be finite ({kind.name})")
    text = repr(value) if kind is LREAL else str(np.float32(value))
    mantissa, mark, exponent = text.partition("e")
    return mantissa + ("" if "." in mantissa else ".0") + mark + exponent


def units(kind: String, value: str) -> list[bytes]:
    """Return the characters of a text as the type stores them, without the zero behind."""
    data: bytes = kind.encode(value)
    return [data[at : at + kind.alignment] for at in range(0, len(data), kind.alignment)]


def one_line(text: str) -> str:
    """Return a comment that ends no comment: without line breaks, and without what closes one in C."""
    return " ".join(text.split()).replace("*/", "* /")


def _parts(kind: IecType[Any, Any]) -> Iterator[IecType[Any, Any]]:
    kind = element(kind)
    if isinstance(kind, StructType):
        for one in kind.fields:
            yield from _parts(one.type)
    if isinstance(kind, StructType | Enumeration):
        yield kind
