"""What an object of a class written in Python holds: its dictionary, and its slots.

Slots are read and written through their descriptors, so that a class that guards its attributes (a frozen dataclass, a
view with fields of its own) is none the wiser.
"""

import types
from typing import Any, Final

_UNSET: Final = object()
_HEAPTYPE: Final = 1 << 9  # Py_TPFLAGS_HEAPTYPE

Slots = tuple[tuple[types.MemberDescriptorType, Any], ...]

_SLOTS: Final[dict[type, tuple[types.MemberDescriptorType, ...]]] = {}
"""Found once per class."""


def is_plain(kind: type) -> bool:
    """Tell whether all that an object of this class holds can be seen: no class of it keeps something in C."""
    return all(_in_python(base) for base in kind.__mro__[:-1])


def _in_python(kind: type) -> bool:
    own, new = vars(kind), vars(kind).get("__new__")
    if not kind.__flags__ & _HEAPTYPE or isinstance(new, types.BuiltinFunctionType):
        return False
    # A class that adds nothing in C is as large as its base, but for what Python itself adds.
    return "__slots__" in own or "__dict__" in own or kind.__basicsize__ == (kind.__base__ or object).__basicsize__


def slots_of(kind: type) -> tuple[types.MemberDescriptorType, ...]:
    """Return the slots of a class and its bases."""
    known = _SLOTS.get(kind)
    if known is not None:
        return known
    slotted = [vars(base) for base in kind.__mro__ if "__slots__" in vars(base)]
    members = [member for names in slotted for member in names.values()]
    found = tuple(member for member in members if isinstance(member, types.MemberDescriptorType))
    return _SLOTS.setdefault(kind, found)


def attributes_of(thing: object) -> tuple[dict[str, Any], Slots]:
    """Return what an object holds; the dictionary is a copy."""
    kind = type(thing)
    values = dict(object.__getattribute__(thing, "__dict__")) if kind.__dictoffset__ else {}
    members = slots_of(kind)
    try:  # most objects have set all of them, and snapshots look at tens of thousands
        return values, tuple([(slot, slot.__get__(thing)) for slot in members])
    except AttributeError:
        return values, tuple([(slot, _read(slot, thing)) for slot in members])


def put_attributes(thing: object, held: tuple[dict[str, Any], Slots]) -> None:
    """Give an object back what it held."""
    values, slots = held
    if type(thing).__dictoffset__:
        present: dict[str, Any] = object.__getattribute__(thing, "__dict__")
        if list(present) != list(values):  # their order can be seen too
            present.clear()
        present.update(values)
    for slot, value in slots:
        if value is not _UNSET:
            slot.__set__(thing, value)
        elif _read(slot, thing) is not _UNSET:
            slot.__delete__(thing)


def _read(slot: types.MemberDescriptorType, thing: object) -> Any:  # noqa: ANN401 - whatever is there
    try:
        return slot.__get__(thing)
    except AttributeError:
        return _UNSET
