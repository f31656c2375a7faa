"""Inputs and outputs: objects and their bytes."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.iec import UINT, InputArray, OutputArray, Struct
from tests.iec.declared import E_AXIS_CTRL, AxisCommand, AxisCtrl, Everything, MoveData, Overlay

SIZE = AxisCtrl.type.size


def controls() -> InputArray[AxisCtrl]:
    return InputArray(AxisCtrl, 1, 6, "GVL_AXIS.Ctrl")


def test_a_written_object_is_touched_once_and_published_later() -> None:
    array = controls()
    array[3].cmd = AxisCommand.MOVE_POS
    array[1].progress = 5
    array[3].progress = 7
    assert array.touched == [3, 1]
    assert array.memory == bytes(6 * SIZE)
    assert array.read(2 * SIZE, SIZE) == bytes.fromhex("0C000700")
    array.publish()
    assert array.memory == b"".join(map(bytes, array))
    assert array.take() == [3, 1]
    nothing = array.take()
    assert nothing == array.touched == []
    array[3].cmd = 0
    assert nothing == []
    assert array.take() == [3]


def test_start_values_are_published() -> None:
    array = InputArray(MoveData, 1, 2, "GVL_AXIS.Data")
    assert array.memory == bytes(MoveData()) * 2
    assert array.touched == []


def test_an_element_is_assigned_as_a_whole() -> None:
    array = controls()
    kept = array[2]
    array[2] = AxisCtrl(cmd=12)
    assert array[2] is kept
    assert kept.cmd is AxisCommand.MOVE_POS
    assert array.take() == [2]


@pytest.mark.parametrize("cls", [AxisCtrl, MoveData, Everything, Overlay])
@given(data=st.data())
def test_several_elements_take_on_their_bytes_as_each_alone_does(cls: type[Struct], data: st.DataObject) -> None:
    size = cls.type.size
    array = InputArray(cls, -1, 3, "GVL.Several")
    elements, before = list(array), [bytes(one) for one in array]
    places = data.draw(st.lists(st.integers(0, 4), unique=True))
    rows = data.draw(st.binary(min_size=len(places) * size, max_size=len(places) * size))
    alone = {place: bytes(cls.from_bytes(rows[at * size : (at + 1) * size])) for at, place in enumerate(places)}
    array.decode(places, rows)
    assert [bytes(one) for one in array] == [alone.get(place, before[place]) for place in range(5)]
    assert all(one is kept for one, kept in zip(array, elements, strict=True))
    assert array.take() == [place - 1 for place in places]


@given(st.data())
def test_written_bytes_reach_the_elements_they_touch(data: st.DataObject) -> None:
    array = controls()
    array[2].cmd = 31  # not published
    offset = data.draw(st.integers(0, 6 * SIZE))
    raw = data.draw(st.binary(max_size=6 * SIZE - offset))
    expected = bytearray(b"".join(map(bytes, array)))
    expected[offset : offset + len(raw)] = raw
    array.take()
    array.write(offset, raw, "client")
    assert b"".join(map(bytes, array)) == expected == array.read(0, 6 * SIZE)
    changed = {(offset + at) // SIZE + 1 for at in range(len(raw))}
    assert array.take() == sorted(changed)
    array.publish()
    assert array.memory == expected


def test_bytes_that_mean_nothing_stay_until_the_object_is_written() -> None:
    array = InputArray(Everything, None, None, "GVL.Everything")
    raw = bytes([0xFF]) * Everything.type.size
    array.write(0, raw, "client")
    array.publish()
    assert array.memory == raw
    array.value.number = 1
    array.publish()
    assert array.memory == bytes(array.value)


def test_only_what_was_written_is_published() -> None:
    array = controls()
    array[1].cmd = 12
    array[2].cmd = 12
    array.publish()
    array.memory[SIZE] = 61  # as if somebody wrote there
    array[1].cmd = 31
    array.publish()
    assert (array.memory[0], array.memory[SIZE]) == (31, 61)
    everything = InputArray(Everything, None, None, "GVL.Everything")
    everything.value.number = 1
    everything.accept(None, bytes([0xFF]) * Everything.type.size)
    everything.publish()
    assert everything.memory == bytes([0xFF]) * Everything.type.size


def test_the_guard_knows_the_element_and_who_writes() -> None:
    array = controls()
    asked: list[tuple[int | None, str | None]] = []
    array.guard = lambda index: asked.append((index, array.by))
    array[4].cmd = 1
    array[4].progress = 1
    array.write(3, b"123", "client")
    array[5] = AxisCtrl()
    array.accept(6, bytes(SIZE))
    assert asked == [(4, None), (4, None), (1, "client"), (2, "client"), (5, None)]


def test_a_refused_write_changes_nothing() -> None:
    array = controls()

    def guard(index: int | None) -> None:
        if index == 2:
            raise PermissionError("GVL_AXIS.Ctrl[2] is mapped")

    array.guard = guard
    writes: list[Any] = [
        lambda: setattr(array[2], "cmd", 1),
        lambda: array.__setitem__(2, AxisCtrl(cmd=1)),
        lambda: array.write(0, bytes([1]) * 3 * SIZE, "client"),
    ]
    for write in writes:
        with pytest.raises(PermissionError, match="is mapped"):
            write()
    array.publish()
    assert array.memory == bytes(6 * SIZE)
    assert (array.touched, array.by) == ([], None)
    array[1].cmd = 1


def test_an_image_is_accepted_without_asking() -> None:
    array = controls()
    array[2].cmd = 31

    def guard(_: int | None) -> None:
        raise PermissionError

    array.guard = guard
    array.accept(2, b"....\x0c\0\x01\0", 4)
    assert array[2] == AxisCtrl(cmd=12, progress=1)
    assert array.memory[SIZE : 2 * SIZE] == b"\x0c\0\x01\0"
    assert array.take() == [2]


def test_a_single_object_has_no_index() -> None:
    array = InputArray(AxisCtrl, None, None, "GVL.Ctrl")
    asked: list[int | None] = []
    array.guard = asked.append
    array.value.cmd = 12
    array.value = AxisCtrl(cmd=1)
    array.accept(None, bytes(SIZE))
    assert (asked, array.take(), array.type, len(array)) == ([None, None], [0], AxisCtrl.type, 1)
    with pytest.raises(TypeError, match=r"GVL\.Ctrl is a single object: use value"):
        _ = array[1]
    with pytest.raises(TypeError, match=r"GVL_AXIS\.Ctrl is an array: give an index, \[1\.\.6\]"):
        _ = controls().value


def test_scalars_are_values() -> None:
    levels = InputArray(E_AXIS_CTRL, 0, 2, "GVL.Level")
    levels[1] = 12
    assert levels[1] is AxisCommand.MOVE_POS
    levels.publish()
    assert levels.memory == bytes([0, 0, 12, 0, 0, 0])
    assert levels.take() == [1]
    levels.write(4, b"\x3d\0", "client")
    assert levels[2] is AxisCommand.CAM_IN
    with pytest.raises(ValueError, match=r"GVL\.Level\[1\]: -1 must be 0 to 65535"):
        levels[1] = -1
    state = OutputArray(UINT, None, None, "MAIN_AXIS.eInit")
    state.value = 10000
    assert state.value == 10000
    assert bytes(state.memory) == (10000).to_bytes(2, "little")


@pytest.mark.parametrize("index", [0, 7, -1])
def test_indices_out_of_bounds(index: int) -> None:
    for array in (controls(), OutputArray(AxisCtrl, 1, 6, "GVL_AXIS.Ctrl")):
        with pytest.raises(IndexError, match=rf"GVL_AXIS\.Ctrl: index {index} is out of \[1\.\.6\]"):
            _ = array[index]
    with pytest.raises(IndexError, match="is out of"):
        controls().accept(index, bytes(SIZE))


def test_bytes_out_of_bounds() -> None:
    for offset, size in ((-1, 1), (24, 1), (0, 25)):
        for array in (controls(), OutputArray(AxisCtrl, 1, 6, "GVL_AXIS.Ctrl")):
            with pytest.raises(ValueError, match=rf"GVL_AXIS\.Ctrl: {size} bytes at offset {offset} do not lie"):
                array.read(offset, size)
        with pytest.raises(ValueError, match="do not lie within"):
            controls().write(offset, bytes(size), "client")
    with pytest.raises(ValueError, match="do not lie within"):
        controls().accept(1, bytes(SIZE), 1)


def test_outputs_are_views_and_an_array() -> None:
    array = OutputArray(MoveData, 1, 3, "GVL_AXIS.Data")
    assert bytes(array.memory) == bytes(MoveData()) * 3
    array[2].position = 5.0
    array.array["rJerk"][2] = 7.0
    assert array.array["rSetPos"].tolist() == [0.0, 5.0, 0.0]
    assert array[3].jerk == 7.0
    assert array[2] is array[2]
    array[1] = array[3]
    assert array[1] == array[3]
    with pytest.raises(PermissionError, match=r"GVL_AXIS\.Data is written by the layer: client can only read it"):
        array.write(0, b"1", "client")


def test_outputs_on_given_memory() -> None:
    memory = bytearray(b"\x0c\0\x01\0" * 2)
    array = OutputArray(AxisCtrl, 1, 2, "GVL.Ctrl", memory=memory)
    assert array[2].cmd is AxisCommand.MOVE_POS
    array[1].progress = 9
    assert memory[2] == 9
    with pytest.raises(ValueError, match=r"GVL\.Ctrl: a memory of 7 bytes, must be 8 \(ARRAY"):
        OutputArray(AxisCtrl, 1, 2, "GVL.Ctrl", memory=bytearray(7))
