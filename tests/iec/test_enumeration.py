"""Enumerations: members, names, numbers without a member."""

import enum

import pytest

from motionlayer.iec import DINT, INT, SINT, UINT, Enumeration
from tests.iec.declared import E_AXIS_CTRL, AxisCommand


class Level(enum.IntEnum):
    EMPTY = 0
    ERROR = 2
    FAULT = 2


class Far(enum.IntEnum):
    FAR = 128


class Below(enum.IntEnum):
    LOW = -5


def test_declared_names() -> None:
    named = [(name, int(member)) for name, member in E_AXIS_CTRL.items]
    assert named == [("AXIS_NULL", 0), ("AXIS_MOVE_POS", 12), ("AXIS_MOVE_BUFFER_VELO", 31), ("CAM_IN", 61)]
    assert E_AXIS_CTRL.iec_name(AxisCommand.MOVE_POS) == E_AXIS_CTRL.iec_name(12) == "AXIS_MOVE_POS"
    assert E_AXIS_CTRL.iec_name(61) == "CAM_IN"
    assert E_AXIS_CTRL.iec_name(999) == "999"
    assert E_AXIS_CTRL.value_of("axis_move_pos") is AxisCommand.MOVE_POS
    with pytest.raises(ValueError, match="E_AXIS_CTRL has no member 'MOVE_POS'; it has AXIS_NULL, AXIS_MOVE_POS"):
        E_AXIS_CTRL.value_of("MOVE_POS")


def test_given_names_and_members_of_the_same_value() -> None:
    kind = Enumeration("E_Level", DINT, Level, prefix="e", names={"ERROR": "eMessageError"})
    assert [name for name, _ in kind.items] == ["eEMPTY", "eMessageError", "eFAULT"]
    assert kind.iec_name(2) == "eMessageError"


def test_values() -> None:
    assert (E_AXIS_CTRL.size, E_AXIS_CTRL.alignment, E_AXIS_CTRL.base) == (2, 2, UINT)
    assert E_AXIS_CTRL.initial() is AxisCommand.NULL
    assert E_AXIS_CTRL.check(12) is AxisCommand.MOVE_POS
    assert E_AXIS_CTRL.check(Level.ERROR) == 2
    assert type(E_AXIS_CTRL.check(Level.ERROR)) is int
    below = Enumeration("E_Below", INT, Below)
    assert (below.initial(), type(below.initial())) == (0, int)
    memory = bytearray(2)
    below.pack_into(Below.LOW, memory)
    assert memory == b"\xfb\xff"
    assert below.unpack_from(memory) is Below.LOW


def test_bad_values() -> None:
    with pytest.raises(ValueError, match=r"eCmd: 65536 must be 0 to 65535 \(UINT\)"):
        E_AXIS_CTRL.check(65536, "eCmd")
    with pytest.raises(TypeError, match=r"E_AXIS_CTRL: 'AXIS_NULL' must be a whole number \(UINT\)"):
        E_AXIS_CTRL.check("AXIS_NULL")


def test_wrong_declarations() -> None:
    with pytest.raises(ValueError, match=r"E_X\.LOW: -5 must be 0 to 65535 \(UINT\)"):
        Enumeration("E_X", UINT, Below)
    with pytest.raises(ValueError, match=r"E_X\.FAR: 128 must be -128 to 127 \(SINT\)"):
        Enumeration("E_X", SINT, Far)
    with pytest.raises(ValueError, match="E_X: two members are named error"):
        Enumeration("E_X", UINT, Level, names={"FAULT": "Error"})
    with pytest.raises(ValueError, match="E_X: names tells of LOST, which is no member of Level"):
        Enumeration("E_X", UINT, Level, names={"LOST": "Error"})
