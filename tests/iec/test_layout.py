"""Packing: what a C compiler makes of the same declaration is the oracle."""

import ctypes
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.iec import BIT, BOOL, LREAL, UDINT, UINT, Array, Field, String, Struct, StructType
from tests.effort import examples
from tests.iec.declared import RANDOM, Everything, Pair, declare


def same(mine: Any, theirs: Any, kind: Any) -> bool:
    """Tell whether a value and what ctypes has in its place are equal."""
    if isinstance(kind, StructType):
        return all(same(getattr(mine, one.attribute), getattr(theirs, one.name), one.type) for one in kind.fields)
    if isinstance(kind, Array):
        return all(same(one, other, kind.of) for one, other in zip(mine, theirs, strict=True))
    if isinstance(kind, String):
        codes = bytes(theirs)[: kind.length].partition(b"\0")[0]
        return bool(mine == "".join(bytes([one]).decode("cp1252", "ignore") or chr(one) for one in codes))
    return bool(mine == theirs) or (math.isnan(mine) and math.isnan(theirs))


@settings(max_examples=examples(150), deadline=None)
@given(RANDOM)
def test_offsets_and_sizes_are_those_of_a_compiler(pair: Pair) -> None:
    kind, c = pair.iec.type, pair.c
    assert (kind.size, kind.alignment) == (ctypes.sizeof(c), ctypes.alignment(c))
    for field in kind.fields:
        theirs = getattr(c, field.name)
        assert field.offset == theirs.offset
        if field.bit is not None:
            assert theirs.size == 1 << 16 | field.bit


@settings(max_examples=examples(150), deadline=None)
@given(RANDOM, st.data())
def test_values_are_where_a_compiler_reads_them(pair: Pair, data: st.DataObject) -> None:
    size = pair.iec.type.size
    raw = data.draw(st.binary(min_size=size, max_size=size))
    assert same(pair.iec.from_bytes(raw), pair.c.from_buffer_copy(raw), pair.iec.type)


@settings(max_examples=examples(100), deadline=None)
@given(RANDOM)
def test_the_numpy_type_has_the_same_offsets(pair: Pair) -> None:
    kind = pair.iec.type
    assert pair.iec.dtype is kind.dtype
    assert kind.dtype.itemsize == kind.size
    for field in kind.fields:
        name = field.name if field.bit is None else f"bits{field.offset}"
        assert kind.dtype.fields[name][1] == field.offset
        assert kind.dtype.fields[name][0].itemsize == field.type.size


def test_natural_packing_is_that_of_numpy() -> None:
    class Natural(Struct, iec="ST_NATURAL"):
        """Pack mode 8."""

        flag = Field("bFlag", BOOL)
        value = Field("rValue", LREAL)
        short = Field("nShort", UINT)
        long = Field("nLong", Array(UDINT, (1, 3)))

    aligned = np.dtype([("bFlag", "?"), ("rValue", "<f8"), ("nShort", "<u2"), ("nLong", "<u4", (3,))], align=True)
    assert Natural.dtype == aligned


def test_bits_share_bytes_until_another_member_comes() -> None:
    body: dict[str, Any] = {f"b{at}": Field(f"b{at}", BIT) for at in range(10)}
    body["number"] = Field("nNumber", UINT)
    body["last"] = Field("bLast", BIT)
    kind = declare(Struct, body, iec="ST_BITS", pack=2).type
    assert [(one.offset, one.bit) for one in kind.fields] == [
        *((0, bit) for bit in range(8)), (1, 0), (1, 1), (2, None), (4, 0),
    ]  # fmt: skip
    assert kind.size == 6
    assert list(kind.dtype.fields) == ["bits0", "bits1", "nNumber", "bits4"]


def test_a_nested_structure_keeps_its_inside() -> None:
    class Inner(Struct, iec="ST_INNER", pack=8):
        """Sixteen bytes."""

        flag = Field("bFlag", BOOL)
        value = Field("rValue", LREAL)

    class Outer(Struct, iec="ST_OUTER", pack=2):
        """Begins the inner one at 2."""

        flag = Field("bFlag", BOOL)
        inner = Field("stInner", Inner)

    assert [one.offset for one in Outer.type.fields] == [0, 2]
    assert [one.offset for one in Inner.type.fields] == [0, 8]
    assert (Outer.type.size, Outer.type.alignment) == (18, 2)
    outer = Outer()
    outer.inner.value = 1.0
    assert bytes(outer)[10:] == bytes.fromhex("000000000000F03F")


def test_fields_tell_what_was_declared() -> None:
    field = Everything.type.fields[1]
    assert (field.attribute, field.name, field.offset, field.bit) == ("second", "bSecond", 0, 1)
    assert (field.comment, field.default, field.type) == ("bit 1", True, BIT)
    assert Everything.type.comment == "A member of every sort."
    assert Everything.type.field("NNUMBER") is Everything.type.fields[3]
    assert Everything.type.field("nothing") is None


@pytest.mark.parametrize(
    ("options", "error", "text"),
    [
        ({}, TypeError, 'class Declared: a structure needs a declared name, as iec="ST_NAME"'),
        ({"iec": "ST", "body": {}}, TypeError, "at least one Field"),
        ({"iec": "ST", "pack": 3}, ValueError, "pack mode 3 must be one of 1, 2, 4, 8"),
        ({"iec": "S T"}, ValueError, "'S T' is no name in IEC 61131-3"),
        ({"iec": "ST", "body": {"one": Field("1", UINT)}}, ValueError, "'1' is no name"),
        ({"iec": "ST", "base": Everything}, TypeError, "a structure is not extended; nest Everything as a Field"),
        ({"iec": "ST", "body": {"a": Field("n", UINT), "b": Field("N", UINT)}}, ValueError, "two fields are named n"),
        (
            {"iec": "ST", "body": {"view": Field("n", UINT)}},
            TypeError,
            "Declared.view: every structure has this attribute",
        ),
        ({"iec": "ST", "body": {"_a": Field("n", UINT)}}, TypeError, "Declared._a: every structure has this attribute"),
    ],
)
def test_a_wrong_declaration_is_refused(options: dict[str, Any], error: type[Exception], text: str) -> None:
    with pytest.raises(error) as told:
        declare(options.pop("base", Struct), options.pop("body", {"one": Field("nOne", UINT)}), **options)
    assert text in str(told.value)


def test_a_field_needs_a_type() -> None:
    with pytest.raises(TypeError, match="'REAL' is no IEC type: use one of"):
        Field("rValue", "REAL")  # type: ignore[call-overload]
    with pytest.raises(ValueError, match="nOne: 70000 must be 0 to 65535 \\(UINT\\)"):
        Field("nOne", UINT, default=70000)
