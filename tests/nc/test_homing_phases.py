"""The complete homing: cam, zero pulse, limit switch, phases and errors (function-blocks 2.10); defining positions."""

import math
from typing import Any

import pytest

from motionlayer import AxisState
from motionlayer.command import ErrorId
from motionlayer.nc import Axis, BufferMode, Calibration, StateDWord
from motionlayer.store import Q
from motionlayer.verify import assert_valid
from tests.machines import error_of, finish, ready, state_of
from tests.nc.servos import ready_servos

CAM: dict[str, Any] = {"mode": "cam", "switch": -50.0, "velocity": 40.0, "sync_velocity": 5.0, "position": 7.0}
INDEX = CAM | {"mode": "index", "pulse": 1.25, "pulse_period": 10.0}


def homed(axis: Axis) -> bool:
    """Return `homed`; a type checker does not know that it changes between two lines."""
    return axis.homed


def phases(run: Any, axis: Any, command: Any) -> list[int]:
    """Step until a homing has ended; return its phases in order."""
    seen = [int(axis._store.table[Q.HOMING, axis._column])]
    while command.busy:
        assert run.tick < 60_000, "the homing did not end"
        run.step()
        phase = int(axis._store.table[Q.HOMING, axis._column])
        if phase != seen[-1]:
            seen.append(phase)
    return seen


@pytest.mark.parametrize("start", [0.0, 30.0, -50.0, -60.0])
def test_the_edge_at_which_the_axis_leaves_the_cam_is_the_reference(start: float) -> None:
    run, x = ready(home=CAM, start_position=start)
    home = x.home()
    seen = phases(run, x, home)
    assert seen == ([2, 3, 4, 6, 0] if start > -50.0 else [4, 6, 0])
    assert homed(x)
    finish(run, x.move_absolute(7.0))
    assert x.set_position - float(x._store.table[Q.SHIFT, 0]) == pytest.approx(-50.0, abs=1e-12)
    run.step(2)
    assert_valid(run.trace)


def test_the_zero_pulse_behind_the_cam_is_the_reference() -> None:
    run, x = ready(home=INDEX)
    home = x.home()
    assert phases(run, x, home) == [2, 3, 4, 5, 6, 0]
    finish(run, x.move_absolute(7.0))
    assert x.set_position - float(x._store.table[Q.SHIFT, 0]) == pytest.approx(-48.75, abs=1e-12)
    run.step(2)
    assert_valid(run.trace)


def test_with_a_servo_the_reference_is_where_the_drive_was() -> None:
    """Set and actual position are defined by the latch of the drive, however far it lags."""
    run, (x,) = ready_servos(home=INDEX)
    finish(run, x.home(), 60_000)
    finish(run, x.move_absolute(7.0))
    run.step(500)
    assert x.actual_position - float(x._store.table[Q.SHIFT, 0]) == pytest.approx(-48.75, abs=1e-6)
    assert_valid(run.trace)


@pytest.mark.parametrize(
    ("home", "start", "error"),
    [
        (CAM | {"travel": 30.0}, 0.0, ErrorId.CAM_NOT_FOUND),
        (CAM | {"travel": 30.0}, -90.0, ErrorId.CAM_NOT_LEFT),
        (INDEX | {"pulse": 100.0, "pulse_period": 1000.0, "travel": 60.0}, 0.0, ErrorId.SYNC_PULSE_NOT_FOUND),
        (INDEX | {"pulse_distance": 2.0}, 0.0, ErrorId.LATCH_TOO_CLOSE),
    ],
)
def test_errors(home: dict[str, Any], start: float, error: ErrorId) -> None:
    run, x = ready(home=home, start_position=start)
    command = x.home()
    finish(run, command)
    assert error_of(command) is error
    assert state_of(x) is AxisState.ERRORSTOP
    assert not homed(x)
    run.step(300)
    assert x.set_velocity == 0.0
    assert x._store.table[Q.HOMING, 0] == 0.0
    assert_valid(run.trace)


@pytest.mark.parametrize("servo", [False, True])
@pytest.mark.parametrize("mode", ["cam", "index"])
def test_a_cam_that_is_shorter_than_the_brake_is_released_too_early(servo: bool, mode: str) -> None:
    home = (CAM if mode == "cam" else INDEX) | {"velocity": 200.0, "switch_width": 1.0}
    run, x = ready(home=home)
    if servo:
        run, (x,) = ready_servos(home=home)
    command = x.home()
    finish(run, command)
    assert error_of(command) is ErrorId.CAM_RELEASED_EARLY
    assert state_of(x) is AxisState.ERRORSTOP
    run.step(5)
    assert_valid(run.trace)


@pytest.mark.parametrize("start", [0.0, -50.5, -51.0])
def test_a_cam_of_finite_width_has_its_reference_at_the_edge_of_the_search(start: float) -> None:
    run, x = ready(home=CAM | {"velocity": 20.0, "switch_width": 1.0}, start_position=start)
    finish(run, x.home(), 60_000)
    finish(run, x.move_absolute(7.0))
    assert x.set_position - float(x._store.table[Q.SHIFT, 0]) == pytest.approx(-50.0, abs=1e-12)
    run.step(2)
    assert_valid(run.trace)


@pytest.mark.parametrize("servo", [False, True])
def test_a_cam_that_is_left_on_its_other_side_is_latched_there(servo: bool) -> None:
    """With the sync direction of the search the axis crosses the cam: its other edge is the reference."""
    home = CAM | {"velocity": 20.0, "switch_width": 1.0, "sync_direction": "negative"}
    run, x = ready(home=home)
    if servo:
        run, (x,) = ready_servos(home=home)
    finish(run, x.home(), 60_000)
    finish(run, x.move_absolute(7.0))
    run.step(500)
    assert x.set_position - float(x._store.table[Q.SHIFT, 0]) == pytest.approx(-51.0, abs=1e-9)
    assert_valid(run.trace)


@pytest.mark.parametrize(
    ("changes", "bound"),
    [
        ({}, 1000.0),
        ({"software_limit_min": None}, 600.0 * 40.0),
        ({"software_limit_min": None, "software_limit_max": None}, 600.0 * 40.0),
    ],
)
def test_a_search_is_bounded_although_nobody_says_how_far_it_goes(changes: dict[str, Any], bound: float) -> None:
    """Twice the span of the software limits; without them what takes ten minutes."""
    _, x = ready(home=CAM, **changes)
    assert x.config.home.travel == bound


@pytest.mark.parametrize("travel", [0.77, 0.79, 0.8, 0.81])
def test_a_search_may_end_in_the_tick_in_which_it_is_up_to_speed(travel: float) -> None:
    """Its velocity is reached after 0.8 mm: that end is not taken for the end of the brake."""
    run, x = ready(home=CAM | {"travel": travel})
    finish(run, x.home())
    reset = x.reset()
    run.step()
    assert reset.busy
    assert x.set_velocity < -30.0
    finish(run, reset)
    assert x.set_velocity == 0.0
    assert_valid(run.trace)


def test_a_switch_that_never_comes_ends_the_search() -> None:
    run, x = ready(home=CAM | {"switch": -5000.0, "velocity": 500.0})
    command = x.home()
    finish(run, command)
    assert error_of(command) is ErrorId.CAM_NOT_FOUND
    assert "home.travel = 1000 mm" in str(command.error)
    run.step(200)
    assert_valid(run.trace)


@pytest.mark.parametrize(
    ("home", "start", "shown"),
    [
        (CAM, 0.0, [0, 2, 3, 4, 6, 0]),
        (CAM, -60.0, [0, 4, 6, 0]),
        (INDEX, 0.0, [0, 2, 3, 4, 5, 6, 0]),
        (CAM | {"mode": "switch"}, 0.0, [0, 2, 6, 0]),
        (CAM | {"mode": "switch"}, -60.0, [0, 4, 6, 0]),
        (CAM | {"mode": "direct"}, 0.0, [0]),
        (CAM | {"travel": 30.0}, 0.0, [0, 2, 0]),
        (INDEX | {"pulse_distance": 2.0}, 0.0, [0, 2, 3, 4, 5, 0]),
        (CAM | {"velocity": 200.0, "switch_width": 1.0}, 0.0, [0, 2, 3, 0]),
    ],
)
def test_the_interface_shows_the_phases(home: dict[str, Any], start: float, shown: list[int]) -> None:
    """`NcToPlc.HomingState`, HomingBusy and Homed as a client sees them, cycle by cycle."""
    run, x = ready(home=home, start_position=start)
    ref = run.axis_refs["X"]
    command = x.home()
    seen, stepped = [0], 0
    while command.busy or stepped < 3:
        run.step()
        stepped = stepped + 1 if not command.busy else 0
        phase, flags = int(ref.NcToPlc.HomingState), int(ref.NcToPlc.StateDWord)
        if phase != seen[-1]:
            seen.append(phase)
        assert bool(flags & StateDWord.HomingBusy) == (phase != 0)
        assert not (flags & StateDWord.Homed and phase)
    assert seen == shown
    assert bool(int(ref.NcToPlc.StateDWord) & StateDWord.Homed) == command.done


def test_direct_force_and_reset() -> None:
    run, x = ready(home=CAM)
    finish(run, x.home(12.0, Calibration.DIRECT))
    assert x.set_position == 12.0
    assert homed(x)
    finish(run, x.home(mode=Calibration.RESET))
    assert not homed(x)
    assert x.set_position == 12.0
    finish(run, x.home(mode=Calibration.FORCE))
    assert homed(x)
    assert x.set_position == 12.0
    assert_valid(run.trace)


def test_a_homing_needs_both_feed_enables() -> None:
    run, x = ready(home=CAM)
    finish(run, x.enable(negative=False))
    assert error_of(x.home()) is ErrorId.FEED_NOT_ENABLED
    finish(run, x.home(mode=Calibration.DIRECT))


def test_define_position_absolute_relative_and_back() -> None:
    run, x = ready()
    finish(run, x.home(0.0))
    finish(run, x.move_absolute(30.0))
    run.step()
    assert x.define_position(100.0).done
    assert x.set_position == 100.0
    assert x.define_position(-5.0, relative=True).done
    assert x.set_position == 95.0
    run.step()
    assert x.define_position(clear_offset=True).done
    assert x.set_position == pytest.approx(30.0, abs=1e-12)
    finish(run, x.move_relative(1.0))
    assert_valid(run.trace)


def test_define_position_keeps_the_lag_or_clears_it() -> None:
    for clear in (False, True):
        run, (x,) = ready_servos(drive={"backlash": 0.5})
        finish(run, x.move_absolute(20.0))
        run.step(200)
        lag = x.set_position - x.actual_position
        assert lag != 0.0
        x.define_position(50.0, clear_lag=clear)
        assert x.actual_position == pytest.approx(50.0, abs=1e-12)
        assert x.set_position - x.actual_position == pytest.approx(0.0 if clear else lag, abs=1e-12)
        run.step(50)
        assert_valid(run.trace)


@pytest.mark.parametrize("options", [{}, {"clear_offset": True}, {"relative": True, "clear_lag": True}])
def test_define_position_in_motion_is_refused_but_for_a_shift(options: dict[str, bool]) -> None:
    run, x = ready()
    move = x.move_absolute(100.0)
    run.step(50)
    assert error_of(x.define_position(1.0, **options)) is ErrorId.GROUP_BUSY
    assert error_of(x.define_position(math.nan)) is ErrorId.TARGET_NOT_FINITE
    finish(run, move)
    assert x.set_position == 100.0


@pytest.mark.parametrize("shift", [-20.0, 35.5])
def test_a_shift_in_motion_takes_the_targets_along(shift: float) -> None:
    run, x = ready()
    move = x.move_absolute(100.0)
    after = x.move_absolute(150.0, velocity=100.0, buffer_mode=BufferMode.BLENDING_LOW)
    run.step(60)
    place, drive = x.set_position, x.set_position - float(x._store.table[Q.SHIFT, 0])
    assert x.define_position(shift, relative=True).done
    assert x.set_position == place + shift
    assert x.set_position - float(x._store.table[Q.SHIFT, 0]) == pytest.approx(drive, abs=1e-12)
    finish(run, move)
    finish(run, after)
    assert x.set_position == 150.0 + shift
    run.step(2)
    assert_valid(run.trace)


def test_a_shift_of_an_endless_motion_and_of_a_brake() -> None:
    run, x = ready()
    x.move_velocity(100.0)
    run.step(200)
    x.define_position(-40.0, relative=True)
    run.step(50)
    halt = x.halt()
    run.step(3)
    x.define_position(10.0, relative=True)
    finish(run, halt)
    run.step(2)
    assert_valid(run.trace)


def test_a_shift_that_would_lead_a_target_outside_is_refused() -> None:
    run, x = ready()
    move = x.move_absolute(390.0)
    run.step(60)
    assert error_of(x.define_position(20.0, relative=True)) is ErrorId.TARGET_OUTSIDE_LIMITS
    finish(run, move)
    assert x.set_position == 390.0


@pytest.mark.parametrize("target", [230.0, 390.0])
def test_a_shift_before_a_joint_asks_for_the_room_of_both_motions(target: float) -> None:
    """Alone, the first would come to rest far behind its joint, at 330; with the second it never goes there."""
    run, x = ready()
    x.move_absolute(200.0, velocity=400.0, deceleration=600.0)
    second = x.move_absolute(target, velocity=400.0, buffer_mode=BufferMode.BLENDING_HIGH)
    finish(run, x.passes(199.5))
    shift = 150.0
    inside = target + shift <= 400.0
    assert error_of(x.define_position(shift, relative=True)) is (None if inside else ErrorId.TARGET_OUTSIDE_LIMITS)
    finish(run, second)
    assert x.set_position == target + (shift if inside else 0.0)
    run.step(2)
    assert_valid(run.trace)
