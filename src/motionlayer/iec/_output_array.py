"""`OutputArray`: what the layer writes and clients read, in the exact bytes of its declaration."""

from typing import Any, Final, NoReturn, overload

import numpy as np

from motionlayer.iec._compound import CompoundType, check_room
from motionlayer.iec._type import Bytes, Got, IecType, Memory
from motionlayer.iec._variable import Variable


class OutputArray(Variable[Got]):
    """Views on one memory; see `Variable`. Elements of scalars are values, all others are made once and kept.

    Args:
        memory: of as many bytes; zeros with the declared start values without.

    Attributes:
        array: the same memory as a NumPy array, one element each; kernels write it.

    Raises:
        ValueError: the memory has another size.
    """

    writable: Final = False

    @overload
    def __init__(
        self, of: type[Got], low: int | None, high: int | None, name: str, *, memory: Memory | None = None
    ) -> None: ...

    @overload
    def __init__(
        self, of: IecType[Got, Any], low: int | None, high: int | None, name: str, *, memory: Memory | None = None
    ) -> None: ...

    def __init__(self, of: Any, low: int | None, high: int | None, name: str, *, memory: Memory | None = None) -> None:
        super().__init__(of, low, high, name)
        size = self.count * self.size
        self.memory = bytearray(size) if memory is None else memory
        if len(self.memory) != size:
            raise ValueError(f"{name}: a memory of {len(self.memory)} bytes, must be {size} ({self.type.name})")
        self._view = memoryview(self.memory)
        self.array: Final[np.ndarray[Any, np.dtype[Any]]] = np.frombuffer(self._view, self.of.dtype, self.count)
        self._placed: list[Got | None] = [None] * self.count
        if memory is None:
            self._start()

    def shown(self, index: int) -> Got:
        """Return an element for those who only read: of a structure a view that refuses to be written.

        Raises:
            IndexError: the index is out of the bounds.
        """
        place, kind = self._place(index), self.of
        if not isinstance(kind, CompoundType):
            return self._element(place)
        made: Got = kind.place(self._view.toreadonly(), place * self.size)
        return made

    def read(self, offset: int, size: int) -> bytes:
        """Return bytes of the whole variable.

        Raises:
            ValueError: they do not lie within it.
        """
        check_room(self.name, size, self.memory, offset)
        return bytes(self.memory[offset : offset + size])

    def write(self, _offset: int, _data: Bytes, by: str) -> NoReturn:
        """Refuse to write.

        Raises:
            PermissionError: always.
        """
        raise PermissionError(f"{self.name} is written by the layer: {by} can only read it")

    def _start(self) -> None:
        initial = self.of.initial()
        for place in range(self.count):
            self.of.pack_into(initial, self.memory, place * self.size)

    def _element(self, place: int) -> Got:
        found = self._placed[place]
        if found is not None:
            return found
        kind: Any = self.of
        if not isinstance(kind, CompoundType):
            return self.of.unpack_from(self.memory, place * self.size)
        made: Got = kind.place(self._view, place * self.size)
        self._placed[place] = made
        return made

    def _assign(self, place: int, value: Got) -> None:
        checked = self.of.check(value, self.element_name(place))
        self.of.pack_into(checked, self.memory, place * self.size)
