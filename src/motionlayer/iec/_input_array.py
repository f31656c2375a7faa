"""`InputArray`: what clients and programs write, and the layer reads.

Each element is an object with slots; its bytes are a copy that is made when somebody asks for it. A write by attribute
changes the object, and its bytes with the next `publish`; a write of bytes changes both at once. Either way the element
counts as touched.
"""

from collections.abc import Sequence
from typing import Any, Final, overload

from motionlayer.iec._compound import Compound, CompoundType, check_room
from motionlayer.iec._type import Bytes, ElementGuard, Got, IecType
from motionlayer.iec._variable import Variable


class InputArray(Variable[Got]):
    """Objects that clients write, with their bytes; see `Variable`.

    Attributes:
        guard: called before every write but `accept`, with the index of the element (None of a single object); it may
            raise, and nothing is written then.
        by: while bytes or a symbol are written, who writes them; None while an attribute is written.
        touched: indices of the elements that were written since the last `take`, in the order of their first write; 0
            stands for a single object.
    """

    __slots__ = ("_elements", "_is_touched", "_kind", "_stale", "by", "guard", "touched")

    writable: Final = True
    memory: bytearray

    @overload
    def __init__(self, of: type[Got], low: int | None, high: int | None, name: str) -> None: ...

    @overload
    def __init__(self, of: IecType[Got, Any], low: int | None, high: int | None, name: str) -> None: ...

    def __init__(self, of: Any, low: int | None, high: int | None, name: str) -> None:
        super().__init__(of, low, high, name)
        self.memory = bytearray(self.count * self.size)
        self.guard: ElementGuard | None = None
        self.by: str | None = None
        self.touched: list[int] = []
        self._is_touched = bytearray(self.count)
        self._stale: dict[int, None] = dict.fromkeys(range(self.count))
        self._elements = [self.of.initial() for _ in range(self.count)]
        self._kind: Any = self.of if isinstance(self.of, CompoundType) else None
        for place, element in enumerate(self._elements):
            if isinstance(element, Compound):
                element.attach(_Watch(self, place))
        self.publish()

    def take(self) -> list[int]:
        """Return what was touched, and begin anew."""
        if not self.touched:
            return []
        touched, self.touched = self.touched, []
        self._is_touched[:] = bytes(self.count)
        return touched

    def publish(self) -> None:
        """Bring the bytes up to date."""
        if self._stale:
            for place in self._stale:
                self.of.pack_into(self._elements[place], self.memory, place * self.size)
            self._stale.clear()

    def read(self, offset: int, size: int) -> bytes:
        """Return bytes of the whole variable as it is now, published or not.

        Raises:
            ValueError: they do not lie within it.
        """
        for place in self._span(offset, size):
            self._refresh(place)
        return bytes(self.memory[offset : offset + size])

    def write(self, offset: int, data: Bytes, by: str) -> None:
        """Write bytes of the whole variable; all elements that they touch take them on, or none does.

        Args:
            offset: where they begin.
            data: the bytes.
            by: who writes, for the guard and its messages.

        Raises:
            ValueError: they do not lie within it.
            PermissionError: the guard refuses.
        """
        span = self._span(offset, len(data))
        self._ask(span, by)
        for place in span:
            self._refresh(place)
        self.memory[offset : offset + len(data)] = data
        self.decode(span, bytes(self.memory[span.start * self.size : span.stop * self.size]))

    def accept(self, index: int | None, data: Bytes, offset: int = 0) -> None:
        """Let an element take on bytes from the image that owns it; the guard is not asked.

        Args:
            index: of the element, None of a single object.
            data: begin with its bytes at the offset.
            offset: in the data.

        Raises:
            ValueError: the data ends too early.
            IndexError: the index is out of the bounds.
        """
        place, size = self._place(index), self.size
        if offset < 0 or offset + size > len(data):
            check_room(self.name, size, data, offset)
        row = bytes(data[offset : offset + size])
        self.memory[place * size : (place + 1) * size] = row
        self.decode((place,), row)

    def decode(self, places: Sequence[int], rows: bytes) -> None:
        """Let elements take on what lies in `memory`, for the image that owns them and has written it there.

        Args:
            places: of the elements, from 0.
            rows: their bytes, one element behind the other.
        """
        elements, stale = self._elements, self._stale
        if self._kind is None:
            for row, place in enumerate(places):
                elements[place] = self.of.unpack_from(rows, row * self.size)
        else:
            self._kind.unpack_each([elements[place] for place in places], rows)
        if stale:
            for place in places:
                stale.pop(place, None)
        self._touch(places)

    def before(self, place: int) -> None:
        """Ask the guard and note that an element is about to be written."""
        if self.guard is not None:
            self.guard(self.index(place))
        self._stale[place] = None
        self._touch((place,))

    def _ask(self, span: range, by: str) -> None:
        if self.guard is None:
            return
        self.by = by
        try:
            for place in span:
                self.guard(self.index(place))
        finally:
            self.by = None

    def _touch(self, places: Sequence[int]) -> None:
        known, low = self._is_touched, self.low or 0
        for place in places:
            if not known[place]:
                known[place] = 1
                self.touched.append(place + low)

    def _refresh(self, place: int) -> None:
        if place in self._stale:
            self.of.pack_into(self._elements[place], self.memory, place * self.size)
            del self._stale[place]

    def _element(self, place: int) -> Got:
        return self._elements[place]

    def _assign(self, place: int, value: Got) -> None:
        checked = self.of.check(value, self.element_name(place))
        self.before(place)
        element = self._elements[place]
        if isinstance(element, Compound) and isinstance(checked, Compound):
            element.unpack_from(bytes(checked))
        else:
            self._elements[place] = checked


class _Watch:
    """Guard of one object: tells the array which one it is."""

    __slots__ = ("_array", "_place")

    def __init__(self, array: InputArray[Any], place: int) -> None:
        self._array, self._place = array, place

    def __call__(self) -> None:
        self._array.before(self._place)
