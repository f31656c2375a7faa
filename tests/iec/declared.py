"""Structures of the tests: some as the interface has them, and random ones beside the same in ctypes."""

import ctypes
import enum
import itertools
import types
from typing import Any, NamedTuple

from hypothesis import strategies as st

from motionlayer.iec import (
    BIT,
    BOOL,
    BYTE,
    DINT,
    DWORD,
    INT,
    LINT,
    LREAL,
    LTIME,
    LWORD,
    REAL,
    SINT,
    STRING,
    TIME,
    UDINT,
    UINT,
    ULINT,
    USINT,
    WORD,
    Array,
    Enumeration,
    Field,
    IecType,
    Struct,
    Union,
)


class AxisCommand(enum.IntEnum):
    NULL = 0
    MOVE_POS = 12
    MOVE_BUFFER_VELO = 31
    CAM_IN = 61


E_AXIS_CTRL = Enumeration("E_AXIS_CTRL", UINT, AxisCommand, prefix="AXIS_", keep=("CAM_", "FLY_"))


class AxisCtrl(Struct, iec="ST_AXIS_CTRL", pack=2):
    """Command of an axis."""

    cmd = Field("eCmd", E_AXIS_CTRL, "command")
    progress = Field("eProgress", UINT, "10000 ends the endless jobs")


class MoveData(Struct, iec="ST_MOVE_DATA", pack=2):
    """Data of a move."""

    position = Field("rSetPos", LREAL, "target position (u)")
    velocity = Field("rSetVelo", LREAL, "velocity (u/s)")
    override = Field("rOverride", LREAL, "percent", default=100.0)
    acceleration = Field("rAcc", LREAL)
    deceleration = Field("rDec", LREAL)
    jerk = Field("rJerk", LREAL)


class Everything(Struct, iec="ST_EVERYTHING", pack=2):
    """A member of every sort."""

    first = Field("bFirst", BIT, "bit 0")
    second = Field("bSecond", BIT, "bit 1", default=True)
    flag = Field("bFlag", BOOL)
    number = Field("nNumber", UDINT)
    single = Field("fSingle", REAL, default=47.11)
    name = Field("sName", STRING(7))
    ctrl = Field("stCtrl", AxisCtrl)
    ratios = Field("rRatios", Array(REAL, (1, 4)), default=[1.0, 2.0, 3.0, 4.0])
    table = Field("stTable", Array(AxisCtrl, (1, 2), (0, 1)))
    commands = Field("eCommands", Array(E_AXIS_CTRL, (-1, 1)))


class Overlay(Union, iec="U_OVERLAY"):
    """The same four bytes three times."""

    number = Field("nNumber", UDINT, default=0x000A_000C)
    ctrl = Field("stCtrl", AxisCtrl)
    bytes = Field("byBytes", Array(BYTE, (0, 3)))


C_TYPES: dict[IecType[Any, Any], Any] = {
    BOOL: ctypes.c_bool, BYTE: ctypes.c_uint8, WORD: ctypes.c_uint16, DWORD: ctypes.c_uint32, LWORD: ctypes.c_uint64,
    SINT: ctypes.c_int8, USINT: ctypes.c_uint8, INT: ctypes.c_int16, UINT: ctypes.c_uint16, DINT: ctypes.c_int32,
    UDINT: ctypes.c_uint32, LINT: ctypes.c_int64, ULINT: ctypes.c_uint64, REAL: ctypes.c_float, LREAL: ctypes.c_double,
    TIME: ctypes.c_uint32, LTIME: ctypes.c_uint64,
}  # fmt: skip


class Pair(NamedTuple):
    """A type, and the same in ctypes, whose compiler packs by its own rules."""

    iec: Any
    c: Any
    width: int | None = None
    """Bits of a bit field."""


SCALARS = st.sampled_from([Pair(kind, c) for kind, c in C_TYPES.items()])
TEXTS = st.integers(1, 9).map(lambda length: Pair(STRING(length), ctypes.c_uint8 * (length + 1)))


NUMBERS = itertools.count()
"""Of the random structures: a name stands for one type."""


def declare(base: type, body: dict[str, Any], **options: Any) -> Any:
    """Return what a class statement makes."""
    return types.new_class("Declared", (base,), options, lambda space: space.update(body))


def array(pair: Pair, low: int, count: int) -> Pair:
    return Pair(Array(pair.iec, (low, low + count - 1)), pair.c * count)


def structure(pack: int, members: list[Pair]) -> Pair:
    space: dict[str, Any] = {f"m{at}": Field(f"M{at}", pair.iec) for at, pair in enumerate(members)}
    cls = declare(Struct, space, iec=f"ST_RANDOM_{next(NUMBERS)}", pack=pack)
    fields = [(f"M{at}", pair.c, *([pair.width] if pair.width else [])) for at, pair in enumerate(members)]
    return Pair(cls, type("Random", (ctypes.Structure,), {"_pack_": pack, "_fields_": fields}))


def structures(inner: st.SearchStrategy[Pair]) -> st.SearchStrategy[Pair]:
    """Return structures of what there is already, and BITs."""
    bits = st.just(Pair(BIT, ctypes.c_uint8, 1))
    members = st.lists(st.one_of(inner, bits, bits), min_size=1, max_size=12)
    return st.builds(structure, st.sampled_from([1, 2, 4, 8]), members)


def arrays(inner: st.SearchStrategy[Pair]) -> st.SearchStrategy[Pair]:
    return st.builds(array, inner, st.integers(-3, 3), st.integers(1, 4))


RANDOM = structures(st.recursive(SCALARS | TEXTS, lambda inner: structures(inner) | arrays(inner), max_leaves=6))
"""Structures with nested ones, arrays, texts and BITs, in every pack mode."""
