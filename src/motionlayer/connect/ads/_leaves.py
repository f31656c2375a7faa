"""What a client learns about symbols: entries of symbols and types (ads 5), taken apart into elementary values."""

import struct
from collections.abc import Callable, Iterator
from typing import Final, NamedTuple

from motionlayer.connect.ads._entries import CODE_PAGE

_SYMBOL: Final = struct.Struct("<6I3H")
_TYPE: Final = struct.Struct("<8I5H")
_ENUM_INFOS: Final = 0x2000
_BIT_ITEM: Final = 0x20
_GUID, _COPY_MASK, _METHODS, _ATTRIBUTES = 0x80, 0x200, 0x800, 0x1000
_FORMATS: Final = {2: "<h", 3: "<i", 4: "<f", 5: "<d", 16: "<b", 17: "<B", 18: "<H", 19: "<I", 20: "<q", 21: "<Q"}
_BIT, _STRING, _WSTRING = 33, 30, 31

Value = int | float | bool | str


class Leaf(NamedTuple):
    """An elementary value of a symbol.

    Attributes:
        name: path of the value.
        start: its first byte in those of the symbol.
        size: bytes.
        kind: its type.
        bit: number of the bit in the byte `start`, of a member that is a bit.
    """

    name: str
    start: int
    size: int
    kind: "TypeEntry"
    bit: int | None = None

    def raw(self, data: bytes) -> bytes:
        """Return the bytes of the value among those of the symbol."""
        if self.bit is not None:
            return b"\1" if data[self.start] >> self.bit & 1 else b"\0"
        return data[self.start : self.start + self.size]

    def value(self, raw: bytes) -> Value:
        """Return the value in its bytes; those of an enumeration by name."""
        number = _decoded(self.kind.adst, raw)
        return self.kind.values.get(number, number) if isinstance(number, int) else number


class TypeEntry(NamedTuple):
    """A data type, or a member of one.

    Attributes:
        name: of the type or member.
        type: name of the type of a member; of an array, of its elements; of an enumeration, of its base.
        size: bytes.
        offset: from the beginning of the parent, in bytes; of a bit, in bits.
        adst: ADST id.
        bit: it is a member that is a bit.
        dimensions: lower bound and number of elements of each.
        members: of a structure.
        values: names of an enumeration by number.
    """

    name: str
    type: str
    size: int
    offset: int
    adst: int
    bit: bool
    dimensions: tuple[tuple[int, int], ...]
    members: tuple["TypeEntry", ...]
    values: dict[int, str]


class SymbolEntry(NamedTuple):
    """A symbol: name, type, index group and offset, and size in bytes."""

    name: str
    type: str
    group: int
    offset: int
    size: int


def symbol_of(raw: bytes) -> SymbolEntry:
    """Return a symbol entry."""
    _, group, offset, size, _, _, name, kind, _ = _SYMBOL.unpack_from(raw)
    at = _SYMBOL.size
    return SymbolEntry(_text(raw, at, name), _text(raw, at + name + 1, kind), group, offset, size)


def symbols_of(raw: bytes) -> Iterator[SymbolEntry]:
    """Yield the symbol entries of an upload."""
    at = 0
    while at < len(raw):
        (length,) = struct.unpack_from("<I", raw, at)
        yield symbol_of(raw[at : at + length])
        at += length


def type_of(raw: bytes) -> TypeEntry:
    """Return a type entry with those of its members."""
    _, _, _, _, size, offset, adst, flags, *lengths, dimensions, items = _TYPE.unpack_from(raw)
    at = _TYPE.size
    name, kind = _text(raw, at, lengths[0]), _text(raw, at + lengths[0] + 1, lengths[1])
    at += sum(lengths) + 3
    bounds = tuple(struct.iter_unpack("<iI", raw[at : at + 8 * dimensions]))
    at += 8 * dimensions
    members = []
    for _ in range(items):
        (length,) = struct.unpack_from("<I", raw, at)
        members.append(type_of(raw[at : at + length]))
        at += length
    values = _values(raw, at, flags, size)
    return TypeEntry(name, kind, size, offset, adst, bool(flags & _BIT_ITEM), bounds, tuple(members), values)


def _values(raw: bytes, at: int, flags: int, size: int) -> dict[int, str]:
    """Return the names of an enumeration, which stand behind parts that it has none of here."""
    if not flags & _ENUM_INFOS or flags & (_COPY_MASK | _METHODS | _ATTRIBUTES):
        return {}
    at += 16 if flags & _GUID else 0
    (count,) = struct.unpack_from("<H", raw, at)
    at += 2
    values = {}
    for _ in range(count):
        length = raw[at]
        name = _text(raw, at + 1, length)
        at += length + 2
        values[int.from_bytes(raw[at : at + size], "little", signed=True)] = name
        at += size
    return values


def leaves(symbol: SymbolEntry, type_named: Callable[[str], TypeEntry]) -> Iterator[Leaf]:
    """Yield the elementary values of a symbol.

    Args:
        symbol: any symbol.
        type_named: returns a type.
    """
    return _inside(symbol.name, 0, type_named(symbol.type), type_named)


def _inside(name: str, start: int, kind: TypeEntry, type_named: Callable[[str], TypeEntry]) -> Iterator[Leaf]:
    if kind.dimensions:
        of = type_named(kind.type)
        for number, index in enumerate(_indices(kind.dimensions)):
            yield from _inside(f"{name}[{index}]", start + number * of.size, of, type_named)
    elif kind.members:
        for member in kind.members:
            path, of = f"{name}.{member.name}", type_named(member.type)
            if member.bit:
                yield Leaf(path, start + member.offset // 8, 1, of, member.offset % 8)
            else:
                yield from _inside(path, start + member.offset, of, type_named)
    else:
        yield Leaf(name, start, kind.size, kind)


def _indices(dimensions: tuple[tuple[int, int], ...]) -> Iterator[str]:
    """Yield the indices of an array as text, the last one fastest."""
    low, count = dimensions[0]
    for index in range(low, low + count):
        if len(dimensions) == 1:
            yield str(index)
        else:
            yield from (f"{index},{rest}" for rest in _indices(dimensions[1:]))


def _decoded(adst: int, data: bytes) -> Value:
    if adst == _BIT:
        return data != b"\0"
    if adst == _STRING:
        return data.split(b"\0", 1)[0].decode(CODE_PAGE, errors="replace")
    if adst == _WSTRING:
        return data.decode("utf-16-le", errors="replace").split("\0", 1)[0]
    shape = _FORMATS.get(adst)
    if shape is None or struct.calcsize(shape) != len(data):
        return data.hex(" ")
    value: Value = struct.unpack(shape, data)[0]
    return value


def _text(raw: bytes, at: int, length: int) -> str:
    return raw[at : at + length].decode(CODE_PAGE, errors="replace")
