"""One owner of every element that clients write; what the other side hears of it."""

from operator import attrgetter
from typing import Any

import pytest

from motionlayer.event import Device, Level
from motionlayer.iec import InputArray
from motionlayer.layer._inputs import overwrite
from motionlayer.layer._mapping import MapOptions
from motionlayer.layer.types import AxisCommand, MoveData
from tests.layer.mapped import Mapped
from tests.layer.rig import Rig

A = MapOptions("A", "axis", (1, 3))
WAY_OUT = "let the controller write the image, or take the object out of [layer.map]"


def array(mapped: Mapped, name: str = "GVL_AXIS.Ctrl") -> InputArray[Any]:
    found = mapped.arrays[name]
    assert isinstance(found, InputArray)
    return found


def test_a_program_cannot_write_what_belongs_to_an_image_and_is_told_why() -> None:
    mapped = Mapped(A)
    told: list[str] = []

    def pick(_run: object) -> None:
        try:
            array(mapped)[3].cmd = AxisCommand.ENABLE
        except PermissionError as error:
            told.append(str(error))
        array(mapped)[2].cmd = AxisCommand.ENABLE

    mapped.run.cyclic(pick)
    mapped.run.step(3)
    assert mapped.commands() == [0, 3, 0]
    assert told == 3 * [f"GVL_AXIS.Ctrl[3] belongs to the image A_in.AxisCtrl: program pick cannot write it; {WAY_OUT}"]


def test_the_log_names_a_writer_once() -> None:
    mapped = Mapped(A)
    ctrl = array(mapped)
    for _ in range(3):
        with pytest.raises(PermissionError):
            ctrl.write(0, b"\1\0", "client 5.1.2.3.1.1:30000")
        with pytest.raises(PermissionError):
            ctrl[1].cmd = AxisCommand.INIT
    first, second = mapped.messages
    assert (first.level, first.source, first.device) == (Level.WARNING, "GVL_AXIS.Ctrl[1]", Device.Axis + 1)
    told = "GVL_AXIS.Ctrl[1] belongs to the image A_in.AxisCtrl:"
    assert first.text == f"{told} client 5.1.2.3.1.1:30000 cannot write it"
    assert second.text == f"{told} the script of the run cannot write it"


def test_all_that_is_mapped_with_an_axis_belongs_to_its_image_and_the_rest_does_not() -> None:
    mapped = Mapped(A)
    with pytest.raises(PermissionError, match=r"GVL_AXIS.Data\[1\] belongs to the image A_in.AxisMoveData"):
        array(mapped, "GVL_AXIS.Data")[1] = MoveData(position=1.0)
    array(mapped, "GVL_AXIS.Data")[2] = MoveData(position=1.0)
    array(mapped, "GVL_CAM.Ctrl")[1] = 3  # of the same axis, but no map of cams
    array(mapped, "GVL_AXIS.SelectorCtrl").value = 3
    with pytest.raises(PermissionError, match=r"SelectorCtrl belongs to the image MAPPING_AXIS_in\.SelectorCtrl"):
        array(Mapped(MapOptions("M", "axis", selector=True)), "GVL_AXIS.SelectorCtrl").value = 3


def test_a_write_of_several_elements_of_which_one_is_mapped_changes_none() -> None:
    mapped = Mapped(A)
    with pytest.raises(PermissionError, match=r"Ctrl\[3\] belongs"):
        array(mapped).write(4, bytes([3, 0, 0, 0, 3, 0, 0, 0]), "client")
    assert mapped.commands() == [0, 0, 0]
    assert array(mapped).touched == []


def test_the_layer_itself_writes_what_belongs_to_others() -> None:
    mapped = Mapped(A)
    overwrite(array(mapped), 1, cmd=AxisCommand.INIT)
    assert mapped.commands() == [1, 0, 0]
    assert mapped.messages == []


def test_of_two_programs_that_write_one_command_in_a_tick_the_last_counts_with_one_warning() -> None:
    mapped = Mapped()
    for name, command in (("one", AxisCommand.ENABLE), ("two", AxisCommand.DISABLE)):
        mapped.run.cyclic(lambda _run, command=command: setattr(array(mapped)[2], "cmd", command), name=name)
    mapped.run.step(5)
    assert mapped.commands() == [0, AxisCommand.DISABLE, 0]
    assert [one.text for one in mapped.warnings] == [
        "GVL_AXIS.Ctrl[2]: program one and program two write it in the same tick; the last one counts"
    ]


def test_a_program_that_writes_a_command_twice_or_in_another_tick_than_others_is_nobodys_business() -> None:
    mapped = Mapped()

    def work(name: str, tick: int) -> None:
        def write(run: Any) -> None:
            if run.tick == tick:
                array(mapped)[1].cmd = AxisCommand.ENABLE
                array(mapped)[1].cmd = AxisCommand.IDLE

        mapped.run.cyclic(write, name=name)

    work("one", 1)
    work("two", 2)
    mapped.run.step(4)
    assert mapped.warnings == []


@pytest.mark.parametrize("of", ["state.view", "info", "nc_parameter_out"])
def test_a_program_cannot_write_what_the_layer_writes(of: str) -> None:
    rig = Rig()
    shown: Any = attrgetter(of)(rig.x)
    before = bytes(shown)
    with pytest.raises(PermissionError, match=f"{shown.type.name}: this memory is read-only"):
        setattr(shown, shown.type.fields[0].attribute, shown.type.fields[0].type.initial())
    assert bytes(shown) == before


def test_two_clients_in_a_tick_are_named_and_data_may_come_from_both() -> None:
    mapped = Mapped()
    for client in ("client A", "client B"):
        array(mapped).write(0, b"\3\0", client)
        array(mapped, "GVL_AXIS.Data").write(0, bytes(8), client)
    assert [one.text for one in mapped.messages] == [
        "GVL_AXIS.Ctrl[1]: client A and client B write it in the same tick; the last one counts"
    ]
