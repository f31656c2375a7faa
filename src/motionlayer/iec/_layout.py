"""Where the members of a structure lie (motion-layer 3.1).

A member begins at a multiple of min(its own alignment, pack mode); the size of the structure is rounded up to the
largest such multiple. A nested structure keeps its own inside. BITs that follow one another share a byte, the first in
its lowest bit; after eight, or after any other member, a new byte begins. All members of a union begin at 0.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Final

import numpy as np

from motionlayer.iec._elementary import Bit
from motionlayer.iec._field import Field
from motionlayer.iec._type import IecType, Scalar

PACK_MODES: Final = (1, 2, 4, 8)


@dataclass(frozen=True, slots=True)
class Member:
    """A member and its place.

    Attributes:
        attribute: its name in Python.
        name: its declared name.
        type: its type.
        offset: from the beginning of the structure, in bytes.
        bit: the bit in that byte, None for all but BITs.
        comment: what it means.
        default: its declared start value, None for the one of the type.
    """

    UNCHANGING: ClassVar = True

    attribute: str
    name: str
    type: IecType[Any, Any]
    offset: int
    bit: int | None
    comment: str
    default: Any

    def initial(self) -> Any:  # noqa: ANN401
        """Return the start value; each call a new one where it can change."""
        if self.default is None or isinstance(self.type, Scalar):
            return self.type.initial() if self.default is None else self.default
        return self.type.unpack_from(bytes(self.default))


@dataclass(frozen=True, slots=True)
class Layout:
    """Members in order, size and alignment in bytes."""

    members: tuple[Member, ...]
    size: int
    alignment: int


def lay_out(fields: Mapping[str, Field[Any, Any]], pack: int, *, union: bool = False) -> Layout:
    """Return where the fields of a structure lie."""
    members: list[Member] = []
    end, size, largest, bit = 0, 0, 1, 8
    for attribute, field in fields.items():
        if isinstance(field.type, Bit):
            bit = bit + 1 if bit < 7 else 0
            offset, place = (end, bit) if bit == 0 else (end - 1, bit)
        else:
            bit = 8
            step = min(field.type.alignment, pack)
            largest = max(largest, step)
            offset, place = 0 if union else -(-end // step) * step, None
        end = offset + field.type.size
        size = max(size, end)
        members.append(Member(attribute, field.name, field.type, offset, place, field.comment, field.default))
    return Layout(tuple(members), -(-size // largest) * largest, largest)


def numpy_type(layout: Layout) -> np.dtype[Any]:
    """Return the NumPy type: declared names, exact offsets; a byte of BITs is one u1 field named `bits<offset>`."""
    shown = [
        (member.name if member.bit is None else f"bits{member.offset}", member)
        for member in layout.members
        if not member.bit  # the first of a byte stands for all
    ]
    return np.dtype(
        {
            "names": [name for name, _ in shown],
            "formats": ["u1" if member.bit == 0 else member.type.dtype for _, member in shown],
            "offsets": [member.offset for _, member in shown],
            "itemsize": layout.size,
        }
    )


def item_format(layout: Layout) -> str:
    """Return the format of `struct` for all that is no structure or array; a byte of BITs is one `B`."""
    parts, end = ["<"], 0
    for member in layout.members:
        if member.bit or not isinstance(member.type, Scalar):
            continue
        parts.append("x" * (member.offset - end) + ("B" if member.bit == 0 else member.type.code))
        end = member.offset + member.type.size
    return "".join(parts) + "x" * (layout.size - end)
