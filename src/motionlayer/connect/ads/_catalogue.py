"""`Catalogue`: all symbols and types, as clients upload them (ads 5)."""

import struct
from typing import Final

from motionlayer.connect.ads._entries import symbol_entry, type_entry
from motionlayer.connect.ads._tree import Tree

_CODE_PAGE: Final = 1252
_BASE_TYPES_AND_64_BIT: Final = 0x1 | 0x2


class Catalogue:
    """Entries of all symbols and types; they never change during a run.

    Args:
        tree: symbols and types.

    Attributes:
        symbols: entries of all symbols, one after the other.
        types: entries of all types.
    """

    def __init__(self, tree: Tree) -> None:
        types = {node.name: node for node in tree.types}
        self._tree = tree
        self._types = {name: type_entry(node, types) for name, node in types.items()}
        self._roots = len(tree.roots)
        self.types = b"".join(self._types.values())
        self.symbols = b"".join(symbol_entry(tree.find(root.name)) for root in tree.roots)

    def info(self, fields: int) -> bytes:
        """Return how much there is to upload, in so many fields."""
        counts = [self._roots, len(self.symbols), len(self._types), len(self.types)]
        rest = [0, 0, 0, _CODE_PAGE, _BASE_TYPES_AND_64_BIT, 0, 0, 0, 0, 0, 0, 0]
        return struct.pack(f"<{fields}I", *[*counts, *rest][:fields])

    def type_named(self, name: str) -> bytes:
        """Return the entry of a type.

        Raises:
            AdsError: there is none (0x710).
        """
        return self._types[self._tree.type_named(name).name]
