"""The state of an object in every cycle: motion-layer 5.1 to 5.3 are the oracle."""

import pytest

from motionlayer.command import ErrorId
from motionlayer.event import Level, Subdevice
from motionlayer.layer import AXIS_JOBS, Answer, AxisCommand, Progress, split
from tests.layer.rig import Rig, shown

C, P = AxisCommand, Progress


def test_the_answer_comes_in_the_cycle_that_sees_the_command() -> None:
    rig = Rig().ready()
    rig.x.data.position, rig.x.data.velocity = 30.0, 100.0
    assert rig.drop(C.MOVE_POS) == 1012
    move = rig.run.axes["X"].command
    assert move is not None, "the job has been called in the same cycle"
    rig.cycle()
    assert rig.x.state.code == 6012
    rig.until(lambda: move.done)
    ended = rig.run.tick
    rig.until(lambda: rig.x.state.code == 10012)
    assert rig.run.tick == ended + 2, "seen done by the next call, published one later"
    rig.check()


def test_the_progress_published_is_that_of_the_call_before() -> None:
    rig = Rig().ready()
    rig.x.nc_parameter_in.number = 1051
    assert rig.drop(C.PARAMETER_READ) == 1040
    assert rig.seen(lambda: rig.x.state.code, 4) == [6040, 7040, 10040, 10040]


def test_a_final_state_is_not_worked_on() -> None:
    rig = Rig().ready()
    rig.do(C.RESET)
    job = rig.layer._axes.controllers[0].memory
    job.since = -1
    rig.cycle(10)
    assert job.since == -1
    assert rig.layer._axes._active == []


def test_null_repeats_a_command_and_moves_nothing() -> None:
    rig = Rig().ready()
    rig.x.data.position, rig.x.data.velocity = 300.0, 100.0
    rig.drop(C.MOVE_POS)
    rig.cycle(50)
    assert rig.drop(C.NULL) == 10000
    move = rig.run.axes["X"].command
    assert move is not None
    assert move.busy, "the axis goes on"
    assert rig.drop(C.MOVE_POS) == 1012
    rig.until(lambda: rig.x.state.code == 10012)
    assert rig.run.axes["X"].set_position == 300.0
    rig.check()


def test_a_command_replaces_the_running_one() -> None:
    rig = Rig().ready()
    rig.x.data.position, rig.x.data.velocity = 300.0, 100.0
    rig.drop(C.MOVE_POS)
    rig.cycle(100)
    assert rig.do(C.HALT) == [P.INIT, P.OCCUPIED, P.DONE]
    assert 0.0 < rig.run.axes["X"].set_position < 300.0
    rig.check()


def test_a_command_that_changes_in_every_cycle_is_answered_in_every_cycle() -> None:
    rig = Rig().ready()
    rig.x.data.position, rig.x.data.velocity = 50.0, 100.0
    for command in (C.MOVE_POS, C.HALT, C.MOVE_VELO, C.RESET, C.STOP, C.NULL) * 5:
        assert rig.drop(command) == (10000 if command is C.NULL else 1000 + command)
    rig.do(C.STOP)
    rig.check()


def test_the_command_of_one_axis_does_not_touch_another_one() -> None:
    rig = Rig(3).ready()
    rig.layer.axis["Y"].data.velocity = 100.0
    rig.layer.axis["Y"].data.position = 20.0
    before = rig.x.state.code, rig.layer.axis[3].state.code
    rig.do(C.MOVE_POS, 2)
    assert (rig.x.state.code, rig.layer.axis[3].state.code) == before
    assert [axis.set_position for axis in rig.run.axes.values()] == [0.0, 20.0, 0.0]
    rig.check()


def test_d65_an_unknown_command_is_told_with_its_number_and_sets_the_error() -> None:
    rig = Rig().ready()
    assert rig.drop(4) == 9004
    assert (rig.x.info.error, rig.x.info.ready) == (True, False)
    assert rig.drop(999) == 9999
    assert rig.drop(1000) == 9000
    assert rig.drop(65535) == 9000
    assert [text for text in rig.texts(Subdevice.AxisControl) if "INVALID" in text] == [
        f"E_AXIS_CTRL.{number}: PROGRESS_INVALID" for number in (4, 999, 1000, 65535)
    ]
    rig.cycle(20)
    assert rig.run.axes["X"].command is None
    rig.check()


def test_d65_a_command_of_another_object_does_not_exist_here() -> None:
    rig = Rig().ready()
    others = [one for one in AxisCommand if one not in AXIS_JOBS and one is not C.NULL]
    assert len(others) == 16
    for command in others:
        assert rig.drop(command) == 100 + command
        assert (rig.x.info.error, rig.x.info.error_id) == (True, ErrorId.FUNCTION_UNSUPPORTED)
        assert rig.x.state.split() == Answer(command, P.NOT_EXIST)
    rig.check()


def test_a_command_before_init_is_refused() -> None:
    rig = Rig(2, up=False)
    rig.layer.axis[2].data.velocity = 10.0
    rig.layer.axis[2].data.position = 10.0
    assert rig.drop(C.MOVE_POS, 2) == 1009
    rig.cycle()
    assert (rig.layer.axis[2].state.code, rig.layer.axis[2].info.error) == (9009, True)
    rig.check()


def test_a_new_command_clears_the_state_and_reset_the_error() -> None:
    rig = Rig().ready()
    rig.x.data.position, rig.x.data.velocity = 1e9, 100.0
    assert rig.do(C.MOVE_POS)[-1] == P.ERROR
    assert (rig.x.info.error, rig.x.info.error_id) == (True, 0x4222)
    rig.do(C.NULL)
    assert (rig.x.info.error, rig.x.info.error_id) == (True, 0)
    rig.drop(C.RESET)
    assert not rig.x.info.error, "cleared when the command is dropped"
    rig.check()


@pytest.mark.parametrize("command", [C.IDLE, C.INIT])
def test_d14_idle_and_init_clear_the_error_too(command: AxisCommand) -> None:
    rig = Rig().ready()
    rig.do(C.GEAR_IN)
    assert rig.x.info.error
    assert rig.do(command)[-1] == P.DONE
    assert not rig.x.info.error


def test_d14_the_number_of_an_error_comes_with_its_state() -> None:
    rig = Rig().ready()
    rig.x.data.position, rig.x.data.velocity = 1e9, 100.0
    rig.drop(C.MOVE_POS)
    numbers = rig.seen(lambda: (rig.x.state.code, rig.x.info.error_id), 3)
    assert numbers == [(6012, 0), (9012, 0x4222), (9012, 0x4222)]


def test_d61_a_state_of_command_null_is_command_null() -> None:
    assert split(10000) == (C.NULL, P.DONE)
    assert split(150) == (C.GEAR_IN, P.NOT_EXIST)
    assert split(9009) == (9, P.ERROR)


@pytest.mark.parametrize("progress", [one for one in Progress if one is not Progress.INVALID])
@pytest.mark.parametrize("command", [C.NULL, C.INIT, C.MOVE_POS, C.FLY_GEAR_IN_VELO])
def test_every_state_splits_into_what_it_was_made_of(command: AxisCommand, progress: Progress) -> None:
    assert split(command + progress) == (command, progress)


def test_the_log_tells_the_command_and_every_progress() -> None:
    rig = Rig()
    rig.messages.clear()
    rig.do(C.ENABLE)
    lines = [
        (event.level, event.text, event.code) for event in rig.messages if event.subdevice == Subdevice.AxisControl
    ]
    assert lines == [
        (Level.INFO, "new command: E_AXIS_CTRL.AXIS_ENABLE", 1),
        (Level.INFO, "E_AXIS_CTRL.AXIS_ENABLE: PROGRESS_OCCUPIED", 1),
        (Level.INFO, "E_AXIS_CTRL.AXIS_ENABLE: PROGRESS_DONE", 1),
    ]


def test_programs_wait_for_a_state() -> None:
    rig = Rig(2)

    async def program() -> None:
        await rig.layer.started()
        for one in rig.layer.axis:
            one.ctrl.cmd = C.ENABLE
            assert await one.state.done(C.ENABLE) == 10003
        rig.x.data.position, rig.x.data.velocity = 40.0, 100.0
        rig.x.ctrl.cmd = C.MOVE_POS
        match (await rig.x.state.done(C.MOVE_POS), rig.x.state.split()):
            case 10012, (C.MOVE_POS, P.DONE):
                pass
            case other:
                raise AssertionError(other)

    rig.run.run(program(), time=5.0)
    assert rig.run.axes["X"].set_position == 40.0
    rig.check()


def test_the_states_shown_are_those_of_the_table() -> None:
    rig = Rig().ready()
    assert list(shown(rig.codes[0])) == [9000, 1001, 4001, 3001, 10001, 1003, 6003, 10003]
