"""From the symbol table of a run to the tree of a server, and to the places of the symbols in the image."""

from collections.abc import Iterable, Sequence
from typing import Any, Final

from motionlayer.connect.ads._nodes import Member, MethodNode, ParameterNode, Root, TypeNode
from motionlayer.connect.ads._tree import Tree
from motionlayer.iec import Array, Enumeration, IecType, Method, Parameter, StructType, Symbol

ALIGNMENT: Final = 8
"""Bytes at whose multiples symbols begin in the image."""

BIG_TYPE: Final = 65
_ADST: Final = {
    "BIT": 33, "BOOL": 33, "SINT": 16, "USINT": 17, "BYTE": 17, "INT": 2, "UINT": 18, "WORD": 18, "DINT": 3,
    "UDINT": 19, "DWORD": 19, "TIME": 19, "TOD": 19, "DATE": 19, "DT": 19, "LINT": 20, "ULINT": 21, "LWORD": 21,
    "LTIME": 21, "LDT": 21, "LDATE": 21, "LTOD": 21, "REAL": 4, "LREAL": 5, "STRING": 30, "WSTRING": 31,
}  # fmt: skip


class Placed:
    """A symbol and its place in the image.

    Attributes:
        symbol: the symbol.
        start: first byte in the image.
        stop: behind the last.
        hidden: its bytes are published, but clients find it by index group only.
    """

    __slots__ = ("hidden", "start", "stop", "symbol")

    def __init__(self, symbol: Symbol, start: int, *, hidden: bool = False) -> None:
        self.symbol = symbol
        self.start = start
        self.stop = start + symbol.type.size
        self.hidden = hidden


def placed(shown: Iterable[Symbol], hidden: Iterable[Symbol] = ()) -> list[Placed]:
    """Return all symbols with their places, in order.

    Args:
        shown: what clients see.
        hidden: what is published behind that, for clients that ask by index group.
    """
    places: list[Placed] = []
    at = 0
    for symbols, is_hidden in ((shown, False), (hidden, True)):
        for symbol in symbols:
            places.append(Placed(symbol, at, hidden=is_hidden))
            at += -(-symbol.type.size // ALIGNMENT) * ALIGNMENT
    return places


def tree_of(places: Sequence[Placed]) -> Tree:
    """Return the tree of placed symbols.

    Raises:
        ValueError: two variables of one structure have different methods.
    """
    types: dict[str, TypeNode] = {}
    roots = []
    shown = [one for one in places if not one.hidden]
    for one in shown:
        symbol = one.symbol
        node = _note(symbol.type, types)
        if symbol.methods:
            _note_methods(symbol, types)
        attributes = tuple(symbol.attributes.items())
        roots.append(Root(symbol.name, node.name, one.start, symbol.source.writable, symbol.comment, attributes))
    aliases = {alias: one.symbol.name for one in shown for alias in one.symbol.aliases}
    return Tree(roots, types.values(), aliases)


def _name(kind: IecType[Any, Any]) -> str:
    """Return the name of a type as clients know it: bounds stand without blanks between them."""
    if not isinstance(kind, Array):
        return kind.name
    bounds = ",".join(f"{low}..{high}" for low, high in kind.bounds.pairs)
    return f"ARRAY [{bounds}] OF {_name(kind.of)}"


def _adst(kind: IecType[Any, Any]) -> int:
    return _ADST.get(kind.name.partition("(")[0], BIG_TYPE)


def _note(kind: IecType[Any, Any], types: dict[str, TypeNode]) -> TypeNode:
    """Note a type behind those that it is made of, and return it."""
    name = _name(kind)
    known = types.get(name)
    if known is None:
        known = types[name] = _node(kind, name, types)
    return known


def _node(kind: IecType[Any, Any], name: str, types: dict[str, TypeNode]) -> TypeNode:
    if isinstance(kind, Array):
        of = _note(kind.of, types)
        dimensions = tuple((low, high - low + 1) for low, high in kind.bounds.pairs)
        return TypeNode(name, kind.size, of.adst, of.name, dimensions)
    if isinstance(kind, Enumeration):
        base = _note(kind.base, types)
        values = tuple((item, int(value)) for item, value in kind.items)
        return TypeNode(name, kind.size, base.adst, base.name, values=values, comment=kind.comment)
    if isinstance(kind, StructType):
        members = tuple(
            Member(field.name, _note(field.type, types).name, field.offset, field.bit, field.comment)
            for field in kind.fields
        )
        return TypeNode(name, kind.size, BIG_TYPE, members=members, comment=kind.comment)
    return TypeNode(name, kind.size, _adst(kind))


def _note_methods(symbol: Symbol, types: dict[str, TypeNode]) -> None:
    """Give the structure of a variable its methods."""
    kind = symbol.type.of if isinstance(symbol.type, Array) else symbol.type
    node, methods = types[kind.name], tuple(_method(one, types) for one in symbol.methods)
    if node.methods not in ((), methods):
        raise ValueError(f"symbol {symbol.name}: another variable of type {kind.name} has other methods")
    types[kind.name] = node._replace(methods=methods)


def _method(method: Method, types: dict[str, TypeNode]) -> MethodNode:
    def parameter(one: Parameter) -> ParameterNode:
        return ParameterNode(one.name, _note(one.type, types).name, one.comment)

    inputs, outputs = (tuple(map(parameter, group)) for group in (method.inputs, method.outputs))
    returns = "" if method.returns is None else _note(method.returns, types).name
    return MethodNode(method.name, inputs, outputs, returns, method.comment)
