"""`StructType`: what a structure or union is, for codecs, symbols and export."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, TypeVar

from motionlayer.iec._compound import CompoundType
from motionlayer.iec._layout import Layout, Member, numpy_type

if TYPE_CHECKING:
    from motionlayer.iec._struct import Struct

T = TypeVar("T", bound="Struct")


class StructType(CompoundType[T, T]):
    """The type of a structure's class.

    Args:
        cls: the class of its values.
        name: as declared.
        pack: pack mode: 1, 2, 4 or 8.
        layout: its members.
        union: all members begin at 0.

    Attributes:
        cls: as given.
        fields: members in order.
        pack: as given.
        union: as given.
        comment: the first line of the class docstring.
    """

    def __init__(self, cls: type[T], name: str, pack: int, layout: Layout, *, union: bool) -> None:
        self.cls: Final = cls
        self.name = name
        self.size = layout.size
        self.alignment = layout.alignment
        self.dtype = numpy_type(layout)
        self.pack: Final = pack
        self.fields: Final[tuple[Member, ...]] = layout.members
        self.union: Final = union
        self.comment: Final = (cls.__doc__ or "").partition("\n")[0]

    def field(self, name: str) -> Member | None:
        """Return the member with a declared name, in whatever case, None without one."""
        return next((member for member in self.fields if member.name.lower() == name.lower()), None)

    def initial(self) -> T:
        """Return a new value with the declared start values."""
        return self.cls()

    def check(self, value: object, who: str = "") -> T:
        """Return `value`, which must be of the class."""
        if isinstance(value, self.cls):
            return value
        raise TypeError(f"{who or self.name}: {value!r} must be of class {self.cls.__name__} ({self.name})")

    def unpack_each(self, values: Sequence[T], rows: bytes) -> None:
        """Let objects, none of them a view, take on as many rows of bytes, one behind the other; no guard is asked."""
        if self.union:
            super().unpack_each(values, rows)
        else:
            self.cls.unpack_each(values, rows)

    def place(self, memory: memoryview, offset: int) -> T:
        """Return a value whose attributes read and write the memory."""
        return self.cls.view(memory, offset)
