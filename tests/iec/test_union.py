"""Unions: the same bytes under several names."""

import ctypes

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.iec import BIT, BOOL, LREAL, STRING, UDINT, Array, Field, Struct, Union
from tests.iec.declared import AxisCommand, AxisCtrl, Overlay, declare


class Wide(Union, iec="U_WIDE", pack=2):
    """Members of several sizes."""

    flag = Field("bFlag", BOOL)
    value = Field("rValue", LREAL)
    text = Field("sText", STRING(8))


class Holder(Struct, iec="ST_HOLDER", pack=8):
    """A union inside a structure."""

    flag = Field("bFlag", BOOL)
    overlay = Field("uOverlay", Overlay)
    many = Field("uMany", Array(Overlay, (1, 2)))


def test_layout_is_that_of_a_compiler() -> None:
    class Theirs(ctypes.Union):
        _pack_ = 2
        _fields_ = (("bFlag", ctypes.c_bool), ("rValue", ctypes.c_double), ("sText", ctypes.c_char * 9))

    assert (Wide.type.size, Wide.type.alignment) == (ctypes.sizeof(Theirs), ctypes.alignment(Theirs)) == (10, 2)
    assert [one.offset for one in Wide.type.fields] == [0, 0, 0]
    assert Wide.type.union
    assert Wide.dtype.itemsize == 10
    assert [one.offset for one in Holder.type.fields] == [0, 4, 8]


def test_start_values() -> None:
    assert bytes(Overlay()) == bytes.fromhex("0C000A00")
    assert bytes(Wide()) == bytes(10)
    holder = Holder()
    assert (holder.overlay.ctrl.cmd, holder.many[2].number) == (AxisCommand.MOVE_POS, 0x000A_000C)


@given(st.integers(0, 2**32 - 1))
def test_members_show_the_same_bytes(number: int) -> None:
    one = Overlay(number=number)
    assert one.ctrl == AxisCtrl(cmd=number & 0xFFFF, progress=number >> 16)
    assert bytes(one.bytes) == number.to_bytes(4, "little")
    other = Overlay()
    other.bytes = list(number.to_bytes(4, "little"))
    assert other == one
    assert Overlay.from_bytes(bytes(one)).number == number


def test_parts_write_through_and_ask_the_guard() -> None:
    holder = Holder()
    asked: list[int] = []
    holder.attach(lambda: asked.append(1))
    holder.overlay.ctrl.progress = 0x1234
    holder.many[1].bytes[0] = 0xFF
    holder.many[2].number = 7
    assert (holder.overlay.number, holder.many[1].number, holder.many[2].ctrl.cmd) == (0x1234_000C, 0x000A_00FF, 7)
    assert len(asked) == 3
    again = Holder.from_bytes(bytes(holder))
    assert again == holder
    view = Holder.view(bytearray(bytes(holder)))
    view.many[1].ctrl = AxisCtrl(cmd=1)
    assert view.many[1].number == 1
    assert view != holder


def test_a_union_has_no_bits() -> None:
    with pytest.raises(TypeError, match=r"Declared\.bit: a union has no BITs; nest a structure of BITs"):
        declare(Union, {"bit": Field("bBit", BIT), "number": Field("n", UDINT)}, iec="U")
