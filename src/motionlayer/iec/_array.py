"""`Array`: the type ARRAY [low..high, …] OF T, and `ArrayValue`, what a variable of it holds."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, Final, Generic, TypeVar, cast, overload

import numpy as np

from motionlayer.iec._bounds import Bounds, Index
from motionlayer.iec._compound import Compound, CompoundType, check_room, refuse_write, type_of
from motionlayer.iec._items import Items, Placed, Store
from motionlayer.iec._type import Bytes, Got, Guard, IecType, Memory, Put, Scalar

S = TypeVar("S", bound=Compound)


class Array(CompoundType["ArrayValue[Got, Put]", "ArrayValue[Got, Put] | Sequence[Put]"], Generic[Got, Put]):
    """ARRAY [low..high, …] OF a type; the last index runs fastest.

    Args:
        of: the type of an element, or the class of a structure.
        bounds: lower and upper bound of each dimension, both inclusive.

    Raises:
        TypeError: `of` is no type.
        ValueError: there are no bounds, or an upper one is below its lower one.
    """

    @overload
    def __init__(self: "Array[Got, Put]", of: IecType[Got, Put], *bounds: tuple[int, int]) -> None: ...

    @overload
    def __init__(self: "Array[S, S]", of: type[S], *bounds: tuple[int, int]) -> None: ...

    def __init__(self, of: Any, *bounds: tuple[int, int]) -> None:
        self.of: Final[IecType[Got, Put]] = type_of(of)
        self.bounds: Final = Bounds(bounds)
        self.name = f"ARRAY [{self.bounds}] OF {self.of.name}"
        self.size = self.bounds.count * self.of.size
        self.alignment = self.of.alignment
        self.dtype = np.dtype((self.of.dtype, self.bounds.shape))
        self.items: Final = Items(self.of, self.bounds.count) if isinstance(self.of, Scalar) else None

    def initial(self) -> "ArrayValue[Got, Put]":
        """Return an array of start values."""
        return ArrayValue(self, [self.of.initial() for _ in range(self.bounds.count)])

    def check(self, value: object, who: str = "") -> "ArrayValue[Got, Put]":
        """Return `value` as an array: one of this type, or a sequence of as many elements in the order of memory."""
        who = who or self.name
        if isinstance(value, str | bytes) or not isinstance(value, Sequence | np.ndarray | ArrayValue):
            raise TypeError(f"{who}: {value!r} must be a sequence of {self.bounds.count} elements ({self.name})")
        if len(value) != self.bounds.count:
            raise ValueError(f"{who}: {len(value)} elements, must be {self.bounds.count} ({self.name})")
        if isinstance(value, ArrayValue) and value.type.of is self.of:
            return value
        made = [self.of.check(one, f"{who}[{self.bounds.text(at)}]") for at, one in enumerate(value)]
        return ArrayValue(self, made)

    def place(self, memory: memoryview, offset: int) -> "ArrayValue[Got, Put]":
        """Return an array whose elements read and write the memory."""
        elements: Store[Got] = Placed(self.of, memory, offset, self.bounds.count)
        if isinstance(self.of, CompoundType):
            elements = [self.of.place(memory, offset + at * self.of.size) for at in range(self.bounds.count)]
        placed = ArrayValue(self, elements)
        if memory.readonly:
            placed.attach(refuse_write(self.name))
        return placed


class ArrayValue(Compound, Generic[Got, Put]):
    """The elements of an array by their declared indices: `points[1]`, `table[2, 0]`.

    Attributes:
        type: its type.
    """

    __slots__ = ("_elements", "_guard", "type")

    def __init__(self, kind: Array[Got, Put], elements: Store[Got]) -> None:
        self.type = kind
        self._elements = elements
        self._guard: Guard | None = None

    def __getitem__(self, index: Index) -> Got:
        return self._elements[self.type.bounds.place(index)]

    def __setitem__(self, index: Index, value: Put) -> None:
        kind = self.type
        place = kind.bounds.place(index)
        checked = kind.of.check(value, f"{kind.of.name}[{kind.bounds.text(place)}]")
        if self._guard is not None:
            self._guard()
        if isinstance(checked, Compound):
            element: Any = self._elements[place]
            element.unpack_from(bytes(checked))
        else:
            self._elements[place] = checked

    def __len__(self) -> int:
        return self.type.bounds.count

    def __iter__(self) -> Iterator[Got]:
        return iter(self._elements)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, ArrayValue):
            return self.type.bounds == other.type.bounds and list(self) == list(other)
        return list(self) == other

    __hash__ = None  # type: ignore[assignment]  # it changes

    def __repr__(self) -> str:
        return repr(list(self))

    def __bytes__(self) -> bytes:
        memory = bytearray(self.type.size)
        self.pack_into(memory)
        return bytes(memory)

    def pack_into(self, memory: Memory, offset: int = 0) -> None:
        """Write its bytes."""
        kind = self.type
        check_room(kind.name, kind.size, memory, offset)
        if kind.items is None:
            for at, element in enumerate(self._compounds()):
                element.pack_into(memory, offset + at * kind.of.size)
            return
        kind.items.pack_into(self._elements, memory, offset)

    def unpack_from(self, memory: Bytes, offset: int = 0) -> None:
        """Take on the value that the bytes hold; the guard is not asked."""
        kind = self.type
        check_room(kind.name, kind.size, memory, offset)
        if kind.items is None:
            for at, element in enumerate(self._compounds()):
                element.unpack_from(memory, offset + at * kind.of.size)
            return
        for at, value in enumerate(kind.items.unpack_from(memory, offset)):
            self._elements[at] = value

    def attach(self, guard: Guard | None) -> None:
        """Call `guard` from now on before every write to an element."""
        self._guard = guard
        if isinstance(self.type.of, CompoundType):
            for element in self._compounds():
                element.attach(guard)

    def _compounds(self) -> Iterable[Compound]:
        """Return the elements, which are no scalars."""
        return cast("Iterable[Compound]", self._elements)
