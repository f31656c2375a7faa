"""Velocity lag and motion monitoring (function-blocks 3.7)."""

import numpy as np
import pytest

from motionlayer import AxisState, Fault
from motionlayer.command import ErrorId
from motionlayer.nc import OpModeDWord
from motionlayer.verify import assert_valid
from tests.machines import error_of, finish, ready, state_of
from tests.nc.servos import ready_servos


def test_an_ideal_drive_has_no_velocity_lag() -> None:
    run, x = ready(monitor={"velocity_lag": 1e-12})
    finish(run, x.move_absolute(300.0))
    run.step(2)
    assert x.error is None
    assert_valid(run.trace)


@pytest.mark.parametrize("filter_ticks", [0, 1, 7, 30])
def test_too_much_velocity_lag_for_longer_than_the_filter_time_is_an_error(filter_ticks: int) -> None:
    limit = 40.0
    monitor = {"velocity_lag": limit, "velocity_lag_time": filter_ticks * 0.001}
    run, (x,) = ready_servos(monitor=monitor)
    move = x.move_absolute(300.0)
    while move.busy:
        run.step()
    assert error_of(move) is ErrorId.VELOCITY_LAG
    assert x.error is not None
    assert "velocity lag = " in str(x.error)
    assert "allowed: 40.0 mm/s" in str(x.error)
    assert state_of(x) is AxisState.ERRORSTOP
    found = run.tick - 1
    run.step()
    assert not x.enabled
    run.step(300)
    trace = run.trace
    over = np.abs(np.diff(trace["X.lag"]))[:found] > limit * 0.001
    assert over[-1]
    assert over[::-1].argmin() == max(filter_ticks, 1) + 1
    assert_valid(trace)


def test_velocity_lag_that_comes_back_in_time_is_none() -> None:
    """Lag of velocity there is only while the axis accelerates; at constant velocity the position lag is constant."""
    run, (x,) = ready_servos(monitor={"velocity_lag": 60.0, "velocity_lag_time": 0.1})
    finish(run, x.move_absolute(300.0, acceleration=2500.0, deceleration=2500.0))
    assert x.error is None
    run.step(2)
    assert_valid(run.trace)


def test_a_redefined_position_is_no_velocity_lag() -> None:
    run, (x,) = ready_servos(monitor={"velocity_lag": 10.0, "velocity_lag_time": 0.0}, drive={"backlash": 0.5})
    finish(run, x.move_absolute(20.0, velocity=5.0), 20_000)
    run.step(300)
    assert x.lag != 0.0
    x.define_position(100.0, clear_lag=True)
    x.define_position(7.0, relative=True)
    run.step(300)
    assert x.error is None
    assert_valid(run.trace)


@pytest.mark.parametrize("time", [0.001, 0.02, 0.1])
def test_an_axis_that_does_not_move_though_it_should_is_in_error(time: float) -> None:
    run, (x,) = ready_servos(monitor={"motion_window": 0.001, "motion_time": time})
    move = x.move_absolute(300.0, velocity=100.0)
    run.step(200)
    if time > 0.001:
        assert x.error is None
        run.inject("X", Fault("blocked"))
        stuck = run.tick
    finish(run, move)
    assert error_of(move) is ErrorId.NO_MOTION
    if time > 0.001:
        assert run.tick - stuck == pytest.approx(time * 1000.0, abs=2.0)
    assert "moved by no more than 0.001 in any cycle" in str(x.error)
    run.step()
    assert not x.enabled
    run.step(300)
    assert_valid(run.trace)


def test_nothing_has_to_move_at_rest_held_by_override_0_or_without_a_job() -> None:
    run, (x,) = ready_servos(monitor={"motion_window": 0.001, "motion_time": 0.05})
    run.step(200)
    move = x.move_absolute(100.0)
    run.step(100)
    x.set_override(0.0)
    run.step(1000)
    assert move.busy
    x.set_override(1.0)
    finish(run, move)
    stop = x.stop(hold=True)
    run.step(500)
    assert stop.busy
    stop.release()
    run.step(2)
    assert x.error is None
    assert_valid(run.trace)


def test_a_shifted_coordinate_is_no_motion() -> None:
    run, (x,) = ready_servos(monitor={"motion_window": 0.001, "motion_time": 0.02})
    move = x.move_absolute(300.0, velocity=100.0)
    run.step(200)
    run.inject("X", Fault("blocked"))
    while move.busy:
        x.define_position(0.5, relative=True)
        run.step()
        assert run.tick < 400
    assert error_of(move) is ErrorId.NO_MOTION


def test_the_interface_shows_what_is_watched() -> None:
    run, _ = ready_servos(monitor={"motion_window": 0.01, "velocity_lag": 10.0})
    shown = OpModeDWord(int(run.axis_refs["X"].NcToPlc.OpModeDWord) & 0xFFFFFF)
    assert OpModeDWord.MotionMonitoring in shown
    assert OpModeDWord.VeloLagMonitoring in shown
    assert OpModeDWord.PositionLagMonitoring not in shown
