"""Which commands wait for the windows of the actual position, and what they are told to (function-blocks 2.7)."""

import pytest

from motionlayer import AxisState
from motionlayer.command import ErrorId
from motionlayer.fb import MC_MoveAbsolute, MC_Stop
from motionlayer.nc import AxisCommand, BufferMode
from motionlayer.verify import assert_valid
from tests.machines import error_of, finish, ready, state_of
from tests.nc.servos import ready_servos

WINDOW = {"target_window": 0.05, "target_time": 0.01}


def rests(stop: AxisCommand) -> bool:
    """Return `at_target`; a type checker does not know that it changes between two lines."""
    return stop.at_target


def test_a_move_that_ignores_the_window_is_done_with_its_setpoint() -> None:
    run, (x,) = ready_servos(monitor=WINDOW)
    move = x.move_absolute(100.0, position_monitoring=False)
    finish(run, move)
    assert move.end_time is not None
    assert run.time - move.end_time < 0.0011
    assert not x.in_target
    run.step(2)
    assert_valid(run.trace)


def test_what_follows_such_a_move_begins_without_waiting() -> None:
    run, (x,) = ready_servos(monitor=WINDOW)
    first = x.move_absolute(100.0, position_monitoring=False)
    second = x.move_absolute(50.0, buffer_mode=BufferMode.BUFFERED)
    finish(run, first)
    assert second.active
    finish(run, second)
    assert x.in_target
    run.step(2)
    assert_valid(run.trace)


def test_a_halt_waits_for_the_window_if_it_is_told_to() -> None:
    for waits in (False, True):
        run, (x,) = ready_servos(monitor=WINDOW)
        x.move_absolute(100.0)
        run.step(150)
        halt = x.halt(position_monitoring=waits)
        finish(run, halt)
        assert x.in_target == waits
        assert halt.end_time is not None
        assert (run.time - halt.end_time > 0.02) == waits
        run.step(2)
        assert_valid(run.trace)


@pytest.mark.parametrize("early", [False, True])
def test_a_held_stop_rests_when_the_actual_position_does(early: bool) -> None:
    run, (x,) = ready_servos(monitor=WINDOW)
    x.move_absolute(100.0)
    run.step(150)
    stop = x.stop(hold=True, position_monitoring=True)
    while stop.end_time is None:
        run.step()
    assert not rests(stop)
    if early:
        stop.release()
        run.step(5)
        assert stop.busy
        finish(run, stop)
        assert x.in_target
    else:
        while not rests(stop):
            run.step()
        assert x.in_target
        run.step(100)
        assert (stop.busy, state_of(x)) == (True, AxisState.STOPPING)
        stop.release()
        run.step()
        assert stop.done
    run.step(2)
    assert state_of(x) is AxisState.STANDSTILL
    assert_valid(run.trace)


def test_a_held_stop_stays_although_a_move_before_it_waited_for_its_window() -> None:
    """What the move waited for may come later, and concerns nobody then."""
    run, (x,) = ready_servos(monitor=WINDOW)
    move = x.move_absolute(100.0)
    while not move.at_target:
        run.step()
    stop = x.stop(hold=True)
    run.step(500)
    assert x.in_target
    assert (stop.busy, state_of(x)) == (True, AxisState.STOPPING)
    stop.release()
    run.step(2)
    assert stop.done
    assert_valid(run.trace)


def test_a_halt_that_never_comes_into_its_window_is_an_error() -> None:
    run, (x,) = ready_servos(monitor=WINDOW | {"target_timeout": 0.1}, drive={"backlash": 0.5})
    x.move_absolute(100.0)
    run.step(150)
    halt = x.halt(position_monitoring=True)
    finish(run, halt)
    assert error_of(halt) is ErrorId.TARGET_TIMEOUT
    run.step(2)
    assert_valid(run.trace)


def test_without_a_window_there_is_nothing_to_wait_for() -> None:
    run, x = ready()
    x.move_absolute(100.0)
    run.step(100)
    halt = x.halt(position_monitoring=True)
    finish(run, halt)
    assert halt.done
    run.step(2)
    assert_valid(run.trace)


def test_the_options_of_the_blocks_say_the_same() -> None:
    """IgnorePositionMonitoring of a move, EnableStopPositionMonitoring of MC_Stop, whose Done then waits."""
    run, (x,) = ready_servos(monitor=WINDOW)
    ref = run.axis_refs["X"]
    move, stop = MC_MoveAbsolute(ref), MC_Stop(ref)
    move.Options.IgnorePositionMonitoring = True
    while not move.Done:
        move(Execute=True, Position=100.0, Velocity=500.0)
        run.step()
    assert abs(x.actual_position - 100.0) > 0.05
    move(Execute=False)
    x.move_absolute(0.0)
    while x.set_position > 80.0:
        run.step()
    stop.Options.EnableStopPositionMonitoring = True
    rested = 0
    while not stop.Done:
        stop(Execute=True)
        rested += x.set_velocity == 0.0
        run.step()
        assert run.tick < 3000
    assert rested > 20
    assert x.in_target
    stop(Execute=False)
    run.step(2)
    assert state_of(x) is AxisState.STANDSTILL
    assert_valid(run.trace)
