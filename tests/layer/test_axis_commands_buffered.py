"""The endless jobs MOVE_BUFFER and MOVE_BUFFER_VELO (motion-layer 5.8)."""

import pytest

from motionlayer.command import ErrorId
from motionlayer.event import Level, Subdevice
from motionlayer.layer import AxisCommand, Progress
from motionlayer.layer.types import BufferMode
from tests.layer.rig import Rig, aim, place, shown

C, P = AxisCommand, Progress


def test_d01_move_buffer_begins_and_shows_the_steps_of_its_alternation() -> None:
    rig = Rig().ready()
    aim(rig, 100.0)
    rig.x.options.buffer_mode = BufferMode.BUFFERED
    begin = len(rig.codes[0])
    rig.drop(C.MOVE_BUFFER)
    rig.cycle(20)
    aim(rig, 200.0)
    rig.until(lambda: place(rig) > 110.0)
    aim(rig, 250.0)
    rig.until(lambda: place(rig) == 250.0)
    rig.x.ctrl.progress = P.DONE
    rig.until(lambda: rig.x.state.code == 10030)
    assert list(shown(rig.codes[0][begin:])) == [1030, 3030, 6030, 4030, 3030, 10030]
    assert rig.codes[0].count(4030) == 1
    rig.check()


def test_d01_the_end_of_move_buffer_lets_the_running_move_go_on() -> None:
    rig = Rig().ready()
    aim(rig, 200.0)
    rig.drop(C.MOVE_BUFFER)
    rig.cycle(50)
    rig.x.ctrl.progress = P.DONE
    rig.until(lambda: rig.x.state.code == 10030)
    assert place(rig) < 200.0
    rig.until(lambda: place(rig) == 200.0)
    rig.do(C.NULL)
    assert rig.do(C.MOVE_BUFFER) == [P.INIT, P.DONE], "eProgress has not been set back: nothing begins"
    rig.check()


@pytest.mark.parametrize("mode", list(BufferMode))
def test_move_buffer_joins_by_every_mode(mode: BufferMode) -> None:
    rig = Rig().ready()
    rig.x.options.buffer_mode = mode
    aim(rig, 100.0, 100.0)
    rig.drop(C.MOVE_BUFFER)
    rig.cycle(30)
    aim(rig, 200.0, 150.0)
    speeds = []
    while place(rig) < 200.0:
        speeds += rig.seen(lambda: rig.run.axes["X"].set_velocity, 1)
    rests = min(speeds[200:-200]) < 1.0
    assert rests is (mode is BufferMode.BUFFERED)
    rig.check()


def test_move_buffer_refuses_a_mode_that_there_is_not() -> None:
    rig = Rig().ready()
    aim(rig, 100.0)
    rig.x.options.buffer_mode = 7
    rig.drop(C.MOVE_BUFFER)
    rig.until(lambda: rig.x.state.code == 9030)
    assert rig.x.info.error_id == ErrorId.MODE_INVALID
    assert place(rig) == 0.0
    rig.check()


def test_d11_a_new_position_is_accepted_after_the_move_has_ended() -> None:
    rig = Rig().ready()
    aim(rig, 50.0)
    rig.x.options.buffer_mode = BufferMode.BLENDING_NEXT
    rig.drop(C.MOVE_BUFFER)
    rig.until(lambda: place(rig) == 50.0)
    rig.cycle(20)
    aim(rig, 80.0)
    rig.until(lambda: place(rig) == 80.0)
    rig.check()


def test_d11_other_dynamics_are_accepted_as_well() -> None:
    rig = Rig().ready()
    aim(rig, 300.0, 50.0)
    rig.drop(C.MOVE_BUFFER)
    rig.until(lambda: rig.run.axes["X"].set_velocity == 50.0)
    rig.x.data.velocity = 150.0
    rig.until(lambda: rig.run.axes["X"].set_velocity == 150.0)
    rig.until(lambda: place(rig) == 300.0)
    rig.check()


def test_d11_changes_while_a_move_waits_are_taken_up_when_the_buffer_is_free() -> None:
    rig = Rig().ready()
    rig.x.options.buffer_mode = BufferMode.BUFFERED
    aim(rig, 50.0)
    rig.drop(C.MOVE_BUFFER)
    rig.cycle(5)
    for target in (100.0, 110.0, 120.0):
        aim(rig, target)
        rig.cycle(5)
    rig.until(lambda: place(rig) == 120.0)
    assert rig.x.state.split().command == C.MOVE_BUFFER
    assert rig.x.state.split().progress != P.ERROR
    rig.check()


@pytest.mark.parametrize(
    ("command", "part", "level", "step"),
    [
        (C.MOVE_BUFFER, Subdevice.fbMoveAbsolute1, Level.VERBOSE, "PREPARE"),
        (C.MOVE_BUFFER_VELO, Subdevice.fbMoveVelocity1, Level.ERROR, "WORKING"),
    ],
)
def test_a_motion_that_somebody_else_replaces_is_told_once_and_the_next_one_is_joined(
    command: AxisCommand, part: Subdevice, level: Level, step: str
) -> None:
    rig = Rig().ready()
    rig.x.options.buffer_mode = BufferMode.BUFFERED
    aim(rig, 100.0, 50.0)
    rig.drop(command)
    axis = rig.run.axes["X"]
    rig.until(lambda: axis.set_velocity == 50.0)
    other = axis.move_absolute(-50.0, velocity=200.0)
    rig.cycle(20)
    told = [event.level for event in rig.messages if event.subdevice == part and "aborted" in event.text]
    assert told == [level]
    assert rig.texts(part)[-1] == f"FB aborted: PROGRESS_{step}"
    assert rig.x.state.split() == (command, P[step]), "the job is under way as before"
    aim(rig, 120.0, 60.0)
    rig.until(lambda: other.done)
    rig.until(lambda: axis.set_velocity == 60.0)
    rig.do(C.STOP)
    rig.check()


def test_d12_the_buffered_velocity_follows_direction_and_velocity() -> None:
    rig = Rig().ready()
    aim(rig, 0.0, 50.0, direction=1)
    begin = len(rig.codes[0])
    rig.drop(C.MOVE_BUFFER_VELO)
    axis = rig.run.axes["X"]
    rig.until(lambda: axis.set_velocity == 50.0)
    rig.x.data.velocity = 80.0
    rig.until(lambda: axis.set_velocity == 80.0)
    rig.x.data.direction = 3
    rig.until(lambda: axis.set_velocity == -80.0)
    rig.x.ctrl.progress = P.DONE
    rig.until(lambda: rig.x.state.code == 10031)
    assert list(shown(rig.codes[0][begin:])) == [1031, 7031, 10031]
    assert axis.set_velocity == -80.0, "it keeps running"
    rig.do(C.STOP)
    rig.check()
