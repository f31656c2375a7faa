"""Commands that the original never ended, ended wrongly, or took with numbers that are none (motion-layer 9.1)."""

import math

import pytest

from motionlayer.command import ErrorId
from motionlayer.drive import Fault
from motionlayer.event import Level, Subdevice
from motionlayer.layer import AxisCommand, Progress
from tests.effort import thinned
from tests.layer.rig import FAILED, SERVO, SIMPLE, Rig, aim, place

C, P = AxisCommand, Progress


def test_d06_enable_ends_in_error_when_the_drive_does_not_follow() -> None:
    rig = Rig(options={"timeout": 0.2}, drive=SERVO["drive"] | {"ready_delay": 1.0})
    assert rig.do(C.ENABLE) == FAILED
    assert (rig.x.info.error, rig.x.info.timeout) == (True, True)
    assert rig.x.info.error_id == ErrorId.DRIVE_NOT_READY
    rig.cycle(2000)
    assert not rig.x.info.enabled, "nobody waits for it any more"
    rig.do(C.NULL)
    assert not rig.x.info.timeout
    rig.check()


def test_d06_disable_ends_in_error_when_it_takes_too_long() -> None:
    rig = Rig(options={"timeout": 0.02}).ready()
    aim(rig, 0.0, 400.0)
    rig.do(C.MOVE_VELO)
    assert rig.do(C.DISABLE) == FAILED
    assert (rig.x.info.error, rig.x.info.timeout) == (True, True)
    rig.until(lambda: not rig.x.info.enabled)
    assert rig.run.axes["X"].set_velocity == 0.0
    rig.check()


def test_d06_a_refusal_of_enable_is_an_error() -> None:
    rig = Rig().ready()
    aim(rig, 0.0, 100.0, deceleration=50.0)
    rig.do(C.MOVE_VELO)
    rig.drop(C.STOP)
    rig.cycle(2)
    assert rig.do(C.ENABLE) == FAILED
    assert rig.x.info.error_id == ErrorId.LOCKED_BY_STOP
    rig.check()


def test_d07_idle_counts_a_failed_reset_as_a_retry() -> None:
    rig = Rig(options={"timeout": 0.05}, **SERVO)
    rig.run.inject("X", Fault("drive_error", duration=5.0), rig.run.tick + 1)
    rig.cycle(3)
    states = rig.do(C.IDLE)
    assert states == [P.INIT, *[P.BUSY, P.PREPARE] * 5, P.BUSY, P.ERROR]
    assert rig.texts(Subdevice.AxisIdle).count("AXIS_IDLE error axis enable: 1") == 6
    assert rig.texts(Subdevice.AxisIdle)[1::2] == [f"AXIS_IDLE retry: {n}" for n in (1, 2, 3, 4, 5)]
    assert rig.x.info.timeout
    rig.check()


@pytest.mark.parametrize("target", [60.0, -60.0])
def test_d08_send_to_pos_is_done_after_its_distance_in_either_direction(target: float) -> None:
    rig = Rig().ready()
    aim(rig, target, 100.0)
    rig.x.options.distance = 20.0
    assert rig.do(C.SEND_TO_POS) == SIMPLE
    assert 20.0 < abs(place(rig)) < 22.0
    rig.until(lambda: place(rig) == target)
    rig.check()


def test_d08_a_move_that_ends_before_the_distance_ends_the_job() -> None:
    rig = Rig().ready()
    aim(rig, 10.0)
    rig.x.options.distance = 20.0
    assert rig.do(C.SEND_TO_POS) == SIMPLE
    assert place(rig) == 10.0
    rig.check()


def test_d08_a_move_that_is_taken_over_ends_the_job_in_error() -> None:
    rig = Rig().ready()
    aim(rig, 300.0)
    rig.x.options.distance = 200.0
    rig.drop(C.SEND_TO_POS)
    rig.cycle(20)
    rig.run.axes["X"].halt()
    rig.until(lambda: rig.x.state.code == 9016)
    rig.check()


@pytest.mark.parametrize("bad", thinned([math.nan, math.inf, -math.inf], 3))
@pytest.mark.parametrize("name", ["position", "velocity", "override", "acceleration", "deceleration", "jerk"])
def test_d16_what_is_not_finite_becomes_0_in_the_data_with_one_warning(name: str, bad: float) -> None:
    rig = Rig().ready()
    setattr(rig.x.data, name, bad)
    rig.cycle(3)
    assert getattr(rig.x.data, name) == 0.0
    assert len([event for event in rig.messages if event.level is Level.WARNING]) == 1


@pytest.mark.parametrize("command", [C.MOVE_POS, C.SEND_TO_POS, C.MOVE_BUFFER])
@pytest.mark.parametrize("bad", thinned([math.nan, math.inf], 2))
def test_d16_a_position_that_is_no_number_is_no_target(command: AxisCommand, bad: float) -> None:
    rig = Rig().ready()
    aim(rig, 50.0)
    rig.do(C.MOVE_POS)
    rig.do(C.NULL)
    aim(rig, bad)
    rig.cycle(2)
    aim(rig, 0.0, 100.0)  # the position still is what the layer has written
    rig.drop(command)
    rig.until(lambda: rig.x.state.split().progress is P.ERROR)
    assert rig.x.info.error_id == ErrorId.TARGET_NOT_FINITE
    assert place(rig) == 50.0
    rig.do(C.NULL)
    rig.drop(command)  # 0.0 was seen, and is asked for again
    rig.until(lambda: place(rig) == 0.0)
    rig.check()


def test_d16_a_buffered_job_that_gets_no_number_ends_in_error_and_its_move_goes_on() -> None:
    rig = Rig().ready()
    aim(rig, 100.0)
    rig.drop(C.MOVE_BUFFER)
    rig.cycle(50)
    rig.x.data.position = math.nan
    rig.until(lambda: rig.x.state.code == C.MOVE_BUFFER + P.ERROR)
    assert rig.x.info.error_id == ErrorId.TARGET_NOT_FINITE
    rig.until(lambda: place(rig) == 100.0)
    rig.cycle(50)
    assert place(rig) == 100.0
    rig.check()


def test_d16_a_position_that_is_written_again_is_a_target() -> None:
    rig = Rig().ready()
    aim(rig, math.nan)
    rig.cycle(2)
    aim(rig, 30.0)
    assert rig.do(C.MOVE_POS) == SIMPLE
    rig.check()


def test_d16_nor_does_a_distance_or_a_homing_or_a_parameter_take_what_is_not_finite() -> None:
    rig = Rig().ready()
    rig.x.options.distance = math.nan
    rig.cycle(2)
    assert rig.x.options.distance == 0.0
    rig.x.home.parameters.position = math.nan
    assert rig.do(C.HOME) == FAILED
    assert rig.x.info.error_id == ErrorId.TARGET_NOT_FINITE
    rig.x.nc_parameter_in.number, rig.x.nc_parameter_in.value = 1004, math.nan
    assert rig.do(C.PARAMETER_WRITE) == FAILED
    rig.check()


@pytest.mark.parametrize("command", [C.MOVE_POS, C.MOVE_VELO, C.SEND_TO_POS, C.MOVE_BUFFER, C.MOVE_BUFFER_VELO])
def test_a_motion_that_an_override_of_0_holds_is_told_once(command: AxisCommand) -> None:
    rig = Rig().ready()
    aim(rig, 20.0, override=0.0)
    rig.drop(command)
    rig.cycle(300)
    told = [one.text for one in rig.messages if one.level is Level.WARNING]
    assert told == ["held by rOverride = 0 %; it begins when rOverride is raised"]
    rig.x.data.override = 100.0
    rig.cycle(300)
    assert place(rig) > 0.0
    assert len([one for one in rig.messages if one.level is Level.WARNING]) == 1
    rig.check()
