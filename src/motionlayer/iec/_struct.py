"""`Struct` and `Union`: structures, declared as classes whose attributes are fields.

The class is made twice over. What a program writes is an object with one slot per member: reading costs a slot read;
writing goes through one `__setattr__` that checks, asks the guard, and stores. What lies in an image is a *view*: of a
derived class, whose attributes read and write memory. Both have the same codec and the same names. A union is always a
view, of memory of its own if it is not made on other.
"""

import difflib
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self

import numpy as np

from motionlayer.iec._codec import Codec
from motionlayer.iec._compound import Compound
from motionlayer.iec._declare import StructMeta
from motionlayer.iec._layout import Member
from motionlayer.iec._struct_type import StructType
from motionlayer.iec._type import Bytes, Guard, Memory
from motionlayer.iec._view import look
from motionlayer.iec._writer import Writer


class Struct(Compound, metaclass=StructMeta):
    """A structure; derive from it with `iec` (its declared name), `pack` (1, 2, 4 or 8) and attributes that are fields.

    Attributes:
        type: its `StructType`.
        dtype: the NumPy type with the same bytes.

    Args:
        values: members that do not have their declared start value, by attribute.

    Raises:
        AttributeError: there is no such member.
        TypeError, ValueError: a value is of the wrong kind or out of range.
    """

    __slots__ = ("_guard",)

    _union: ClassVar[bool] = False
    type: ClassVar[StructType[Any]]
    dtype: ClassVar[np.dtype[Any]]
    _members: ClassVar[dict[str, Member]]
    _writers: ClassVar[dict[str, Writer]]
    _codec: ClassVar[Codec]
    _view_class: ClassVar[Any]

    _guard: Guard | None

    def __init__(self, **values: object) -> None:
        object.__setattr__(self, "_guard", None)
        for attribute, member in self._members.items():
            object.__setattr__(self, attribute, member.initial())
        for attribute, value in values.items():
            setattr(self, attribute, value)

    def __setattr__(self, name: str, value: object) -> None:
        try:
            who, check, put = self._writers[name]
        except KeyError:
            self._refuse(name)
        checked = check(value, who)
        guard = self._guard
        if guard is not None:
            guard()
        put(self, checked)

    if not TYPE_CHECKING:  # there, an attribute that is not declared is an error already

        def __getattr__(self, name: str) -> NoReturn:
            """Refuse to read what is no member; called where nothing else is found."""
            self._refuse(name)

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"{type(self).__name__}.{name}: a member cannot be deleted")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Struct) or other.type is not self.type:
            return NotImplemented
        return all(getattr(self, attribute) == getattr(other, attribute) for attribute in self._members)

    __hash__ = None  # type: ignore[assignment]  # it changes

    def __repr__(self) -> str:
        values = ", ".join(f"{attribute}={getattr(self, attribute)!r}" for attribute in self._members)
        return f"{self.type.cls.__name__}({values})"

    def __bytes__(self) -> bytes:
        memory = bytearray(self.type.size)
        self.pack_into(memory)
        return bytes(memory)

    def __reduce__(self) -> tuple[Any, ...]:
        return self.type.cls.from_bytes, (bytes(self),)

    @classmethod
    def from_bytes(cls, data: Bytes) -> Self:
        """Return a new object with what the bytes hold.

        Raises:
            ValueError: they are not as many as the structure has.
        """
        if len(data) != cls.type.size:
            raise ValueError(f"{cls.type.name}: {len(data)} bytes, must be {cls.type.size}")
        made = cls()
        made.unpack_from(data)
        return made

    @classmethod
    def view(cls, memory: Bytes, offset: int = 0) -> Self:
        """Return an object whose attributes read and write the memory; of bytes, they can be read only.

        Raises:
            ValueError: the memory ends too early.
        """
        made: Self = object.__new__(cls._view_class)
        look(made, cls._members, memory if isinstance(memory, memoryview) else memoryview(memory), offset)
        return made

    def assign(self, other: Self) -> None:
        """Take on all values of another one: checked, guarded, and at once."""
        checked = self.type.check(other)
        if self._guard is not None:
            self._guard()
        self.unpack_from(bytes(checked))

    def pack_into(self, memory: Memory, offset: int = 0) -> None:
        """Write its bytes, padding as zeros.

        Raises:
            ValueError: they do not fit into the memory behind the offset.
        """
        self._codec.pack_into(self, memory, offset)

    def unpack_from(self, memory: Bytes, offset: int = 0) -> None:
        """Take on the values that the bytes hold; the guard is not asked.

        Raises:
            ValueError: the memory ends too early.
        """
        self._codec.unpack_from(self, memory, offset)

    @classmethod
    def unpack_each(cls, values: Sequence["Struct"], rows: bytes) -> None:
        """Let objects of the class, none of them a view, take on as many rows of bytes; no guard is asked."""
        cls._codec.unpack_each(values, rows)

    def attach(self, guard: Guard | None) -> None:
        """Call `guard` from now on before every write to it or a part of it."""
        object.__setattr__(self, "_guard", guard)
        for attribute in self._members:
            part = getattr(self, attribute)
            if isinstance(part, Compound):
                part.attach(guard)

    def _refuse(self, name: str) -> NoReturn:
        who = self.type.cls.__name__
        near = difflib.get_close_matches(name, self._members, n=1)
        hint = f"did you mean {near[0]}?" if near else f"it has {', '.join(self._members)}"
        raise AttributeError(f"{who} ({self.type.name}) has no member {name}; {hint}")


class Union(Struct):
    """A union: all members begin at 0 and show the same bytes; declared as a `Struct`, without BITs.

    Start values are written in the order of the members, one over the other.
    """

    __slots__ = ()

    _union = True

    def __init__(self, **values: object) -> None:
        look(self, self._members, memoryview(bytearray(self.type.size)), 0)
        for attribute, member in self._members.items():
            if member.default is not None:
                self._writers[attribute].put(self, member.initial())
        for attribute, value in values.items():
            setattr(self, attribute, value)
