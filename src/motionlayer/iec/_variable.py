"""`Variable`: what the arrays of inputs and outputs have in common, a global variable of an interface."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import Any, Final, Generic, overload

from motionlayer.iec._array import Array
from motionlayer.iec._bounds import Bounds
from motionlayer.iec._compound import check_room, type_of
from motionlayer.iec._type import Got, IecType, Memory


class Variable(ABC, Generic[Got]):
    """An array with one dimension, or a single object, with its bytes.

    Args:
        of: the type of an element, or the class of a structure.
        low: lower bound, None for a single object.
        high: upper bound, None for a single object.
        name: the symbol, for messages.

    Attributes:
        name: as given.
        of: type of an element.
        type: type of the whole variable.
        low: as given.
        high: as given.
        size: of an element in bytes.
        count: of elements.
        memory: the bytes of all elements.

    Raises:
        TypeError: `of` is no type.
        ValueError: the bounds are none.
    """

    # The layer asks in every cycle whether variables were touched; a slot is read without a search.
    __slots__ = ("_bounds", "count", "high", "low", "memory", "name", "of", "size", "type")

    memory: Memory

    @overload
    def __init__(self, of: type[Got], low: int | None, high: int | None, name: str) -> None: ...

    @overload
    def __init__(self, of: IecType[Got, Any], low: int | None, high: int | None, name: str) -> None: ...

    def __init__(self, of: Any, low: int | None, high: int | None, name: str) -> None:
        self.name: Final = name
        self.of: Final[IecType[Got, Any]] = type_of(of)
        self.low: Final = low
        self.high: Final = high
        self.size: Final = self.of.size
        self._bounds = None if low is None or high is None else Bounds([(low, high)])
        self.count: Final = 1 if self._bounds is None else self._bounds.count
        self.type: Final[IecType[Any, Any]] = self.of if self._bounds is None else Array(self.of, *self._bounds.pairs)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name}: {self.type.name}>"

    def __len__(self) -> int:
        return self.count

    def __iter__(self) -> Iterator[Got]:
        return (self._element(place) for place in range(self.count))

    def __getitem__(self, index: int) -> Got:
        return self._element(self._place(index))

    def __setitem__(self, index: int, value: Got) -> None:
        self._assign(self._place(index), value)

    @property
    def value(self) -> Got:
        """The single object.

        Raises:
            TypeError: the variable is an array.
        """
        return self._element(self._place(None))

    @value.setter
    def value(self, value: Got) -> None:
        self._assign(self._place(None), value)

    def index(self, place: int) -> int | None:
        """Return the index of an element by its place, from 0; None for a single object."""
        return None if self.low is None else self.low + place

    def element_name(self, place: int) -> str:
        """Return the symbol of an element by its place: `GVL_AXIS.Ctrl[2]`."""
        return self.name if self.low is None else f"{self.name}[{self.low + place}]"

    def _place(self, index: int | None) -> int:
        """Return the place of an element.

        Raises:
            TypeError: an index is missing, or is one too many.
            IndexError: it is out of the bounds; the message tells them.
        """
        if self._bounds is None or index is None:
            if (self._bounds is None) is not (index is None):
                hint = f"an array: give an index, [{self._bounds}]" if index is None else "a single object: use value"
                raise TypeError(f"{self.name} is {hint}")
            return 0
        if type(index) is int and self.low is not None and 0 <= index - self.low < self.count:
            return index - self.low
        try:
            return self._bounds.place(index)
        except (IndexError, TypeError) as error:
            raise type(error)(f"{self.name}: {error}") from None

    def _span(self, offset: int, size: int) -> range:
        """Return the places that some bytes of the whole variable touch.

        Raises:
            ValueError: they do not lie within it.
        """
        check_room(self.name, size, self.memory, offset)
        if not size:
            return range(0)
        return range(offset // self.size, -(-(offset + size) // self.size))

    @abstractmethod
    def _element(self, place: int) -> Got:
        """Return an element by its place."""

    @abstractmethod
    def _assign(self, place: int, value: Got) -> None:
        """Write an element by its place."""
