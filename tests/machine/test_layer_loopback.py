"""Machines wired to one another: one program on either side, delays, several controllers, what does not fit."""

from collections.abc import Mapping
from typing import Any

import pytest
from tests.machines import LINEAR

from motionlayer import Loopback, Machine, MachineRun, Simulation, Trace, replay
from motionlayer.event import Subdevice
from motionlayer.layer import AxisCommand, LayerError, Progress
from motionlayer.machine import DriveFault
from motionlayer.verify import assert_valid

HEAD: dict[str, Any] = {"format": 1}
DONE = int(Progress.DONE)


def motion(maps: dict[str, Any] | None = None, axes: str = "XYZ", **changes: Any) -> Machine:
    layer = {"map": {"all": {"group": "axis"}} if maps is None else maps}
    return Machine.from_dict(HEAD | {"name": "motion", "axis": dict.fromkeys(axes, LINEAR), "layer": layer} | changes)


def control(*axes: str, **changes: Any) -> Machine:
    return Machine.from_dict(HEAD | {"name": "control", "control": {"axes": list(axes or "XYZ"), **changes}})


async def work(run: MachineRun) -> None:
    """Knows commands and states alone; the same on the motion side and on a control side."""
    layer = run.layer
    await layer.started()
    x, y = layer.axis["X"], layer.axis[2]
    for axis in (x, y):
        axis.ctrl.cmd = AxisCommand.ENABLE
        await axis.state.done(AxisCommand.ENABLE)
        axis.data.position, axis.data.velocity = 60.0, 200.0
        axis.ctrl.cmd = AxisCommand.MOVE_POS
        await axis.state.done(AxisCommand.MOVE_POS)
        assert axis.info.position == pytest.approx(60.0)
    x.ctrl.cmd = AxisCommand.GEAR_IN
    with pytest.raises(LayerError) as caught:
        await x.state.done(AxisCommand.GEAR_IN)
    assert caught.value.state == AxisCommand.GEAR_IN + Progress.NOT_EXIST


def wired() -> tuple[Trace, Trace]:
    """Return the traces of the motion machine and of its control side."""
    with Simulation(motion()) as axes, Simulation(control()) as controller:
        assert Loopback(axes, controller).run(work(controller), time=20.0)
        return axes.trace, controller.trace


def test_one_program_runs_beside_the_layer_and_on_a_control_side() -> None:
    with Simulation(motion({})) as run:
        run.run(work(run), time=20.0)
        direct = run.trace
    there, _ = wired()
    for trace in (direct, there):
        assert_valid(trace)
        assert trace["X.set_position"][-1] == trace["Y.set_position"][-1] == 60.0


def test_wired_machines_do_the_same_each_time_and_each_can_be_replayed_alone() -> None:
    first, second = wired(), wired()
    assert [one.hash for one in first] == [one.hash for one in second]
    again = replay(first[0], [])
    assert again.same, again.difference
    again = replay(first[1], [work])
    assert again.same, again.difference


def test_a_command_is_seen_in_its_own_cycle_and_the_answer_in_the_next_one() -> None:
    with Simulation(motion()) as axes, Simulation(control()) as controller:
        loopback = Loopback(axes, controller)
        loopback.step(60)
        assert axes.layer.ready
        assert controller.layer.ready
        here = controller.layer.axis[3]
        here.ctrl.cmd = AxisCommand.ENABLE
        loopback.step()
        assert axes.layer.axis[3].state.code == AxisCommand.ENABLE + Progress.INIT
        assert here.state.code == AxisCommand.INIT + DONE  # still the answer to what start-up leaves behind
        loopback.step()
        assert here.state.code == AxisCommand.ENABLE + Progress.INIT
        assert_valid(axes.trace)


def test_declared_start_values_of_the_control_side_are_those_of_the_axes() -> None:
    """D52: override and flags of homing come from the partner, not from zeros before it has spoken."""
    with Simulation(motion()) as axes, Simulation(control()) as controller:
        Loopback(axes, controller).step(3)
        assert [axis.data.override for axis in axes.layer.axis] == [100.0] * 3
        assert [axis.data.override for axis in controller.layer.axis] == [100.0] * 3


def test_limit_switches_are_carried_where_both_sides_say_so() -> None:
    maps = {"all": {"group": "axis", "switches": True}}
    with Simulation(motion(maps)) as axes, Simulation(control(switches=True)) as controller:
        loopback = Loopback(axes, controller)
        loopback.step(60)
        controller.layer.axis[2].limit_switches.maximum = True
        loopback.step()
        assert [axis.limit_switches.maximum for axis in axes.layer.axis] == [False, True, False]
    with (
        Simulation(motion()) as axes,
        Simulation(control(switches=True)) as controller,
        pytest.raises(ValueError, match=r"AxisLimitSwitches has no partner MAPPING_AXIS_in\.AxisLimitSwitches"),
    ):
        Loopback(axes, controller)


def test_two_controllers_share_a_motion_machine() -> None:
    maps = {"A": {"group": "axis", "objects": ["Z", "X"]}, "B": {"group": "axis", "objects": [2]}}
    with (
        Simulation(motion(maps)) as axes,
        Simulation(control("Z", "X", selector=False)) as a,
        Simulation(control("Y", selector=False)) as b,
    ):
        loopback = Loopback(axes, {"A": a, "B": b})

        async def enable(run: MachineRun, name: str) -> None:
            await run.layer.started()
            run.layer.axis[name].ctrl.cmd = AxisCommand.ENABLE
            await run.layer.axis[name].state.done(AxisCommand.ENABLE)

        a.start(enable(a, "Z"))
        b.start(enable(b, "Y"))
        assert loopback.run(time=5.0)
        assert [axis.enabled for axis in axes.axes.values()] == [False, True, True]
        assert a.layer.axis["Z"].info.enabled
        assert not a.layer.axis["X"].info.enabled
        assert_valid(axes.trace)


def test_a_control_side_that_stops_in_the_middle_of_a_move_lets_it_go_on() -> None:
    with Simulation(motion()) as axes, Simulation(control()) as controller:
        loopback = Loopback(axes, controller)

        async def begin(run: MachineRun) -> None:
            x = run.layer.axis["X"]
            await run.layer.started()
            x.ctrl.cmd = AxisCommand.ENABLE
            await x.state.done(AxisCommand.ENABLE)
            x.data.position, x.data.velocity = 300.0, 100.0
            x.ctrl.cmd = AxisCommand.MOVE_POS
            await run.sleep(0.5)

        loopback.run(begin(controller))
        assert 0.0 < axes.axes["X"].set_position < 300.0
        axes.step(4000)  # the control machine is not there any more
        assert axes.axes["X"].set_position == 300.0
        assert axes.layer.axis["X"].state.code == AxisCommand.MOVE_POS + DONE
        assert_valid(axes.trace)


def test_an_exception_of_the_program_is_raised_and_time_cuts_off() -> None:
    async def fail() -> None:
        raise LookupError("nothing there")

    async def wait(run: MachineRun) -> None:
        await run.sleep(100.0)

    with Simulation(motion()) as axes, Simulation(control()) as controller:
        loopback = Loopback(axes, controller)
        with pytest.raises(LookupError, match="nothing there"):
            loopback.run(fail())
        assert not loopback.run(wait(controller), time=0.25)
        assert axes.tick == controller.tick
        assert axes.time == pytest.approx(0.25 + 0.001)


def test_reset_machines_are_wired_as_before() -> None:
    """What was carried before the reset is not taken for known after it."""
    with Simulation(motion()) as axes, Simulation(control()) as controller:
        loopback = Loopback(axes, controller)
        shown = []
        for _ in range(2):
            controller.layer.axis[1].ctrl.cmd = AxisCommand.ENABLE
            loopback.step(80)
            shown.append([axis.state.code for axis in controller.layer.axis])
            for run in (axes, controller):
                run.reset()
        assert shown[0] == shown[1] == [AxisCommand.ENABLE + DONE, AxisCommand.INIT + DONE, AxisCommand.INIT + DONE]


def _wrong(described: Mapping[str, Any]) -> Machine:
    return Machine.from_dict(HEAD | {"name": "wrong", **described})


WRONG = [
    (motion({}), control(), ValueError, "control: the image MAPPING_AXIS_out.AxisCtrl has no partner MAPPING_AXIS_in"),
    (
        motion(axes="XY"),
        control(),
        ValueError,
        "AxisCtrl has 12 bytes, its partner MAPPING_AXIS_in.AxisCtrl in motion 8",
    ),
    (
        motion({"all": {"group": "axis", "selector": False}}),
        control(),
        ValueError,
        "SelectorCtrl has no partner MAPPING_AXIS_in.SelectorCtrl in motion",
    ),
    (motion(base_cycle_ns=2_000_000), control(), ValueError, "base_cycle_ns: 2000000 in motion, 1000000 in control"),
    (control(), control(), TypeError, r"control has no motion layer: its machine file needs \[layer\]"),
    (motion(), motion(), TypeError, r"motion is no control side: its machine file needs \[control\]"),
]


@pytest.mark.parametrize(("one", "other", "kind", "text"), WRONG, ids=[text for *_, text in WRONG])
def test_what_does_not_fit_is_refused_before_anything_runs(
    one: Machine, other: Machine, kind: type[Exception], text: str
) -> None:
    with Simulation(one) as axes, Simulation(other) as controller, pytest.raises(kind, match=text):
        Loopback(axes, controller)


def test_a_client_of_the_control_side_writes_commands_and_no_states() -> None:
    """A state is written by the layer, on either side."""
    with Simulation(control()) as controller:
        with pytest.raises(PermissionError, match=r"GVL_AXIS\.State is written by the layer: client can only read it"):
            controller.symbols.write("GVL_AXIS.State[1].eState", 12, "client")
        controller.symbols.write("GVL_AXIS.Ctrl[1].eCmd", 3, "client")
        controller.areas["MAIN_AXIS.eInit"].post(DONE.to_bytes(2, "little"))
        controller.step()
        assert controller.areas["MAPPING_AXIS_out.AxisCtrl"].read()[:2] == b"\3\0"


@pytest.mark.parametrize("up", [Progress.DONE, Progress.ERROR])
def test_nothing_is_given_out_before_the_start_up_over_there_has_ended(up: Progress) -> None:
    """An image of zeros would be an override of 0 %; a start-up that has failed waits for a command."""
    with Simulation(control()) as controller:
        controller.step(3)
        data = controller.areas["MAPPING_AXIS_out.AxisMoveData"]
        assert not any(data.read())
        controller.areas["MAIN_AXIS.eInit"].post(int(Progress.STARTUP).to_bytes(2, "little"))
        controller.step()
        assert not any(data.read())
        controller.areas["MAIN_AXIS.eInit"].post(int(up).to_bytes(2, "little"))
        controller.step()
        assert controller.layer.symbols.read("GVL_AXIS.Data[1].rOverride") == 100.0
        assert any(data.read())


def test_the_start_up_and_what_follows_are_those_of_a_program_beside_the_layer() -> None:
    def told(trace: Trace) -> list[tuple[str, str]]:
        return [(one.source, one.text) for one in trace.events if one.subdevice == Subdevice.AxisControl]

    with Simulation(motion({})) as run:
        run.run(work(run), time=20.0)
        direct = told(run.trace)
    there = told(wired()[0])
    assert there == direct
    assert len(direct) > 20


def test_a_controller_that_comes_while_axes_move_does_not_disturb_them() -> None:
    with Simulation(motion()) as axes:
        axes.step(60)
        axes.axes["X"].enable()
        axes.step(30)
        axes.axes["X"].move_absolute(60.0)
        axes.step(20)
        assert 0.0 < axes.axes["X"].set_position < 60.0
        with Simulation(control()) as controller:
            loopback = Loopback(axes, controller)
            loopback.step(10)
            assert controller.layer.axis["X"].state.code == AxisCommand.INIT + DONE
            loopback.step(2000)
        assert axes.axes["X"].set_position == 60.0
        trace = axes.trace
    assert_valid(trace)
    speeds = trace["X.set_velocity"]
    moving = (speeds != 0.0).nonzero()[0]
    assert len(moving) == moving[-1] - moving[0] + 1


def test_a_controller_lets_a_simulated_drive_fail_by_its_images() -> None:
    servo = LINEAR | {"drive": {"kind": "servo", "position_gain": 60.0}}
    described = motion({"A": {"group": "axis", "objects": ["Y"]}}, axis={"X": LINEAR, "Y": servo})
    with Simulation(described) as axes, Simulation(control("Y", selector=False)) as controller:
        loopback = Loopback(axes, {"A": controller})
        loopback.step(60)
        controller.symbols.write("GVL_SIMULATION.DriveFault[1].eFault", DriveFault.DRIVE_ERROR, "client")
        loopback.step(4)
        assert controller.layer.axis["Y"].info.error
        assert axes.axes["Y"].error is not None
        assert axes.axes["X"].error is None
        axes.symbols.write("GVL_SIMULATION.DriveFault[2].eFault", DriveFault.NONE, "another client")
