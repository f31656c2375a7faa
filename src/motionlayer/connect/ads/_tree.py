"""The tree of symbols as clients see it: pure data, which a server process takes along (ads 4, 5).

Names are found without regard to case. A path goes on from a root by members and indices: `GVL_AXIS.Ctrl[2].eCmd`,
`Table[1,2]`. The place of a BIT has a number of its own within its byte. A method stands behind a `#`:
`GVL_MOTION.Axis[1]#Halt`.
"""

import re
from collections.abc import Iterable, Iterator
from typing import Final, NamedTuple

from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._nodes import Attributes, Root, TypeNode


class Place(NamedTuple):
    """Where a path leads to.

    Attributes:
        name: the path, as it was declared.
        type: at its end.
        offset: bytes from the beginning of the published image.
        bit: number within the byte, for a BIT; else None.
        root: the symbol it begins with.
        comment: of the last member, or of the root.
        attributes: likewise.
    """

    name: str
    type: TypeNode
    offset: int
    bit: int | None
    root: Root
    comment: str
    attributes: Attributes


class MethodPlace(NamedTuple):
    """A method of an object.

    Attributes:
        place: of the object.
        number: of the method within its type.
        sent: bytes of all inputs.
        returned: bytes of what it returns and of all outputs.
    """

    place: Place
    number: int
    sent: int
    returned: int


METHOD: Final = "#"
"""Between an object and its method."""

_PIECE: Final = re.compile(r"\.(?P<member>[^.\[\]]+)|\[(?P<index>[^\[\]]*)\]")


class Tree:
    """All symbols and types of a server.

    Args:
        roots: in the order of an upload; names are unique without regard to case.
        types: every type that a root, a member or another type names.
        aliases: other names of roots, by name.
    """

    def __init__(self, roots: Iterable[Root], types: Iterable[TypeNode], aliases: dict[str, str] | None = None) -> None:
        self.roots = tuple(roots)
        self._types = {node.name.upper(): node for node in types}
        self._roots = {root.name.upper(): root for root in self.roots}
        self._roots |= {alias.upper(): self._roots[name.upper()] for alias, name in (aliases or {}).items()}
        self._members = {
            node.name: {member.name.upper(): member for member in node.members}
            for node in self._types.values()
            if node.members
        }

    @property
    def types(self) -> Iterator[TypeNode]:
        """All types, in order."""
        return iter(self._types.values())

    def type_named(self, name: str) -> TypeNode:
        """Return a type.

        Raises:
            AdsError: there is none (0x710).
        """
        node = self._types.get(name.upper())
        if node is None:
            raise AdsError(Code.SYMBOL_NOT_FOUND, f"no type {name}")
        return node

    def find(self, path: str) -> Place:
        """Return where a path leads to.

        Raises:
            AdsError: no such symbol or member (0x710), an index outside the bounds (0x721), or no path (0x70D).
        """
        root, rest = self._root(path)
        place = Place(root.name, self.type_named(root.type), root.offset, None, root, root.comment, root.attributes)
        at = 0
        while at < len(rest):
            piece = _PIECE.match(rest, at)
            if piece is None:
                raise AdsError(Code.SYNTAX, f"{path}: cannot be read from {rest[at:]!r} on")
            at = piece.end()
            member = piece["member"]
            place = self._member(place, member) if member is not None else self._element(place, piece["index"])
        return place

    def find_method(self, path: str) -> MethodPlace:
        """Return a method of an object, `object#method`.

        Raises:
            AdsError: as `find`, or the object has no such method (0x710).
        """
        of, _, name = path.partition(METHOD)
        place = self.find(of)
        for number, method in enumerate(place.type.methods):
            if method.name.upper() == name.upper():
                sent = sum(self.type_named(one.type).size for one in method.inputs)
                returned = sum(self.type_named(one).size for one in method.results)
                return MethodPlace(place, number, sent, returned)
        raise AdsError(Code.SYMBOL_NOT_FOUND, f"{place.name} has no method {name}")

    def _root(self, path: str) -> tuple[Root, str]:
        """Return the root with the longest name that the path begins with, and the rest of the path."""
        upper = path.upper()
        ends = [index for index, one in enumerate(path) if one in ".["]
        for end in [len(path), *reversed(ends)]:
            root = self._roots.get(upper[:end])
            if root is not None:
                return root, path[end:]
        raise AdsError(Code.SYMBOL_NOT_FOUND, f"no symbol {path}")

    def _member(self, place: Place, name: str) -> Place:
        member = self._members.get(place.type.name, {}).get(name.upper())
        if member is None or place.type.dimensions:
            raise AdsError(Code.SYMBOL_NOT_FOUND, f"{place.name} has no member {name}")
        return place._replace(
            name=f"{place.name}.{member.name}",
            type=self.type_named(member.type),
            offset=place.offset + member.offset,
            bit=member.bit,
            comment=member.comment,
            attributes=member.attributes,
        )

    def _element(self, place: Place, text: str) -> Place:
        dimensions = place.type.dimensions
        try:
            indices = [int(part) for part in text.split(",")]
        except ValueError:
            raise AdsError(Code.SYNTAX, f"{place.name}[{text}]: an index is a whole number") from None
        if len(indices) != len(dimensions):
            raise AdsError(Code.INVALID_ARRAY_INDEX, f"{place.name} has {len(dimensions)} dimensions")
        element = self.type_named(place.type.base)
        number = 0
        for index, (low, count) in zip(indices, dimensions, strict=True):
            if not low <= index < low + count:
                raise AdsError(Code.INVALID_ARRAY_INDEX, f"{place.name}[{text}]: {low} to {low + count - 1}")
            number = number * count + index - low
        name = f"{place.name}[{','.join(map(str, indices))}]"
        return place._replace(name=name, type=element, offset=place.offset + number * element.size)
