"""Structures: values, bytes, views, guards."""

import array
import copy
import pickle
from typing import Any, assert_type

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.iec import ArrayValue
from tests.effort import examples
from tests.iec.declared import RANDOM, AxisCommand, AxisCtrl, Everything, MoveData, Pair


def test_start_values_are_declared_or_zero() -> None:
    made = Everything()
    assert (made.first, made.second, made.flag, made.number, made.name) == (False, True, False, 0, "")
    assert made.single == pytest.approx(47.11, abs=1e-5)
    assert list(made.ratios) == [1.0, 2.0, 3.0, 4.0]
    assert made.ctrl == AxisCtrl()
    assert bytes(MoveData()) == bytes(16) + bytes.fromhex("0000000000005940") + bytes(24)


def test_two_objects_do_not_share_parts() -> None:
    one, other = Everything(), Everything()
    one.ratios[1] = 7.0
    one.ctrl.cmd = AxisCommand.CAM_IN
    assert other == Everything()
    other.ctrl = one.ctrl
    one.ctrl.cmd = AxisCommand.NULL
    assert other.ctrl.cmd is AxisCommand.CAM_IN


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (AxisCtrl(cmd=AxisCommand.MOVE_POS), "0C000000"),
        (AxisCtrl(cmd=AxisCommand.MOVE_BUFFER_VELO, progress=10000), "1F001027"),
        (AxisCtrl(cmd=999), "E7030000"),
    ],
)
def test_bytes_of_the_interface(made: AxisCtrl, expected: str) -> None:
    assert bytes(made) == bytes.fromhex(expected)
    assert AxisCtrl.from_bytes(bytes(made)) == made


def test_numbers_without_a_member_stay_numbers() -> None:
    read = AxisCtrl.from_bytes(bytes.fromhex("0C00 0000"))
    assert read.cmd is AxisCommand.MOVE_POS
    read.cmd = 999
    assert type(read.cmd) is int
    read.cmd = 61
    assert read.cmd is AxisCommand.CAM_IN


def test_type_checkers_know_what_a_member_is() -> None:
    made = Everything()
    assert_type(made.first, bool)
    assert_type(made.number, int)
    assert_type(made.single, float)
    assert_type(made.name, str)
    assert_type(made.ctrl, AxisCtrl)
    assert_type(made.ctrl.cmd, AxisCommand | int)
    assert_type(made.ratios, ArrayValue[float, float])
    assert_type(made.table[1, 0], AxisCtrl)


@settings(max_examples=examples(150), deadline=None)
@given(RANDOM, st.data())
def test_bytes_survive_the_way_through_an_object(pair: Pair, data: st.DataObject) -> None:
    size = pair.iec.type.size
    first = pair.iec.from_bytes(data.draw(st.binary(min_size=size, max_size=size)))
    memory = bytearray(b"\xaa" * (size + 7))
    first.pack_into(memory, 3)
    assert memory[:3] + memory[3 + size :] == b"\xaa" * 7
    second = pair.iec()
    second.unpack_from(memory, 3)
    assert bytes(second) == bytes(first) == memory[3 : 3 + size]
    assert repr(second) == repr(first)


@settings(max_examples=examples(150), deadline=None)
@given(RANDOM, st.data())
def test_a_view_is_its_memory(pair: Pair, data: st.DataObject) -> None:
    size = pair.iec.type.size
    made = pair.iec.from_bytes(data.draw(st.binary(min_size=size, max_size=size)))
    memory = bytearray(size + 5)
    view = pair.iec.view(memory, 5)
    for field in made.type.fields:
        setattr(view, field.attribute, getattr(made, field.attribute))
    assert memory == bytes(5) + bytes(made)
    assert bytes(view) == bytes(made)
    assert repr(view) == repr(made)
    assert isinstance(view, pair.iec)


def test_a_view_reads_and_writes_through() -> None:
    memory = bytearray(Everything.type.size)
    view = Everything.view(memory)
    view.assign(Everything(number=5, name="axis"))
    memory[0] |= 1
    assert view.first
    assert view.second
    view.second = False
    assert memory[0] == 1
    view.ctrl.cmd = 12
    view.table[2, 1].progress = 7
    view.ratios[4] = -1.0
    view.commands[-1] = 31
    read = Everything.from_bytes(memory)
    assert read == view
    assert (read.ctrl.cmd, read.table[2, 1].progress, read.ratios[4], read.commands[-1]) == (12, 7, -1.0, 31)
    assert view.commands[-1] is AxisCommand.MOVE_BUFFER_VELO


def test_a_view_takes_memory_of_any_items() -> None:
    numbers = array.array("d", [0.0, 1.0])
    view = MoveData.view(memoryview(array.array("d", [0.0] * 7)), 8)
    assert view.position == 0.0
    with pytest.raises(ValueError, match="48 bytes at offset 0 do not lie within a memory of 16 bytes"):
        MoveData.view(memoryview(numbers))


def test_a_view_of_bytes_is_read_only() -> None:
    view = Everything.view(bytes(Everything()))
    refused: list[Any] = [
        lambda: setattr(view, "number", 1),
        lambda: setattr(view, "first", True),
        lambda: setattr(view.ctrl, "cmd", 1),
        lambda: setattr(view.table[1, 0], "cmd", 1),
        lambda: view.ratios.__setitem__(1, 1.0),
        lambda: view.assign(Everything()),
    ]
    for write in refused:
        with pytest.raises(PermissionError, match="ST_EVERYTHING: this memory is read-only"):
            write()
    assert view == Everything()


def test_the_guard_comes_before_every_write_and_may_refuse() -> None:
    made = Everything()
    before: list[bytes] = []
    made.attach(lambda: before.append(bytes(made)))
    writes: list[Any] = [
        lambda: setattr(made, "number", 1),
        lambda: setattr(made, "ctrl", AxisCtrl(cmd=1)),
        lambda: setattr(made.ctrl, "cmd", 12),
        lambda: setattr(made, "ratios", [1, 2, 3, 5]),
        lambda: made.ratios.__setitem__(1, 9.0),
        lambda: setattr(made.table[1, 1], "progress", 3),
        lambda: made.table.__setitem__((2, 0), AxisCtrl(cmd=61)),
        lambda: made.assign(Everything()),
    ]
    for count, write in enumerate(writes, 1):
        old = bytes(made)
        write()
        assert bytes(made) != old
        assert before[-1] == old
        assert len(before) == count
    made.unpack_from(bytes(Everything(number=4)))
    assert len(before) == len(writes)

    def refuse() -> None:
        raise PermissionError("owned")

    made.attach(refuse)
    old = bytes(made)
    for write in writes:
        with pytest.raises(PermissionError, match="owned"):
            write()
    assert bytes(made) == old


def test_a_wrong_value_does_not_reach_the_guard() -> None:
    made = MoveData()
    asked: list[int] = []
    made.attach(lambda: asked.append(1))
    with pytest.raises(TypeError):
        made.position = "far"  # type: ignore[assignment]
    assert not asked


@pytest.mark.parametrize(
    ("attribute", "value", "error", "text"),
    [
        ("numbr", 1, AttributeError, "Everything (ST_EVERYTHING) has no member numbr; did you mean number?"),
        ("xyz", 1, AttributeError, "has no member xyz; it has first, second, flag"),
        ("number", -1, ValueError, "Everything.number: -1 must be 0 to 4294967295 (UDINT)"),
        ("number", 1.0, TypeError, "Everything.number: 1.0 must be a whole number (UDINT)"),
        ("number", True, TypeError, "Everything.number: True must be a whole number (UDINT)"),
        ("flag", 1, TypeError, "Everything.flag: 1 must be True or False (BOOL)"),
        ("first", 0, TypeError, "Everything.first: 0 must be True or False (BIT)"),
        ("single", 1e39, ValueError, "Everything.single: 1e+39 must be -3.4e38 to 3.4e38 (REAL)"),
        ("single", "1", TypeError, "Everything.single: '1' must be a number (REAL)"),
        ("name", "eight ch", ValueError, "Everything.name: 8 characters, at most 7 fit (STRING(7))"),
        ("ctrl", 12, TypeError, "Everything.ctrl: 12 must be of class AxisCtrl (ST_AXIS_CTRL)"),
        ("ratios", [1.0], ValueError, "Everything.ratios: 1 elements, must be 4 (ARRAY [1..4] OF REAL)"),
        ("ratios", [1, 2, 3, "x"], TypeError, "Everything.ratios[4]: 'x' must be a number (REAL)"),
        ("ratios", "1234", TypeError, "Everything.ratios: '1234' must be a sequence of 4 elements"),
        ("ratios", 1.0, TypeError, "Everything.ratios: 1.0 must be a sequence of 4 elements"),
        ("_guard", None, AttributeError, "has no member _guard"),
    ],
)
def test_bad_writes_tell_who_what_and_limit(attribute: str, value: object, error: type[Exception], text: str) -> None:
    for made in (Everything(), Everything.view(bytearray(bytes(Everything())))):
        with pytest.raises(error) as told:
            setattr(made, attribute, value)
        assert text in str(told.value)
        assert made == Everything()


def test_a_member_that_is_not_there_cannot_be_read_either() -> None:
    for made in (Everything(), Everything.view(bytearray(bytes(Everything())))):
        with pytest.raises(
            AttributeError, match=r"Everything \(ST_EVERYTHING\) has no member numbr; did you mean number"
        ):
            made.numbr  # type: ignore[attr-defined]  # noqa: B018
        assert not hasattr(made, "xyz")


def test_members_are_not_deleted() -> None:
    with pytest.raises(AttributeError, match=r"MoveData\.position: a member cannot be deleted"):
        del MoveData().position


def test_bytes_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match="ST_AXIS_CTRL: 3 bytes, must be 4"):
        AxisCtrl.from_bytes(bytes(3))
    with pytest.raises(ValueError, match="ST_AXIS_CTRL: 5 bytes, must be 4"):
        AxisCtrl.from_bytes(bytes(5))
    text = "ST_EVERYTHING: .* bytes at offset {} do not lie within a memory of"
    size = Everything.type.size
    for offset in (-1, 1, size):
        view = Everything.view(bytearray(size))
        made = Everything()
        for act in (made.pack_into, made.unpack_from, Everything.view, view.pack_into, view.unpack_from):
            with pytest.raises(ValueError, match=text.format(offset)):
                act(bytearray(size), offset)


def test_copies_are_of_the_same_class_and_free() -> None:
    made = Everything(number=3, ratios=[4, 3, 2, 1])
    made.attach(lambda: None)
    view = Everything.view(bytearray(bytes(made)))
    for one in (copy.copy(made), copy.deepcopy(made), pickle.loads(pickle.dumps(made)), copy.copy(view)):  # noqa: S301
        assert type(one) is Everything
        assert one == made
        one.number = 9
        assert made.number == view.number == 3


def test_equality_is_of_values_in_the_same_type() -> None:
    assert AxisCtrl(cmd=12) == AxisCtrl(cmd=AxisCommand.MOVE_POS)
    assert AxisCtrl(cmd=12) != AxisCtrl(cmd=11)
    assert AxisCtrl() != MoveData()
    assert AxisCtrl() != 0
    with pytest.raises(TypeError, match="unhashable"):
        hash(AxisCtrl())


def test_match_takes_members() -> None:
    match AxisCtrl(cmd=12, progress=5):
        case AxisCtrl(cmd=AxisCommand.MOVE_POS, progress=progress):
            assert progress == 5
        case _:
            pytest.fail("not matched")
