"""`SymbolTable`: all variables of an interface by name, down to members, elements and bits."""

import difflib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from motionlayer.iec._array import Array
from motionlayer.iec._enumeration import Enumeration
from motionlayer.iec._method import Method
from motionlayer.iec._path import Step, split
from motionlayer.iec._struct_type import StructType
from motionlayer.iec._type import Bytes, IecType, Memory

Named = StructType[Any] | Enumeration[Any]
"""A type that is declared under a name of its own."""


class Source(Protocol):
    """What holds the value of a symbol: an `InputArray`, an `OutputArray`, or something like them."""

    @property
    def type(self) -> IecType[Any, Any]:
        """The type of the whole."""

    @property
    def memory(self) -> Memory:
        """Its published bytes."""

    @property
    def writable(self) -> bool:
        """Clients may write it."""

    def read(self, offset: int, size: int) -> bytes:
        """Return bytes as they are now."""

    def write(self, offset: int, data: Bytes, by: str, /) -> None:
        """Write bytes, or raise PermissionError."""


@dataclass(frozen=True, slots=True, eq=False)
class Symbol:
    """A global variable.

    Attributes:
        name: `GVL_AXIS.Ctrl`.
        source: its value.
        comment: what it is.
        attributes: of the declaration, by name.
        aliases: other names of the same.
        methods: of every element of an array, or of the single object.
    """

    name: str
    source: Source
    comment: str
    attributes: Mapping[str, str]
    aliases: tuple[str, ...]
    methods: tuple[Method, ...] = ()

    @property
    def type(self) -> IecType[Any, Any]:
        """Its type."""
        return self.source.type


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """A variable, or a part of one.

    Attributes:
        name: as somebody asked for it.
        symbol: the variable.
        type: of the part.
        offset: of the part from the beginning of the variable, in bytes.
        bit: of a BIT, the bit in that byte; None of all others.
    """

    name: str
    symbol: Symbol
    type: IecType[Any, Any]
    offset: int
    bit: int | None

    @property
    def size(self) -> int:
        """Bytes of the part."""
        return self.type.size

    def read(self) -> Any:  # noqa: ANN401 - whatever it is declared as
        """Return the present value; of a structure or an array, a copy."""
        data = self.symbol.source.read(self.offset, self.size)
        return self.type.unpack_from(data) if self.bit is None else data[0] >> self.bit & 1 == 1

    def write(self, value: object, by: str) -> None:
        """Write a value.

        Args:
            value: as the type takes it.
            by: who writes, for messages.

        Raises:
            TypeError, ValueError: the value is of the wrong kind or out of range.
            PermissionError: the variable is not written by clients, or not by this one.
        """
        checked = self.type.check(value, self.name)
        data = bytearray(self.size)
        if self.bit is None:
            self.type.pack_into(checked, data)
        else:
            (old,) = self.symbol.source.read(self.offset, 1)
            data[0] = old & ~(1 << self.bit) | checked << self.bit
        self.symbol.source.write(self.offset, data, by)


class SymbolTable:
    """Variables by name; case makes no difference."""

    def __init__(self) -> None:
        self._symbols: list[Symbol] = []
        self._known: dict[str, Symbol] = {}
        self._types: dict[str, Named] = {}

    def __iter__(self) -> Iterator[Symbol]:
        return iter(self._symbols)

    def __len__(self) -> int:
        return len(self._symbols)

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name.lower() in self._known

    @property
    def types(self) -> Sequence[Named]:
        """All structures, unions and enumerations; each stands behind those that it is made of."""
        return tuple(self._types.values())

    def add(
        self,
        name: str,
        source: Source,
        *,
        comment: str = "",
        attributes: Mapping[str, str] | None = None,
        aliases: Sequence[str] = (),
        methods: Sequence[Method] = (),
    ) -> Symbol:
        """Add a variable.

        Args:
            name: with its namespace, `GVL_AXIS.Ctrl`.
            source: its value.
            comment: what it is.
            attributes: of the declaration, by name.
            aliases: other names, with their namespaces.
            methods: what clients can call; of a structure, or of each element of an array with one index.

        Raises:
            ValueError: a name is taken or is none, another type has the name of one of its types, or there are methods
                of something that is no structure.
        """
        symbol = Symbol(name, source, comment, dict(attributes or {}), tuple(aliases), tuple(methods))
        if methods and not _is_object(source.type):
            raise ValueError(f"symbol {name}: {source.type.name} has no methods, only structures have")
        for one in (name, *aliases):
            if any(isinstance(step, tuple) for step in split(one)):
                raise ValueError(f"symbol {one!r}: the name of a variable has no index")
            if one.lower() in self._known:
                raise ValueError(f"symbol {one}: there is one already")
        types = dict(self._types)
        _note(source.type, types)
        self._types = types

        self._known.update(dict.fromkeys((one.lower() for one in (name, *aliases)), symbol))
        self._symbols.append(symbol)
        return symbol

    def find(self, name: str) -> Place:
        """Return a variable or a part of one: `GVL_AXIS.Ctrl[2].eCmd`.

        Raises:
            ValueError: it is not written as a name.
            KeyError: there is no such variable or member; the message names the nearest.
            IndexError: an index is out of its bounds; the message tells them.
        """
        steps = split(name)
        symbol, used = self._root(name, steps)
        kind, offset, bit, told = symbol.type, 0, None, symbol.name
        for step in steps[used:]:
            kind, further, bit = _inside(kind, step, told)
            told += f".{step}" if isinstance(step, str) else f"[{', '.join(map(str, step))}]"
            offset += further
        return Place(name, symbol, kind, offset, bit)

    def read(self, name: str) -> Any:  # noqa: ANN401
        """Return the present value of a variable or a part of one; see `find` and `Place.read`."""
        return self.find(name).read()

    def write(self, name: str, value: object, by: str) -> None:
        """Write a variable or a part of one; see `find` and `Place.write`."""
        self.find(name).write(value, by)

    def _root(self, name: str, steps: Sequence[Step]) -> tuple[Symbol, int]:
        """Return the variable that a name begins with, and how many steps name it; the longest one counts."""
        names = [step.lower() for step in steps if isinstance(step, str)]
        whole = next((at for at, step in enumerate(steps) if not isinstance(step, str)), len(steps))
        for used in range(whole, 0, -1):
            symbol = self._known.get(".".join(names[:used]))
            if symbol is not None:
                return symbol, used
        asked = ".".join(names[:whole])
        near = difflib.get_close_matches(asked, self._known, n=1)
        hint = f"; did you mean {self._known[near[0]].name}?" if near else ""
        raise KeyError(f"no symbol {name}{hint}")


def _is_object(kind: IecType[Any, Any]) -> bool:
    """Tell whether something is a structure, or an array of them with one index."""
    of = kind.of if isinstance(kind, Array) and len(kind.bounds.pairs) == 1 else kind
    return isinstance(of, StructType)


def _note(kind: IecType[Any, Any], types: dict[str, Named]) -> None:
    """Add to the types those that a type is made of, and itself."""
    if isinstance(kind, Array):
        _note(kind.of, types)
    if not isinstance(kind, StructType | Enumeration):
        return
    known = types.get(kind.name.lower())
    if known is not None and known is not kind:
        raise ValueError(f"type {kind.name}: there is another one of this name")
    if known is None:
        for field in kind.fields if isinstance(kind, StructType) else ():
            _note(field.type, types)
        types[kind.name.lower()] = kind


def _inside(kind: IecType[Any, Any], step: Step, told: str) -> tuple[IecType[Any, Any], int, int | None]:
    """Return type, offset and bit of a part."""
    if not isinstance(step, str):
        if not isinstance(kind, Array):
            raise KeyError(f"{told} ({kind.name}) takes no index")
        try:
            return kind.of, kind.bounds.place(step) * kind.of.size, None
        except (IndexError, TypeError) as error:
            raise IndexError(f"{told}: {error}") from None
    if not isinstance(kind, StructType):
        raise KeyError(f"{told} ({kind.name}) has no members, so no {step}")
    field = kind.field(step)
    if field is None:
        near = difflib.get_close_matches(step, [one.name for one in kind.fields], n=1, cutoff=0.5)
        hint = f"did you mean {near[0]}?" if near else f"it has {', '.join(one.name for one in kind.fields)}"
        raise KeyError(f"{told} ({kind.name}) has no member {step}; {hint}")
    return field.type, field.offset, field.bit
