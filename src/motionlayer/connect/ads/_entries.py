"""Entries of symbols, types and methods, as clients upload them (ads 5.1, 5.2, 7)."""

import struct
from typing import Final

from motionlayer.connect.ads._nodes import Attributes, MethodNode, ParameterNode, TypeNode
from motionlayer.connect.ads._numbers import DATA_AREA, DATA_BITS
from motionlayer.connect.ads._tree import Place

CODE_PAGE: Final = "cp1252"

_SYMBOL: Final = struct.Struct("<6I3H")
_TYPE: Final = struct.Struct("<8I5H")
_DIMENSION: Final = struct.Struct("<iI")
_COUNT: Final = struct.Struct("<H")
_METHOD: Final = struct.Struct("<6I16x2I4H")
_PARAMETER: Final = struct.Struct("<6I16x4H")

_BIT_VALUE, _READ_ONLY, _ATTRIBUTES = 0x0002, 0x0020, 0x1000
_BIT: Final = "BIT"
_DATA_TYPE, _DATA_ITEM, _BIT_ITEM, _METHODS, _TYPE_ATTRIBUTES, _ENUM_INFOS = 0x1, 0x2, 0x20, 0x800, 0x1000, 0x2000
_INPUT, _OUTPUT = 1, 2

ALIGNMENT: Final = 8
"""Of what a method takes and gives, in bytes, at most; clients send it without gaps."""

LONGEST: Final = 797
"""Bytes of one symbol entry at most: pyads reads it into a buffer of this size and one."""


def encoded(text: str) -> bytes:
    """Return a text in the code page of the interface."""
    return text.encode(CODE_PAGE, errors="replace")


def texts(*parts: bytes) -> bytes:
    """Return texts one after the other, each with its zero."""
    return b"".join(part + b"\0" for part in parts)


def _attributes(attributes: Attributes) -> bytes:
    if not attributes:
        return b""
    raw = _COUNT.pack(len(attributes))
    for name, value in attributes:
        one, two = encoded(name)[:255], encoded(value)[:255]
        raw += bytes((len(one), len(two))) + texts(one, two)
    return raw


def address(place: Place) -> tuple[int, int]:
    """Return index group and offset of a place."""
    if place.bit is None:
        return DATA_AREA, place.offset
    return DATA_BITS, place.offset * 8 + place.bit


def symbol_entry(place: Place) -> bytes:
    """Return the entry of a symbol; a comment is cut where the entry would be too long for some client."""
    node = place.type
    flags = 0 if place.root.writable else _READ_ONLY
    flags |= _BIT_VALUE if place.bit is not None else 0
    flags |= _ATTRIBUTES if place.attributes else 0
    tail = b"".join(_DIMENSION.pack(*one) for one in node.dimensions) + _attributes(place.attributes)
    name, kind = encoded(place.name), encoded(node.name)
    room = LONGEST - _SYMBOL.size - len(name) - len(kind) - 3 - len(tail)
    comment = encoded(place.comment)[: max(room, 0)]
    length = _SYMBOL.size + len(name) + len(kind) + len(comment) + 3 + len(tail)
    both = flags | len(node.dimensions) << 16
    head = _SYMBOL.pack(length, *address(place), node.size, node.adst, both, len(name), len(kind), len(comment))
    return head + texts(name, kind, comment) + tail


def type_entry(node: TypeNode, types: dict[str, TypeNode]) -> bytes:
    """Return the entry of a type with those of its members and methods.

    Args:
        node: the type.
        types: all types by name; those of members and parameters are looked up there.
    """
    items = b"".join(_member_entries(node, types))
    tail, flags = b"", _DATA_TYPE
    if node.methods:
        flags |= _METHODS
        entries = [_method_entry(number, method, types) for number, method in enumerate(node.methods)]
        tail += _COUNT.pack(len(entries)) + b"".join(entries)
    if node.values:
        flags |= _ENUM_INFOS
        tail += _enum_infos(node)
    if node.name == _BIT:  # ads-client looks at the entry of the type, not at that of the member
        flags |= _BIT_ITEM
    return _entry(node, (node.name, node.base, node.comment), node.size, 0, flags, items, tail)


def _enum_infos(node: TypeNode) -> bytes:
    infos = _COUNT.pack(len(node.values))
    for name, value in node.values:
        raw = encoded(name)
        infos += bytes((len(raw),)) + texts(raw) + value.to_bytes(node.size, "little", signed=value < 0)
    return infos


def _member_entries(node: TypeNode, types: dict[str, TypeNode]) -> list[bytes]:
    entries = []
    for member in node.members:
        of = types[member.type]
        flags = _DATA_ITEM | (_TYPE_ATTRIBUTES if member.attributes else 0)
        size, offset = of.size, member.offset
        if member.bit is not None:
            size, offset, flags = 1, member.offset * 8 + member.bit, flags | _BIT_ITEM
        names = member.name, of.name, member.comment
        item = of._replace(members=())  # the members of a member stand in the entry of its type
        entries.append(_entry(item, names, size, offset, flags, b"", _attributes(member.attributes)))
    return entries


def _entry(
    node: TypeNode, names: tuple[str, str, str], size: int, offset: int, flags: int, items: bytes, tail: bytes
) -> bytes:
    """Return the entry of a type or of a member.

    Args:
        node: the type; of a member its own.
        names: name, type and comment.
        size: in bytes, of a BIT in bits.
        offset: likewise.
        flags: what it is, and what the tail holds.
        items: entries of its members.
        tail: what comes behind them.
    """
    raw = [encoded(text) for text in names]
    body = texts(*raw) + b"".join(_DIMENSION.pack(*one) for one in node.dimensions) + items + tail
    lengths = [len(text) for text in raw]
    counts = len(node.dimensions), len(node.members)
    return _TYPE.pack(_TYPE.size + len(body), 1, 0, 0, size, offset, node.adst, flags, *lengths, *counts) + body


def _method_entry(number: int, method: MethodNode, types: dict[str, TypeNode]) -> bytes:
    given = types[method.returns] if method.returns else TypeNode("", 0, 0)
    raw = [encoded(text) for text in (method.name, method.returns, method.comment)]
    parameters = [_parameter_entry(one, _INPUT, types) for one in method.inputs]
    parameters += [_parameter_entry(one, _OUTPUT, types) for one in method.outputs]
    body = texts(*raw) + b"".join(parameters)
    sizes = given.size, min(given.size, ALIGNMENT)
    lengths = [len(text) for text in raw]
    head = _METHOD.pack(_METHOD.size + len(body), 1, number, *sizes, 0, given.adst, 0, *lengths, len(parameters))
    return head + body


def _parameter_entry(parameter: ParameterNode, flags: int, types: dict[str, TypeNode]) -> bytes:
    of = types[parameter.type]
    raw = [encoded(text) for text in (parameter.name, parameter.type, parameter.comment)]
    body = texts(*raw)
    sizes = of.size, min(of.size, ALIGNMENT)
    lengths = [len(text) for text in raw]
    return _PARAMETER.pack(_PARAMETER.size + len(body), *sizes, of.adst, flags, 0, 0, *lengths) + body
