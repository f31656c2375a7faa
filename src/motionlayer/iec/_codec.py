"""`Codec`: an object with slots to its bytes and back.

All scalars of a structure are items of one `struct` format; nested structures and arrays write themselves into the
gaps.
"""

import struct
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from operator import attrgetter
from typing import Any, Final, NamedTuple

from motionlayer.iec._compound import CompoundType, check_room
from motionlayer.iec._layout import Layout, Member, item_format
from motionlayer.iec._type import Bytes, Memory, Scalar

Get = Callable[[Any], Any]
Set = Callable[[Any, Any], object]


class Codec:
    """Packs and unpacks the objects of one class.

    Args:
        name: of the structure, for messages.
        layout: its members.
        slots: the slot descriptor of each member by its attribute.
    """

    def __init__(self, name: str, layout: Layout, slots: Mapping[str, Any]) -> None:
        self._name: Final = name
        self._size: Final = layout.size
        self._struct: Final = struct.Struct(item_format(layout))
        items = list(_items(layout, slots))
        self._collect: Final = _collector(items)
        self._setters: Final = tuple(_setter(item) for item in items)
        self._columns: Final = tuple((item.put, item.decode_each) for item in items)
        self._parts: Final = tuple(
            (attrgetter(member.attribute), member.offset)
            for member in layout.members
            if isinstance(member.type, CompoundType)
        )

    def pack_into(self, value: object, memory: Memory, offset: int) -> None:
        """Write the bytes of an object, padding as zeros."""
        if offset < 0 or offset + self._size > len(memory):
            check_room(self._name, self._size, memory, offset)
        self._struct.pack_into(memory, offset, *self._collect(value))
        for part, at in self._parts:
            part(value).pack_into(memory, offset + at)

    def unpack_from(self, value: object, memory: Bytes, offset: int) -> None:
        """Let an object hold what the bytes say."""
        if offset < 0 or offset + self._size > len(memory):
            check_room(self._name, self._size, memory, offset)
        for put, raw in zip(self._setters, self._struct.unpack_from(memory, offset)):  # noqa: B905 - as many
            put(value, raw)
        for part, at in self._parts:
            part(value).unpack_from(memory, offset + at)

    def unpack_each(self, values: Sequence[object], rows: bytes) -> None:
        """Let objects hold what as many rows of bytes say: one member of all objects after the other.

        Args:
            values: the objects.
            rows: their bytes, one behind the other.
        """
        items = zip(*self._struct.iter_unpack(rows))  # noqa: B905 - all of one length
        for (put, decode), column in zip(self._columns, items):  # noqa: B905 - as many
            any(map(put, values, column if decode is None else decode(column)))  # puts return None: a loop in C
        for part, at in self._parts:
            for row, value in enumerate(values):
                part(value).unpack_from(rows, row * self._size + at)


class _Item(NamedTuple):
    """An item of the format: how it is read from an object, decoded and set; the attribute where it is just read."""

    attribute: str | None
    get: Get
    decode: Callable[[Any], Any] | None
    decode_each: Callable[[Sequence[Any]], Iterable[Any]] | None
    put: Set


def _items(layout: Layout, slots: Mapping[str, Any]) -> Iterator[_Item]:
    for member in layout.members:
        if member.bit == 0:
            together = [one for one in layout.members if one.bit is not None and one.offset == member.offset]
            yield _bit_item(together, slots)
        elif member.bit is None and isinstance(member.type, Scalar):
            yield _scalar_item(member.attribute, member.type, slots[member.attribute].__set__)


def _scalar_item(attribute: str, kind: Scalar[Any], put: Set) -> _Item:
    encode, decode, read = kind.encoder, kind.decoder, attrgetter(attribute)
    each = None if decode is None else kind.decode_each
    if encode is None:
        return _Item(attribute, read, decode, each, put)
    return _Item(None, lambda value: encode(read(value)), decode, each, put)


def _setter(item: _Item) -> Set:
    """Return what sets an item in an object as it comes from the bytes."""
    put, decode = item.put, item.decode
    return put if decode is None else lambda value, raw: put(value, decode(raw))


def _bit_item(bits: list[Member], slots: Mapping[str, Any]) -> _Item:
    reads = tuple((attrgetter(member.attribute), 1 << (member.bit or 0)) for member in bits)
    puts = tuple((slots[member.attribute].__set__, 1 << (member.bit or 0)) for member in bits)

    def get(value: object) -> int:
        return sum([mask for read, mask in reads if read(value)])

    def spread(value: object, raw: int) -> None:
        for put, mask in puts:
            put(value, raw & mask != 0)

    return _Item(None, get, None, None, spread)


def _collector(items: list[_Item]) -> Get:
    """Return what gathers all items of an object; one call in C where every item is an attribute."""
    attributes = [item.attribute for item in items if item.attribute is not None]
    if len(attributes) == len(items) > 1:
        return attrgetter(*attributes)
    getters = tuple(item.get for item in items)
    return lambda value: [get(value) for get in getters]
