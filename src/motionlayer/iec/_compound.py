"""`Compound`: values that live in one place and are changed there, structures and arrays."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any, TypeVar

from motionlayer.iec._type import Bytes, Guard, IecType, Memory, Put

C = TypeVar("C", bound="Compound")


class Compound(ABC):
    """A value with parts. Assignment copies into it, as in IEC 61131-3: two variables never share their parts."""

    __slots__ = ()

    @abstractmethod
    def pack_into(self, memory: Memory, offset: int = 0) -> None:
        """Write its bytes, padding as zeros.

        Raises:
            ValueError: they do not fit into the memory behind the offset.
        """

    @abstractmethod
    def unpack_from(self, memory: Bytes, offset: int = 0) -> None:
        """Take on the value that the bytes hold; the guard is not asked.

        Raises:
            ValueError: the memory ends too early.
        """

    @abstractmethod
    def attach(self, guard: Guard | None) -> None:
        """Call `guard` from now on before every write to it or a part of it."""

    @abstractmethod
    def __bytes__(self) -> bytes:
        """Return its bytes."""


class CompoundType(IecType[C, Put]):
    """The type of a compound value; `place` makes one that looks at memory."""

    @abstractmethod
    def place(self, memory: memoryview, offset: int) -> C:
        """Return a value whose parts read and write the memory."""

    def pack_into(self, value: C, memory: Memory, offset: int = 0) -> None:
        """Write the bytes of a value."""
        value.pack_into(memory, offset)

    def unpack_from(self, memory: Bytes, offset: int = 0) -> C:
        """Return a new value with what the bytes hold."""
        value = self.initial()
        value.unpack_from(memory, offset)
        return value

    def unpack_each(self, values: Sequence[C], rows: bytes) -> None:
        """Let values take on as many rows of bytes, which lie one behind the other; no guard is asked."""
        for row, value in enumerate(values):
            value.unpack_from(rows, row * self.size)


def check_room(who: str, size: int, memory: Bytes, offset: int) -> None:
    """Refuse memory that `size` bytes at `offset` do not fit into.

    Raises:
        ValueError: what is missing.
    """
    if offset < 0 or offset + size > len(memory):
        raise ValueError(f"{who}: {size} bytes at offset {offset} do not lie within a memory of {len(memory)} bytes")


def type_of(declared: Any) -> IecType[Any, Any]:  # noqa: ANN401 - what the overloads of the callers tell
    """Return the type that was declared: itself, or the one of a structure's class.

    Raises:
        TypeError: it is neither.
    """
    if isinstance(declared, IecType):
        return declared
    found = getattr(declared, "type", None)
    if isinstance(found, IecType):
        return found
    raise TypeError(f"{declared!r} is no IEC type: use one of motionlayer.iec, or a class derived from Struct or Union")


def refuse_write(who: str) -> Guard:
    """Return a guard that lets nothing be written."""

    def refuse() -> None:
        raise PermissionError(f"{who}: this memory is read-only; write where it comes from")

    return refuse
