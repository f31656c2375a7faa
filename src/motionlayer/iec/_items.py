"""The elements of an array of scalars: where they are, and all of them to bytes and back at once."""

import struct
from collections.abc import Iterable, Iterator
from typing import Any, Generic, Protocol

from motionlayer.iec._type import Bytes, Got, IecType, Memory, Scalar


class Items(Generic[Got]):
    """Codec of as many scalars."""

    def __init__(self, of: Scalar[Got], count: int) -> None:
        self._struct = struct.Struct("<" + of.code * count)
        self._encode, self._decode = of.encoder, of.decoder

    def pack_into(self, values: Iterable[Got], memory: Memory, offset: int) -> None:
        """Write the bytes of checked values."""
        self._struct.pack_into(memory, offset, *(values if self._encode is None else map(self._encode, values)))

    def unpack_from(self, memory: Bytes, offset: int) -> Iterable[Got]:
        """Return the values that the bytes hold."""
        raw = self._struct.unpack_from(memory, offset)
        return raw if self._decode is None else map(self._decode, raw)


class Store(Protocol[Got]):
    """Where the elements are: a list, or memory."""

    def __getitem__(self, at: int, /) -> Got: ...
    def __setitem__(self, at: int, value: Got, /) -> None: ...
    def __iter__(self) -> Iterator[Got]: ...


class Placed(Generic[Got]):
    """Elements in memory."""

    __slots__ = ("_count", "_memory", "_start", "_type")

    def __init__(self, kind: IecType[Got, Any], memory: memoryview, start: int, count: int) -> None:
        self._type, self._memory, self._start, self._count = kind, memory, start, count

    def __getitem__(self, at: int) -> Got:
        return self._type.unpack_from(self._memory, self._start + at * self._type.size)

    def __setitem__(self, at: int, value: Got) -> None:
        self._type.pack_into(value, self._memory, self._start + at * self._type.size)

    def __iter__(self) -> Iterator[Got]:
        return (self[at] for at in range(self._count))
