"""The parameter selector works beside the command fields (motion-layer 5.12)."""

import pytest

from motionlayer.event import Device, Subdevice
from motionlayer.layer import AxisCommand, Progress
from motionlayer.layer.types import AxisSelector
from tests.layer.rig import Rig, shown

C, P = AxisCommand, Progress


def ask(
    rig: Rig, command: int, axis: int, number: int = 1004, value: float = 0.0, by: int = AxisSelector.INDEX
) -> None:
    """Drop a command into the selector."""
    ctrl = rig.layer.globals.axis.selector_ctrl.value
    ctrl.selector, ctrl.axis, ctrl.data.number, ctrl.data.value = by, axis, number, value
    ctrl.control.cmd = command


def states(rig: Rig, ticks: int = 6) -> list[int]:
    """Run cycles, and return what its state has shown."""
    state, seen = rig.layer.globals.axis.selector_state.value, []
    for _ in range(ticks):
        rig.cycle()
        seen.append(int(state.state.state))
    return list(shown(seen))


@pytest.mark.parametrize("by", list(AxisSelector))
def test_it_reads_a_parameter_of_the_axis_that_is_named(by: AxisSelector) -> None:
    rig = Rig(3)
    rig.layer.axis[2].nc_parameter_in.number, rig.layer.axis[2].nc_parameter_in.value = 1004, 1500.0
    rig.do(C.PARAMETER_WRITE, 2)
    ask(rig, C.PARAMETER_READ, 2, by=by)
    assert states(rig) == [1040, 6040, 7040, 10040]
    shows = rig.layer.globals.axis.selector_state.value
    assert (shows.axis_index, shows.axis_id, shows.info.number, shows.info.value) == (2, 2, 1004, 1500.0)


@pytest.mark.parametrize("command", [C.PARAMETER_WRITE, C.PARAMETER_READ])
def test_number_and_value_are_latched(command: AxisCommand) -> None:
    rig = Rig(2)
    ask(rig, command, 1, value=1800.0)
    rig.cycle()
    ctrl = rig.layer.globals.axis.selector_ctrl.value
    ctrl.axis, ctrl.data.number, ctrl.data.value = 2, 1005, 1.0
    rig.cycle(6)
    written = [axis.config.default.acceleration for axis in rig.run.axes.values()]
    assert written == [1800.0 if command is C.PARAMETER_WRITE else 5000.0, 5000.0]
    assert rig.layer.globals.axis.selector_state.value.state.state == 10000 + command


@pytest.mark.parametrize(("by", "axis", "index"), [(0, 0, 0), (0, 3, 3), (1, 0, 0), (1, 3, 0), (2, 1, 0)])
def test_an_axis_that_there_is_not_is_an_error_without_a_number(by: int, axis: int, index: int) -> None:
    rig = Rig(2)
    ask(rig, C.PARAMETER_READ, axis, by=by)
    assert states(rig) == [9000]
    shows = rig.layer.globals.axis.selector_state.value
    assert (shows.axis_index, shows.axis_id) == (index, 0)


@pytest.mark.parametrize("command", [C.NULL, C.ENABLE, C.MOVE_POS, 4711])
def test_other_commands_show_0_and_do_nothing(command: int) -> None:
    rig = Rig()
    ask(rig, C.PARAMETER_READ, 1)
    states(rig)
    ask(rig, command, 1)
    assert states(rig) == [0]
    assert not rig.x.info.enabled


def test_it_works_before_the_axes_are_initialised() -> None:
    rig = Rig(up=False)
    ask(rig, C.PARAMETER_READ, 1)
    assert states(rig)[-1] == 10040


def test_d15_selector_and_command_field_read_different_parameters_of_one_axis_at_once() -> None:
    rig = Rig()
    rig.x.nc_parameter_in.number = 1051
    ask(rig, C.PARAMETER_READ, 1, number=1004)
    rig.drop(C.PARAMETER_READ)
    rig.cycle(5)
    shows = rig.layer.globals.axis.selector_state.value
    assert (rig.x.state.code, shows.state.state) == (10040, 10040)
    assert (rig.x.nc_parameter_out.number, rig.x.nc_parameter_out.value) == (1051, 0.001)
    assert (shows.info.number, shows.info.value) == (1004, 5000.0)


def test_d15_interfaces_of_one_axis_do_not_disturb_each_other() -> None:
    rig = Rig()
    one, two = rig.layer.interface(1), rig.layer.interface(1)
    for interface, number in ((one, 1051), (two, 1004)):
        assert interface.read_parameter(number, execute=False) is P.INIT
    results = []
    for _ in range(4):
        results.append((one.read_parameter(1051, execute=True), two.read_parameter(1004, execute=True)))
        assert one.enable(execute=not results[1:]) in (P.INIT, P.OCCUPIED)
        rig.cycle()
    assert results == [(P.OCCUPIED,) * 2, (P.WORKING,) * 2, (P.DONE,) * 2, (P.DONE,) * 2]
    assert (one.read_parameter_value, two.read_parameter_value) == (0.001, 5000.0)


def test_an_interface_brakes_and_switches() -> None:
    rig = Rig().ready()
    rig.run.axes["X"].move_velocity(100.0)
    rig.cycle(100)
    mine = rig.layer.interface(1)
    assert mine.halt(200.0, execute=False) is P.INIT
    rig.until(lambda: mine.halt(200.0, execute=True) is P.DONE)
    assert rig.run.axes["X"].set_velocity == 0.0
    assert mine.disable(execute=False) is P.INIT
    rig.until(lambda: mine.disable(execute=True) is P.DONE)
    assert not rig.x.info.enabled
    assert mine.position == rig.run.axes["X"].actual_position
    rig.check()


def test_it_says_what_it_does_under_its_own_device() -> None:
    rig = Rig(2)
    rig.messages.clear()
    ask(rig, C.PARAMETER_READ, 2)
    states(rig)
    told = [one for one in rig.messages if one.device == Device.Device_ParameterSelector]
    assert [(one.text, one.code, one.subdevice) for one in told] == [
        ("new command: E_AXIS_CTRL.AXIS_PARAMETER_READ", 2, Subdevice.General),
        *[
            (f"E_AXIS_CTRL.AXIS_PARAMETER_READ: E_PROGRESS.PROGRESS_{name}", 2, Subdevice.General)
            for name in ("OCCUPIED", "WORKING", "DONE")
        ],
    ]
