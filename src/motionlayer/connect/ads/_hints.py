"""`hint`: what a name that there is not may have meant, out of the entries of symbols and types."""

import difflib
import re
from collections.abc import Callable, Iterable
from typing import Final

from motionlayer.connect.ads._leaves import SymbolEntry, TypeEntry

STEP: Final = re.compile(r"\[(?P<index>[^\]]*)\]|\.?(?P<member>[^.\[]+)")
"""One step of a path, into an array or a structure."""

SHOWN: Final = 6
"""Members that are named, at most, where none is similar."""

ALIKE: Final = 0.85
"""Share of a name that must be the same; namespaces alone make names rather alike."""

Types = Callable[[str], TypeEntry]


def hint(name: str, symbols: Iterable[SymbolEntry], type_named: Types) -> str:
    """Return a hint for who has asked for a symbol that there is not; "" without an idea.

    Args:
        name: as asked for.
        symbols: all that there are, without their members.
        type_named: returns a type.
    """
    known = {one.name.upper(): one for one in symbols}
    asked = name.upper()
    root = max((one for one in known if asked.startswith((f"{one}.", f"{one}["))), key=len, default=None)
    if root is None:
        return _similar(asked, {upper: one.name for upper, one in known.items()})
    found = known[root]
    return _inside(found.name, name[len(root) :], type_named(found.type), type_named)


def _similar(asked: str, names: dict[str, str]) -> str:
    """Return names that look like the beginning of one; without any, those of its namespace."""
    namespace = asked.partition(".")[0]
    head = ".".join(asked.split(".")[:2]).partition("[")[0]
    found = [names[one] for one in difflib.get_close_matches(head, names, 3, ALIKE)]
    found = found or [name for upper, name in names.items() if upper.startswith(f"{namespace}.")][:SHOWN]
    return f"did you mean {' or '.join(found)}?" if found else ""


def _inside(path: str, rest: str, kind: TypeEntry, type_named: Types) -> str:
    """Follow a path as far as it goes; return what there is where it ends."""
    for step in STEP.finditer(rest):
        index, member = step["index"], step["member"]
        if index is not None:
            if not kind.dimensions or not _within(index, kind.dimensions):
                return f"{path} has the indices {_bounds(kind)}" if kind.dimensions else f"{path} is no array"
            path, kind = f"{path}[{index}]", type_named(kind.type)
        elif kind.dimensions:
            return f"{path} is an array with the indices {_bounds(kind)}"
        else:
            names = {one.name.upper(): one for one in kind.members}
            found = names.get(member.upper())
            if found is None:
                return _members(path, member, [one.name for one in kind.members])
            path, kind = f"{path}.{found.name}", type_named(found.type)
    return ""


def _members(path: str, asked: str, names: list[str]) -> str:
    if not names:
        return f"{path} is no structure"
    by_upper = {name.upper(): name for name in names}
    similar = [by_upper[one] for one in difflib.get_close_matches(asked.upper(), by_upper, 3)]
    if similar:
        return f"did you mean {' or '.join(f'{path}.{name}' for name in similar)}?"
    return f"{path} has {', '.join(names[:SHOWN])}{' …' if len(names) > SHOWN else ''}"


def _within(index: str, dimensions: tuple[tuple[int, int], ...]) -> bool:
    """Tell whether an index is one of an array."""
    try:
        places = [int(one) for one in index.split(",")]
    except ValueError:
        return False
    if len(places) != len(dimensions):
        return False
    return all(low <= place < low + count for place, (low, count) in zip(places, dimensions, strict=True))


def _bounds(kind: TypeEntry) -> str:
    return ", ".join(f"{low} to {low + count - 1}" for low, count in kind.dimensions)
