"""Monitors: lag, windows, arrival, actual software limits."""

import re
from typing import TYPE_CHECKING

import numpy as np
import pytest

from motionlayer import AxisState, Fault
from motionlayer.command import ErrorId
from motionlayer.nc import REACTIONS, AxisCommand, Reaction
from motionlayer.verify import assert_valid
from tests.machines import error_of, finish, play, ready, state_of
from tests.nc.servos import ready_servos

if TYPE_CHECKING:
    from collections.abc import Callable

S = AxisState


def test_without_monitors_there_is_nothing_to_look_at() -> None:
    run, x = ready()
    finish(run, x.move_absolute(100.0))
    assert (x.in_target, x.in_position_area) == (False, False)
    assert x.lag == 0.0


@pytest.mark.parametrize("filter_ticks", [0, 1, 7, 30])
def test_too_much_lag_for_longer_than_the_filter_time_is_an_error(filter_ticks: int) -> None:
    run, (x,) = ready_servos(monitor={"lag": 3.0, "lag_time": filter_ticks * 0.001})
    move = x.move_absolute(300.0)
    over = 0
    while move.busy:
        run.step()
        over = over + 1 if abs(x.lag) > 3.0 else 0
        assert over <= filter_ticks + 1
    assert error_of(move) is ErrorId.LAG
    assert over == filter_ticks + 1
    assert state_of(x) is S.ERRORSTOP
    run.step()
    assert not x.enabled
    assert "allowed: 3.0 mm" in str(x.error)


def test_lag_that_comes_back_in_time_is_none() -> None:
    run, (x,) = ready_servos(monitor={"lag": 3.0, "lag_time": 0.5})
    finish(run, x.move_absolute(60.0))
    assert x.error is None


def test_a_positioning_is_done_when_the_actual_position_has_been_in_the_window_for_its_time() -> None:
    run, (x,) = ready_servos(monitor={"target_window": 0.05, "target_time": 0.01})
    move = x.move_absolute(100.0)
    inside, rested = 0, 0
    while move.busy:
        run.step()
        inside = inside + 1 if abs(x.actual_position - 100.0) <= 0.05 else 0
        rested += x.set_position == 100.0
        if move.at_target:
            assert move.remaining_time == 0.0
            assert state_of(x) is S.DISCRETE_MOTION or not move.busy
    assert move.done
    assert rested > 50
    assert inside in {11, 12}
    assert move.end_time is not None
    assert move.end_time < run.time - 0.05
    assert (state_of(x), x.in_target) == (S.STANDSTILL, True)
    assert_valid(run.trace)


def test_with_the_range_window_alone_it_is_done_inside_of_it() -> None:
    run, (x,) = ready_servos(monitor={"range_window": 2.0})
    move = x.move_absolute(100.0)
    finish(run, move)
    assert 0.5 < abs(x.actual_position - 100.0) <= 2.0
    assert (x.in_position_area, x.in_target) == (True, False)


def test_the_windows_are_lost_again() -> None:
    run, (x,) = ready_servos(monitor={"target_window": 0.05, "range_window": 1.0})
    finish(run, x.move_absolute(100.0))
    assert (x.in_target, x.in_position_area) == (True, True)
    run.inject("X", Fault("encoder_jump", 0.5))
    run.step(2)
    assert (x.in_target, x.in_position_area) == (False, True)


def test_a_window_that_is_not_reached_in_time_is_an_error_under_power() -> None:
    monitor = {"target_window": 0.05, "target_timeout": 0.2}
    run, (x,) = ready_servos(monitor=monitor, drive={"backlash": 0.5})
    move = x.move_absolute(100.0)
    finish(run, move)
    assert error_of(move) is ErrorId.TARGET_TIMEOUT
    assert move.end_time is not None
    assert run.time - move.end_time == pytest.approx(0.2, abs=0.003)
    run.step(3)
    assert (state_of(x), x.enabled) == (S.ERRORSTOP, True)
    finish(run, x.reset())
    assert state_of(x) is S.STANDSTILL
    assert x.set_position == pytest.approx(x.actual_position, abs=1e-3)
    assert_valid(run.trace)


@pytest.mark.parametrize("call", ["halt", "stop", "move", "override", "disable", "fault"])
def test_an_axis_that_waits_for_its_window_takes_other_commands(call: str) -> None:
    run, (x,) = ready_servos(monitor={"target_window": 0.001, "target_timeout": 2.0})
    move = x.move_absolute(50.0)
    while not move.at_target:
        run.step()
    end = move.end_time
    calls: dict[str, Callable[[], AxisCommand | None]] = {
        "halt": x.halt,
        "stop": x.stop,
        "move": lambda: x.move_absolute(20.0),
        "override": lambda: x.set_override(0.3),
        "disable": x.disable,
        "fault": lambda: x.fault(ErrorId.INTERNAL),
    }
    command = calls[call]()
    run.step(2500)
    assert move.end_time == end
    if call == "override":
        assert move.done
    elif call == "fault":
        assert error_of(move) is ErrorId.INTERNAL
    else:
        assert move.aborted
        assert command is not None
        assert command.done
    assert_valid(run.trace)


def test_the_actual_position_is_watched_against_the_software_limits() -> None:
    """A drive that rings overshoots the limit before which the setpoint comes to rest."""
    drive = {"position_gain": 150.0, "time_constant": 0.02}
    run, (x,) = ready_servos(drive=drive, monitor={"software_limits": True})
    move = x.move_absolute(399.9)
    finish(run, move)
    assert error_of(move) is ErrorId.MAXIMUM_PASSED
    assert x.actual_position > 400.0
    run.step(300)
    assert x.enabled
    finish(run, x.reset())
    finish(run, x.move_absolute(300.0, velocity=50.0))
    assert x.error is None
    assert_valid(run.trace)


def test_the_lag_widens_the_software_limits_of_the_actual_position() -> None:
    drive = {"position_gain": 150.0, "time_constant": 0.02}
    run, (x,) = ready_servos(drive=drive, monitor={"software_limits": True, "lag": 50.0})
    finish(run, x.move_absolute(400.0))
    run.step(300)
    assert x.error is None


def test_the_first_error_stays() -> None:
    run, (x,) = ready_servos(monitor={"lag": 3.0})
    move = x.move_absolute(300.0)
    finish(run, move)
    assert x.error is not None
    first = x.error
    run.inject("X", Fault("drive_error"))
    run.step(200)
    assert x.error is first


def test_reset_and_enable_after_a_lag_error_go_on_from_the_actual_position() -> None:
    run, (x,) = ready_servos(monitor={"lag": 3.0})

    async def program() -> None:
        move = await x.move_absolute(300.0).settled()
        assert move.error is not None
        await x.reset()
        assert state_of(x) is S.DISABLED
        await x.enable()
        assert x.set_position == x.actual_position
        await x.move_absolute(0.0, velocity=50.0)

    play(run, program)
    run.step(500)
    assert x.actual_position == pytest.approx(0.0, abs=1e-6)
    trace = run.trace
    assert np.abs(np.diff(trace["X.actual_position"])).max() <= 500.0 * 0.001
    assert_valid(trace)


def test_every_error_that_a_drive_or_monitor_brings_has_its_reaction() -> None:
    off = {one for one, reaction in REACTIONS.items() if reaction is Reaction.POWER_OFF}
    assert off == {
        ErrorId.LAG,
        ErrorId.VELOCITY_LAG,
        ErrorId.NO_MOTION,
        ErrorId.NOT_ENABLED,
        ErrorId.ENCODER,
        ErrorId.DRIVE_NOT_READY,
        ErrorId.IO_DATA_INVALID,
    }


@pytest.mark.parametrize(("torque", "named"), [(1000.0, True), (6000.0, False)])
def test_a_drive_without_enough_torque_is_named_where_it_lags(torque: float, named: bool) -> None:
    monitor = {"lag": 0.5 if named else 0.05}
    run, (x,) = ready_servos(monitor=monitor, drive={"max_acceleration": torque, "velocity_feed_forward": 1.0})
    move = x.move_absolute(200.0)
    finish(run, move)
    assert move.error is not None
    assert ("; the torque of the drive allows 1000 mm/s²)" in move.error.text) is named
    (lag,) = re.findall(r"lag = ([\d.]+), allowed", move.error.text)
    assert len(lag) <= 12
    assert_valid(run.trace)
