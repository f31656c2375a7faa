"""`IecType` and `Scalar`: what every type knows of itself, whatever its values are."""

import struct
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from typing import Any, ClassVar, Final, Generic, TypeAlias, TypeVar

import numpy as np

Got = TypeVar("Got")
"""What reading a value gives."""

Put = TypeVar("Put")
"""What may be written; wider than what reading gives for arrays, which take any sequence."""

Memory: TypeAlias = bytearray | memoryview
"""Bytes that can be written."""

Bytes: TypeAlias = bytes | bytearray | memoryview
"""Bytes that can be read."""

Guard: TypeAlias = Callable[[], None]
"""Called before a write takes effect; it may raise, and nothing is written then."""

ElementGuard: TypeAlias = Callable[[int | None], None]
"""The same for elements of an array: called with the index, None of a single object."""


class IecType(ABC, Generic[Got, Put]):
    """A type as the other side declares it.

    Attributes:
        name: as declared, `LREAL`, `ST_AXIS_CTRL`, `ARRAY [1..6] OF UINT`.
        size: in bytes.
        alignment: the multiple at which it begins with pack mode 8, in bytes; the pack mode of a structure around it
            may lower that.
        dtype: the NumPy type with the same bytes.
    """

    UNCHANGING: ClassVar = True
    """A snapshot of a run leaves types out."""

    name: str
    size: int
    alignment: int
    dtype: np.dtype[Any]

    def __repr__(self) -> str:
        return self.name

    @abstractmethod
    def initial(self) -> Got:
        """Return the value that a variable of this type starts with; each call a new one where it can change."""

    @abstractmethod
    def check(self, value: object, who: str = "") -> Got:
        """Return what is kept when `value` is written.

        Args:
            value: whatever somebody wrote.
            who: the variable, for the message; the type itself without.

        Raises:
            TypeError: it is of the wrong kind.
            ValueError: it is out of the type's range.
        """

    @abstractmethod
    def pack_into(self, value: Got, memory: Memory, offset: int = 0) -> None:
        """Write the bytes of a checked value."""

    @abstractmethod
    def unpack_from(self, memory: Bytes, offset: int = 0) -> Got:
        """Read a value; every sequence of bytes is one."""


class Scalar(IecType[Got, Got]):
    """A type whose value is one item in a format of `struct`, and which cannot be changed in place.

    Args:
        name: as declared.
        code: of the value in `struct`, without byte order.
        numpy: of the value in NumPy.
        alignment: in bytes; the size without.

    Attributes:
        code: as given.
        numpy: as given.
    """

    def __init__(self, name: str, code: str, numpy: str, alignment: int | None = None) -> None:
        self.name = name
        self.code: Final = code
        self.numpy: Final = numpy
        self.dtype = np.dtype(numpy)
        self._struct = struct.Struct("<" + code)
        self.size = self._struct.size
        self.alignment = alignment or self.size

    def encode(self, value: Any) -> Any:  # noqa: ANN401 - raw items differ by type
        """Return the item for `struct` of a checked value."""
        return value

    def decode(self, raw: Any) -> Any:  # noqa: ANN401
        """Return the value of an item from `struct`."""
        return raw

    def decode_each(self, raw: Sequence[Any]) -> Iterable[Any]:
        """Return the values of several items from `struct`."""
        return map(self.decode, raw)

    @property
    def read(self) -> Callable[[Bytes, int], tuple[Any, ...]]:
        """The bare read of `struct`, for who reads often: from memory, at an offset."""
        return self._struct.unpack_from

    @property
    def write(self) -> Callable[[Memory, int, Any], None]:
        """The bare write of `struct`: to memory, at an offset, an item."""
        return self._struct.pack_into

    @property
    def encoder(self) -> Callable[[Any], Any] | None:
        """`encode`, or None where `struct` takes the value itself."""
        return None if type(self).encode is Scalar.encode else self.encode

    @property
    def decoder(self) -> Callable[[Any], Any] | None:
        """`decode`, or None where `struct` gives the value itself."""
        return None if type(self).decode is Scalar.decode else self.decode

    def pack_into(self, value: Got, memory: Memory, offset: int = 0) -> None:
        """Write the bytes of a checked value."""
        self._struct.pack_into(memory, offset, self.encode(value))

    def unpack_from(self, memory: Bytes, offset: int = 0) -> Got:
        """Read a value; every sequence of bytes is one."""
        value: Got = self.decode(self._struct.unpack_from(memory, offset)[0])
        return value
