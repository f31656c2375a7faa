"""`Bounds`: lower and upper bounds of an array, and what its indices mean."""

import operator
from collections.abc import Iterator, Sequence
from itertools import product
from math import prod
from typing import ClassVar, Final, TypeAlias

Index: TypeAlias = int | tuple[int, ...]


class Bounds:
    """Bounds of all dimensions, the last of which runs fastest.

    Args:
        pairs: lower and upper bound of each dimension, both inclusive.

    Attributes:
        pairs: as given.
        shape: elements of each dimension.
        count: elements of all.

    Raises:
        ValueError: there are none, or one is not a pair of whole numbers in order.
    """

    __slots__ = ("count", "pairs", "shape")

    UNCHANGING: ClassVar = True

    def __init__(self, pairs: Sequence[tuple[int, int]]) -> None:
        for pair in pairs:
            if [type(one) for one in pair] != [int, int] or pair[0] > pair[1]:
                raise ValueError(f"bounds of an array {pair!r}: must be two whole numbers, lower and upper, as (1, 6)")
        if not pairs:
            raise ValueError("an array needs bounds, lower and upper, as (1, 6)")
        self.pairs: Final = tuple((low, high) for low, high in pairs)
        self.shape: Final = tuple(high - low + 1 for low, high in pairs)
        self.count: Final = prod(self.shape)

    def __str__(self) -> str:
        return ", ".join(f"{low}..{high}" for low, high in self.pairs)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Bounds) and self.pairs == other.pairs

    def __hash__(self) -> int:
        return hash(self.pairs)

    def place(self, index: object) -> int:
        """Return the place of an element, from 0, by its index: a number, or one for each dimension.

        Raises:
            TypeError: the index is no whole number, or not one for each dimension.
            IndexError: it is out of the bounds.
        """
        given = index if isinstance(index, tuple) else (index,)
        if len(given) != len(self.pairs):
            raise TypeError(f"index {index!r}: this array takes {len(self.pairs)}, one for each of [{self}]")
        place = 0
        for one, (low, high) in zip(given, self.pairs, strict=True):
            if isinstance(one, bool) or not hasattr(one, "__index__"):
                raise TypeError(f"index {index!r} must be a whole number within [{self}]")
            number = operator.index(one)
            if not low <= number <= high:
                raise IndexError(f"index {number} is out of [{self}]")
            place = place * (high - low + 1) + number - low
        return place

    def text(self, place: int) -> str:
        """Return the index of a place, as it is written: `2` or `1, 3`."""
        numbers: list[str] = []
        for low, high in reversed(self.pairs):
            place, rest = divmod(place, high - low + 1)
            numbers.append(str(low + rest))
        return ", ".join(reversed(numbers))

    def indices(self) -> Iterator[Index]:
        """Yield the index of each element in the order of memory."""
        for index in product(*(range(low, high + 1) for low, high in self.pairs)):
            yield index if len(index) > 1 else index[0]
