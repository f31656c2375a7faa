"""Commands of an axis, one after the other: what each shows, and what it moves (motion-layer 5.5)."""

import pytest

from motionlayer.command import ErrorId
from motionlayer.drive import Fault
from motionlayer.event import Level, Subdevice
from motionlayer.layer import AxisCommand, Progress
from tests.layer.rig import FAILED, SERVO, SIMPLE, Rig, aim, place

C, P = AxisCommand, Progress


@pytest.mark.parametrize("command", [C.ENABLE, C.RESET, C.HALT, C.STOP, C.DISABLE, C.HOME])
def test_at_rest_a_command_shows_its_steps_and_is_done(command: AxisCommand) -> None:
    rig = Rig().ready()
    rig.do(C.NULL)
    assert rig.do(command) == SIMPLE
    rig.check()


def test_idle_clears_errors_and_switches_on() -> None:
    rig = Rig(**SERVO)
    rig.run.inject("X", Fault("drive_error"), rig.run.tick + 1)
    rig.cycle(3)
    assert rig.x.info.error
    assert rig.do(C.IDLE) == [P.INIT, P.BUSY, P.CHECK, P.DONE]
    assert (rig.x.info.error, rig.x.info.enabled, rig.x.info.ready) == (False, True, True)
    rig.check()


def test_enable_clears_an_error_first() -> None:
    rig = Rig(**SERVO).ready()
    rig.run.inject("X", Fault("drive_error"), rig.run.tick + 1)
    rig.cycle(20)
    rig.do(C.NULL)
    assert rig.do(C.ENABLE) == SIMPLE
    assert "clear error on enable : PROGRESS_INIT" in rig.texts(Subdevice.fbPower)
    assert rig.x.info.ready
    rig.check()


def test_disable_takes_the_power_away() -> None:
    rig = Rig().ready()
    rig.do(C.DISABLE)
    assert not rig.x.info.enabled
    aim(rig, 10.0)
    assert rig.do(C.MOVE_POS) == FAILED
    assert rig.x.info.error_id == ErrorId.NOT_ENABLED
    rig.check()


def test_move_pos_comes_to_its_target() -> None:
    rig = Rig().ready()
    aim(rig, 120.0)
    assert rig.do(C.MOVE_POS) == SIMPLE
    assert place(rig) == 120.0
    assert rig.texts(Subdevice.fbMovePtP) == [" : 120.0", "FB active: PROGRESS_OCCUPIED", " : PROGRESS_DONE"]
    rig.check()


def test_the_dynamics_are_those_of_the_data_and_0_those_of_the_machine_file() -> None:
    times = []
    for acceleration in (0.0, 100.0):
        rig = Rig().ready()
        aim(rig, 120.0, acceleration=acceleration, deceleration=acceleration)
        begin = rig.run.tick
        rig.do(C.MOVE_POS)
        times.append(rig.run.tick - begin)
        rig.check()
    assert times[1] > 3 * times[0]


@pytest.mark.parametrize("direction", [0, 1, 3, -1])
def test_d12_move_velo_goes_in_the_direction_that_was_asked_for(direction: int) -> None:
    rig = Rig().ready()
    aim(rig, 0.0, 50.0, direction=direction)
    assert rig.do(C.MOVE_VELO) == SIMPLE
    assert rig.run.axes["X"].set_velocity == (50.0 if direction in (0, 1) else -50.0)
    rig.do(C.HALT)
    rig.check()


def test_move_velo_refuses_a_direction_that_there_is_not() -> None:
    rig = Rig().ready()
    aim(rig, 0.0, 50.0, direction=2)
    assert rig.do(C.MOVE_VELO) == FAILED
    rig.cycle(10)
    assert place(rig) == 0.0
    rig.check()


@pytest.mark.parametrize("brake", [C.HALT, C.STOP])
def test_a_brake_is_done_at_rest(brake: AxisCommand) -> None:
    rig = Rig().ready()
    aim(rig, 0.0, 100.0)
    rig.do(C.MOVE_VELO)
    assert rig.do(brake) == SIMPLE
    assert rig.run.axes["X"].set_velocity == 0.0
    assert rig.x.info.standstill
    rig.check()


def test_stop_locks_the_axis_until_it_rests() -> None:
    rig = Rig().ready()
    aim(rig, 300.0, 100.0, deceleration=50.0)
    rig.do(C.MOVE_VELO)
    rig.drop(C.STOP)
    rig.cycle(3)
    assert rig.do(C.MOVE_POS)[-1] == P.ERROR
    assert rig.x.info.error_id == ErrorId.LOCKED_BY_STOP
    rig.until(lambda: rig.run.axes["X"].command is None)
    rig.do(C.NULL)
    assert rig.do(C.MOVE_POS) == SIMPLE
    rig.check()


def test_a_move_that_somebody_else_takes_over_ends_in_error_0() -> None:
    rig = Rig().ready()
    aim(rig, 300.0)
    rig.drop(C.MOVE_POS)
    rig.cycle(50)
    rig.run.axes["X"].halt()
    rig.until(lambda: rig.x.state.code == 9012)
    assert (rig.x.info.error, rig.x.info.error_id) == (True, 0)
    assert "FB aborted : PROGRESS_ERROR" in rig.texts(Subdevice.fbMovePtP)
    rig.check()


def test_a_halt_that_is_taken_over_begins_again() -> None:
    rig = Rig().ready()
    aim(rig, 300.0, 100.0, deceleration=100.0)
    rig.do(C.MOVE_VELO)
    rig.drop(C.HALT)
    rig.cycle(5)
    rig.run.axes["X"].move_velocity(100.0)
    rig.until(lambda: rig.x.state.code == 10014)
    assert "command aborted : PROGRESS_BUSY" in rig.texts(Subdevice.fbHalt)
    assert rig.run.axes["X"].set_velocity == 0.0
    rig.check()


def test_the_override_holds_in_every_cycle() -> None:
    rig = Rig().ready()
    aim(rig, 0.0, 100.0)
    rig.do(C.MOVE_VELO)
    rig.x.data.override = 50.0
    rig.cycle(200)
    assert rig.run.axes["X"].set_velocity == 50.0
    rig.x.data.override = 0.0
    rig.cycle(200)
    assert rig.run.axes["X"].set_velocity == 0.0
    rig.x.data.override = 100.0
    rig.cycle(200)
    assert rig.run.axes["X"].set_velocity == 100.0
    rig.do(C.STOP)
    rig.check()


@pytest.mark.parametrize(("asked", "holds"), [(150.0, 1.0), (-1.0, 0.0)])
def test_an_override_outside_of_0_to_100_is_clamped_with_one_warning(asked: float, holds: float) -> None:
    rig = Rig().ready()
    rig.x.data.override = asked
    rig.cycle(5)
    assert rig.run.axes["X"].override == holds
    assert [event.text for event in rig.messages if event.level is Level.WARNING] == [
        f"rOverride = {asked} %, allowed: 0 to 100; {100 * holds} holds"
    ]


def test_a_drive_fault_ends_a_move_with_its_number() -> None:
    rig = Rig(**SERVO).ready()
    aim(rig, 300.0)
    rig.drop(C.MOVE_POS)
    rig.run.inject("X", Fault("drive_error"), rig.run.tick + 50)
    rig.until(lambda: rig.x.state.code == 9012)
    assert rig.x.info.error_id == ErrorId.DRIVE_NOT_READY
    assert rig.do(C.IDLE)[-1] == P.DONE
    rig.check()
