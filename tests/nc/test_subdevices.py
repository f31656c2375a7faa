from motionlayer.event import Device, Event, Level, Subdevice
from motionlayer.nc import Axis
from motionlayer.nc._subdevices import SUBDEVICES, axis_device
from tests.machines import finish, ready


def test_every_name_is_that_of_a_method() -> None:
    assert [name for name in SUBDEVICES if not callable(getattr(Axis, name, None))] == []


def test_a_command_without_a_block_of_its_own_belongs_to_the_control_of_the_axis() -> None:
    _, axis = ready()
    assert axis.passes(1.0).part is Subdevice.AxisControl
    assert axis.move_absolute(1.0).part is Subdevice.fbMovePtP


def test_axes_count_from_one_as_far_as_ids_go() -> None:
    assert [axis_device(column) for column in (0, 998, 999, 5999)] == [14_001, 14_999, Device.Axis, Device.Axis]


def test_records_of_an_axis_say_which_axis_and_which_block() -> None:
    run, axis = ready()
    finish(run, axis.move_absolute(10.0))
    axis.move_absolute(1e9)
    assert {event.device for event in run.events.last()} == {axis_device(0)}
    parts = {Subdevice(event.subdevice) for event in run.events.last(Level.WARNING)}
    assert parts == {Subdevice.fbMovePtP}

    def of(part: Subdevice) -> list[Event]:
        return [event for event in run.events.last() if event.subdevice == part]

    assert [event.kind for event in of(Subdevice.fbPower)] == ["accepted", "done"]
