"""The layer as a whole: order of a cycle, schedule, objects, diagrams, what is no layer."""

from typing import Any

import pytest

from motionlayer import Machine, Simulation, all_of
from motionlayer.layer import (
    AXIS_JOBS,
    START_UP,
    Absent,
    AbsentChannel,
    AxisCommand,
    I_Cam_Ctrl,
    I_Fly_Ctrl,
    I_McAxis,
    I_Nci_Ctrl,
    I_NciChannel,
    I_TouchProbe,
    I_TriggerBox,
    JobTable,
    LayerError,
    LayerOptions,
    MotionLayer,
    Progress,
    Schedule,
    Sizes,
    mermaid,
)
from tests.layer.rig import Rig
from tests.machines import LINEAR

C, P = AxisCommand, Progress


def test_a_cycle_calls_the_programs_in_their_order() -> None:
    rig = Rig(up=False)
    order = ["MAPPING_in", "programs", "MAIN", "FUNCTIONS", "NCI", "CAM", "FLYING_SAW", "MAPPING_out"]
    assert [stage.name for stage in rig.run._stages if stage.name in order] == order


@pytest.mark.parametrize(("divisor", "phase"), [(1, 0), (4, 0), (4, 3)])
def test_a_namespace_is_called_at_its_divisor_and_phase(divisor: int, phase: int) -> None:
    rig = Rig(options={"divisor": {"axis": divisor}, "phase": {"axis": phase}})
    rig.cycle(-rig.run.tick % divisor)
    rig.x.ctrl.cmd = C.ENABLE
    codes = []
    for _ in range(2 * divisor):
        rig.cycle()
        codes.append(rig.x.state.code)
    assert codes == [10001] * phase + [1003] * divisor + [6003] * (divisor - phase)
    rig.until(lambda: rig.x.state.code == 10003)
    rig.x.data.position, rig.x.data.velocity = 30.0, 100.0
    assert rig.do(C.MOVE_POS) == [P.INIT, P.OCCUPIED, P.DONE] or divisor > 1
    rig.until(lambda: rig.x.state.code == 10012)
    rig.check()


def test_what_is_no_schedule_is_refused() -> None:
    with pytest.raises(ValueError, match="divisor 2, phase 2: allowed are"):
        Schedule(2, 2)
    with pytest.raises(ValueError, match="no namespace 'cams' to schedule"):
        LayerOptions(Sizes(1), schedule={"cams": Schedule()})


def test_objects_are_found_by_index_and_by_name() -> None:
    rig = Rig(3, up=False)
    axis = rig.layer.axis
    assert axis[2] is axis["Y"]
    assert [one.name for one in axis] == ["X", "Y", "Z"]
    for bad in (0, 4, -1):
        with pytest.raises(IndexError, match="indices go from 1 to 3"):
            axis[bad]
    with pytest.raises(KeyError, match="did you mean 'X'"):
        axis["x"]
    with pytest.raises(KeyError, match="did you mean 'Y'"):
        axis["Yy"]


def test_as_many_axes_as_the_sizes_say() -> None:
    run = Simulation(Machine.from_dict({"format": 1, "name": "one", "axis": {"X": LINEAR}}))
    refs = list(run.axis_refs.values())
    with pytest.raises(ValueError, match=r"1 axes, and sizes.max_axis = 2"):
        MotionLayer(refs, run._stage.images, run.events, run._ledger, LayerOptions(Sizes(2)))


def test_a_wait_ends_with_what_has_become_of_the_command() -> None:
    rig = Rig().ready()
    rig.x.data.velocity, rig.x.data.position = 100.0, 1e9
    texts = []

    async def program() -> None:
        for command, replace in ((C.MOVE_POS, False), (C.GEAR_IN, False), (C.HOME, True), (471, False)):
            rig.x.ctrl.cmd = command
            wait = rig.x.state.done(command)
            if replace:
                rig.x.ctrl.cmd = C.NULL
            try:
                await wait
            except LayerError as error:
                texts.append(str(error))

    rig.run.run(program(), time=1.0)
    assert texts == [
        "X: MOVE_POS: the state is 9012, PROGRESS_ERROR; error 0x4222, target outside the software limits",
        "X: GEAR_IN: the state is 150, PROGRESS_NOT_EXIST; error 0x4251, function not supported",
        "X: HOME: another command has taken its place, the state is 10000",
        "X: 471: the state is 9471, PROGRESS_ERROR; error 0x4251, function not supported",
    ]
    with pytest.raises(ValueError, match="no state tells of command 4711; allowed: 0 to 999"):
        rig.x.state.done(4711)


def test_waits_for_several_axes_are_commands() -> None:
    rig = Rig(3)

    async def program() -> None:
        for one in rig.layer.axis:
            one.ctrl.cmd = C.ENABLE
        assert await all_of(*[one.state.done(C.ENABLE) for one in rig.layer.axis]) == (10003,) * 3

    rig.run.run(program(), time=1.0)


def test_d51_what_has_no_image_is_written_by_symbol_beside_a_map_of_all() -> None:
    rig = Rig(options={"map": {"all": {"group": "axis"}}})
    assert not [name for name in rig.run.areas if "Switches" in name]
    rig.run.symbols.write("GVL_AXIS.LimitSwitches[1].bMinimum", True, by="a client")
    assert rig.x.limit_switches.minimum
    with pytest.raises(PermissionError, match="belongs to the image"):
        rig.run.symbols.write("GVL_AXIS.Ctrl[1].eCmd", C.ENABLE, by="a client")


def test_what_is_not_built_in_answers_by_the_same_interfaces() -> None:
    nothing, channel = Absent(), AbsentChannel()
    controllers: list[I_Nci_Ctrl | I_Cam_Ctrl | I_Fly_Ctrl | I_TouchProbe | I_TriggerBox] = [nothing]
    channels: list[I_NciChannel] = [channel]
    assert [one.call() for one in controllers] == [P.NOT_EXIST]
    assert [one.start(execute=True) for one in channels] == [P.NOT_EXIST]
    assert channel.load("a.nc", execute=False) is channel.stop(execute=True) is P.NOT_EXIST
    axis: I_McAxis = Rig(up=False).layer.interface(1)
    assert axis.axis_ref.axis.name == "X"


@pytest.mark.parametrize("job", [*AXIS_JOBS.values(), START_UP], ids=lambda job: job.name)
def test_every_job_is_drawn_from_its_table(job: JobTable[Any]) -> None:
    lines = mermaid(job).splitlines()
    arrows = {line.partition(" : ")[0].strip() for line in lines if "-->" in line and "[*]" not in line}
    assert arrows == {f"{row.step.name} --> {row.next.name}" for row in job.rows if row.next is not row.step}
    assert f"    [*] --> {job.first.name}" in lines
