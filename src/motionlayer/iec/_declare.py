"""`StructMeta`: makes a class of slots from a declaration, and the class of its views."""

import re
from abc import ABCMeta
from typing import Any, Final

import numpy as np

from motionlayer.iec._codec import Codec
from motionlayer.iec._compound import CompoundType
from motionlayer.iec._elementary import Bit
from motionlayer.iec._field import Field
from motionlayer.iec._layout import PACK_MODES, Member, lay_out
from motionlayer.iec._struct_type import StructType
from motionlayer.iec._view import view_namespace, view_put
from motionlayer.iec._writer import Writer, writers_of

Fields = dict[str, Field[Any, Any]]

_IDENTIFIER: Final = re.compile(r"[A-Za-z_]\w*", re.ASCII)


class StructMeta(ABCMeta):
    """Replaces the fields of a class by slots, and derives its layout, codec and views from them."""

    _union: bool
    _members: dict[str, Member]
    _writers: dict[str, Writer]
    _codec: Codec
    _view_class: "StructMeta"
    type: StructType[Any]
    dtype: np.dtype[Any]

    def __new__(
        mcs, name: str, bases: tuple[Any, ...], namespace: dict[str, Any], *, iec: str = "", pack: int = 8
    ) -> "StructMeta":
        """Make the class; one without a declared name and without fields is a base for others.

        Raises:
            TypeError: it has no declared name or no fields, extends another structure, or a field's name is taken.
            ValueError: the pack mode is none of 1, 2, 4, 8, or a declared name is none.
        """
        fields: Fields = {key: value for key, value in namespace.items() if isinstance(value, Field)}
        if not fields and not iec:
            return super().__new__(mcs, name, bases, {"__slots__": (), **namespace})
        union: bool = getattr(bases[0], "_union", False)
        _check(name, iec, pack, bases[0], fields, union=union)
        layout = lay_out(fields, pack, union=union)
        members = {member.attribute: member for member in layout.members}
        methods = {key: value for key, value in namespace.items() if key not in fields}
        if union:
            parts = tuple(key for key, field in fields.items() if isinstance(field.type, CompoundType))
            cls = view = super().__new__(mcs, name, bases, {**view_namespace(layout, parts), **methods})
        else:
            slots = {key: field.comment for key, field in fields.items()}
            cls = super().__new__(mcs, name, bases, {"__slots__": slots, **methods})
            cls._codec = Codec(iec, layout, vars(cls))
            cls._writers = writers_of(name, layout.members, lambda one: vars(cls)[one.attribute].__set__)
            view = super().__new__(mcs, f"{name}View", (cls,), {**view_namespace(layout), "__module__": cls.__module__})
        view._writers = writers_of(name, layout.members, view_put)
        cls._members, cls._view_class = members, view
        cls.type = StructType(cls, iec, pack, layout, union=union)
        cls.dtype = cls.type.dtype
        return cls


def _check(cls: str, iec: str, pack: int, base: type, fields: Fields, *, union: bool) -> None:
    """Refuse what is no declaration of a structure."""
    if not iec or not fields:
        raise TypeError(f'class {cls}: a structure needs a declared name, as iec="ST_NAME", and at least one Field')
    if hasattr(base, "type"):
        raise TypeError(f"class {cls}: a structure is not extended; nest {base.__name__} as a Field")
    if pack not in PACK_MODES:
        raise ValueError(f"class {cls}: pack mode {pack!r} must be one of {', '.join(map(str, PACK_MODES))}")
    names = [iec, *(field.name for field in fields.values())]
    wrong = next((one for one in names if not _IDENTIFIER.fullmatch(one)), None)
    if wrong is not None:
        raise ValueError(f"class {cls}: {wrong!r} is no name in IEC 61131-3: letters, digits and underscores")
    lower = [field.name.lower() for field in fields.values()]
    twice = next((one for one in lower if lower.count(one) > 1), None)
    if twice is not None:
        raise ValueError(f"class {cls}: two fields are named {twice}; case makes no difference")
    for attribute, field in fields.items():
        if attribute.startswith("_") or hasattr(base, attribute) or attribute in {"type", "dtype"}:
            raise TypeError(f"{cls}.{attribute}: every structure has this attribute already; choose another name")
        if union and isinstance(field.type, Bit):
            raise TypeError(f"{cls}.{attribute}: a union has no BITs; nest a structure of BITs")
