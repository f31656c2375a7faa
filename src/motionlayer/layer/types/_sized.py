"""Structures whose arrays are as long as the machine file says."""

import functools
import types
from typing import Any, TypeVar, cast

from motionlayer.iec import Array, Field, Struct

S = TypeVar("S", bound=Struct)


@functools.cache
def resized(base: type[S], attribute: str, high: int) -> type[S]:
    """Return the class of the same structure with another upper bound of one of its arrays; each time the same class.

    Args:
        base: a structure.
        attribute: the array, by its name in Python.
        high: last index.
    """
    kinds: dict[str, Any] = {one.attribute: one.type for one in base.type.fields}
    array = kinds[attribute]
    (low, last), *further = array.bounds.pairs
    if last == high:
        return base
    kinds[attribute] = Array(array.of, (low, high), *further)
    fields = {
        one.attribute: Field(one.name, kinds[one.attribute], one.comment, default=one.default)
        for one in base.type.fields
    }
    body = {"__module__": base.__module__, "__qualname__": base.__qualname__, "__doc__": base.__doc__, **fields}
    declaration = {"iec": base.type.name, "pack": base.type.pack}
    return cast("type[S]", types.new_class(base.__name__, (Struct,), declaration, lambda space: space.update(body)))
