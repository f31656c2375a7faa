"""Buffered and blended commands: when they begin, with which velocity, and what they refuse (function-blocks 2.8)."""

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import pytest

from motionlayer import AxisState, Simulation
from motionlayer.command import ErrorId
from motionlayer.nc import Axis, AxisCommand, BufferMode, Direction
from motionlayer.verify import assert_valid, verify
from tests.machines import error_of, finish, full_move_time, ready, state_of
from tests.nc.servos import ready_servos

BLENDING = [mode for mode in BufferMode if mode > BufferMode.BUFFERED]
RULE: dict[BufferMode, Callable[[float, float], float]] = {
    BufferMode.BLENDING_LOW: min,
    BufferMode.BLENDING_PREVIOUS: lambda first, _: first,
    BufferMode.BLENDING_NEXT: lambda _, second: second,
    BufferMode.BLENDING_HIGH: max,
}


def waiting(axis: Axis) -> AxisCommand | None:
    """Return the buffered command; a type checker does not know that it changes between two lines."""
    return None if axis.buffered is None or axis.buffered.active else axis.buffered


def velocity_at(run: Simulation, axis: Axis, position: float) -> float:
    """Return the velocity at a position that is passed once, from the recorded plans alone."""
    for plan in run.trace.plans:
        if plan.axis == axis.name and plan.tick and plan.pieces[0, 1] == position:
            return float(plan.pieces[0, 2])
    raise AssertionError(f"no plan begins at {position}")


@pytest.mark.parametrize(("first", "second"), [(300.0, 150.0), (150.0, 300.0), (200.0, 200.0)])
@pytest.mark.parametrize("mode", BLENDING)
def test_the_velocity_at_the_exact_position_is_that_of_the_mode(mode: BufferMode, first: float, second: float) -> None:
    run, x = ready()
    one = x.move_absolute(120.0, velocity=first)
    two = x.move_absolute(300.0, velocity=second, buffer_mode=mode)
    assert one.active
    assert two.busy
    assert waiting(x) is two
    finish(run, one)
    assert two.active
    assert waiting(x) is None
    assert one.end_time is not None
    assert x.set_position == pytest.approx(120.0 + RULE[mode](first, second) * (run.time - one.end_time), abs=1e-2)
    finish(run, two)
    assert x.set_position == 300.0
    run.step(2)
    assert velocity_at(run, x, 120.0) == RULE[mode](first, second)
    assert_valid(run.trace)


def test_a_buffered_command_begins_from_rest_inside_the_cycle() -> None:
    """No cycle is lost: the whole takes as long as both moves in closed form."""
    run, x = ready()
    start = run.time
    one = x.move_absolute(150.0)
    two = x.move_absolute(300.0, buffer_mode=BufferMode.BUFFERED)
    finish(run, two)
    assert one.end_time == pytest.approx(start + full_move_time(150.0), rel=1e-12)
    assert two.end_time == pytest.approx(start + 2.0 * full_move_time(150.0), rel=1e-12)
    run.step(2)
    assert velocity_at(run, x, 150.0) == 0.0
    assert_valid(run.trace)


@pytest.mark.parametrize("mode", BufferMode)
def test_at_rest_every_mode_begins_at_once(mode: BufferMode) -> None:
    run, x = ready()
    move = x.move_absolute(10.0, buffer_mode=mode)
    assert move.active
    finish(run, move)
    assert_valid(run.trace)


@pytest.mark.parametrize("mode", BufferMode)
def test_on_an_endless_motion_every_mode_begins_at_once(mode: BufferMode) -> None:
    run, x = ready()
    endless = x.move_velocity(100.0)
    run.step(100)
    move = x.move_absolute(50.0, buffer_mode=mode)
    assert endless.aborted
    assert endless.by is move
    finish(run, move)
    assert_valid(run.trace)


@pytest.mark.parametrize("mode", BLENDING)
def test_a_reversal_passes_the_target_at_rest(mode: BufferMode) -> None:
    run, x = ready()
    one = x.move_absolute(120.0)
    two = x.move_absolute(-50.0, buffer_mode=mode)
    finish(run, two)
    assert one.done
    run.step(2)
    trace = run.trace
    assert trace["X.set_position"].max() == pytest.approx(120.0, abs=1e-3)
    assert trace["X.set_position"].max() <= 120.0
    assert_valid(trace)


def test_a_third_command_is_refused_and_changes_nothing() -> None:
    run, x = ready()
    one, two = x.move_absolute(100.0), x.move_absolute(200.0, buffer_mode=BufferMode.BUFFERED)
    assert error_of(x.move_absolute(300.0, buffer_mode=BufferMode.BLENDING_LOW)) is ErrorId.BUFFER_FULL
    assert error_of(x.halt(buffer_mode=BufferMode.BUFFERED)) is ErrorId.BUFFER_FULL
    finish(run, two)
    assert one.done
    assert x.set_position == 200.0
    assert_valid(run.trace)


@pytest.mark.parametrize(
    "brake", [lambda x: x.move_absolute(50.0), lambda x: x.move_velocity(50.0), lambda x: x.halt(), lambda x: x.stop()]
)
def test_an_aborting_command_empties_the_buffer(brake: Callable[[Axis], AxisCommand]) -> None:
    run, x = ready()
    one, two = x.move_absolute(300.0), x.move_absolute(350.0, buffer_mode=BufferMode.BLENDING_HIGH)
    run.step(100)
    new = brake(x)
    assert one.aborted
    assert two.aborted
    assert one.by is new
    assert two.by is new
    run.step(1000)
    assert x.set_position < 300.0
    assert_valid(run.trace)


def test_a_refused_aborting_command_leaves_the_buffer() -> None:
    run, x = ready()
    x.move_absolute(100.0)
    two = x.move_absolute(200.0, buffer_mode=BufferMode.BUFFERED)
    assert error_of(x.move_absolute(1e4)) is ErrorId.TARGET_OUTSIDE_LIMITS
    finish(run, two)
    assert x.set_position == 200.0


def test_an_error_ends_the_buffered_command_too() -> None:
    run, x = ready()
    one, two = x.move_absolute(300.0), x.move_absolute(350.0, buffer_mode=BufferMode.BLENDING_LOW)
    run.step(150)
    x.fault(ErrorId.INTERNAL)
    assert error_of(one) is ErrorId.INTERNAL
    assert error_of(two) is ErrorId.INTERNAL
    run.step(500)
    assert x.set_velocity == 0.0
    assert_valid(run.trace)


def test_an_error_of_a_motion_that_takes_no_time_drops_what_would_begin() -> None:
    run, x = ready()
    x.move_absolute(0.0)
    two = x.move_absolute(100.0, buffer_mode=BufferMode.BUFFERED)
    x.fault(ErrorId.INTERNAL)
    run.step(50)
    assert two.error is not None
    assert x.set_position == 0.0
    assert_valid(run.trace)


def test_disabling_ends_the_buffered_command() -> None:
    run, x = ready()
    one, two = x.move_absolute(300.0), x.move_absolute(350.0, buffer_mode=BufferMode.BLENDING_LOW)
    run.step(150)
    off = x.disable()
    assert one.by is off
    assert two.by is off
    finish(run, off)
    assert state_of(x) is AxisState.DISABLED
    assert_valid(run.trace)


def test_the_same_end_position_twice_is_refused_in_blending() -> None:
    _, x = ready()
    x.move_absolute(100.0)
    assert error_of(x.move_absolute(100.0, buffer_mode=BufferMode.BLENDING_LOW)) is ErrorId.SAME_END_POSITION


def test_a_late_follower_takes_the_nearest_velocity_it_can_reach() -> None:
    """It arrives in the braking ramp: slower than commanded, in the end at rest."""
    speeds = []
    for left in (0.15, 0.11, 0.105, 0.1, 0.095, 0.09, 0.04, 0.003):
        run, x = ready()
        one = x.move_absolute(150.0, velocity=400.0)
        while one.remaining_time > left:
            run.step()
        two = x.move_absolute(350.0, velocity=400.0, buffer_mode=BufferMode.BLENDING_PREVIOUS)
        finish(run, one)
        finish(run, two)
        run.step(2)
        speeds.append(velocity_at(run, x, 150.0))
        assert_valid(run.trace)
    assert speeds[0] == 400.0
    assert all(earlier > later for earlier, later in pairwise(speeds[:6]))
    assert speeds[6:] == [0.0, 0.0]


def test_a_short_follower_is_entered_no_faster_than_it_can_brake() -> None:
    run, x = ready()
    one = x.move_absolute(150.0)
    two = x.move_absolute(152.0, buffer_mode=BufferMode.BLENDING_HIGH)
    finish(run, two)
    run.step(2)
    assert one.done
    speed = velocity_at(run, x, 150.0)
    way = speed * math.sqrt(speed / 1e5)  # braking with the jerk alone: twice √(v/J) at half the velocity
    assert way == pytest.approx(2.0, rel=1e-9)
    assert run.trace["X.set_position"].max() <= 152.0
    assert_valid(run.trace)


def test_blending_position() -> None:
    run, x = ready()
    one = x.move_absolute(200.0, velocity=300.0)
    two = x.move_absolute(300.0, velocity=200.0, buffer_mode=BufferMode.BLENDING_LOW, blending_position=90.0)
    finish(run, one)
    assert 90.0 < x.set_position < 90.5
    finish(run, two)
    run.step(2)
    assert velocity_at(run, x, 90.0) == 200.0
    assert_valid(run.trace)


def test_a_blending_position_that_was_passed_begins_at_once() -> None:
    run, x = ready()
    one = x.move_absolute(200.0, velocity=300.0)
    finish(run, x.passes(100.0))
    two = x.move_relative(50.0, buffer_mode=BufferMode.BLENDING_LOW, blending_position=90.0)
    begin = x.set_position
    assert one.by is two
    finish(run, two)
    assert x.set_position == begin + 50.0
    assert_valid(run.trace)


@pytest.mark.parametrize(
    ("place", "error"),
    [
        (200.1, ErrorId.BLENDING_POSITION),
        (1e6, ErrorId.BLENDING_POSITION),
        (-0.1, ErrorId.BLENDING_POSITION),
        (-1e6, ErrorId.BLENDING_POSITION),
        (math.nan, ErrorId.TARGET_NOT_FINITE),
        (math.inf, ErrorId.TARGET_NOT_FINITE),
    ],
)
def test_a_wrong_blending_position_is_refused(place: float, error: ErrorId) -> None:
    run, x = ready()
    one = x.move_absolute(200.0)
    two = x.move_absolute(300.0, buffer_mode=BufferMode.BLENDING_LOW, blending_position=place)
    assert error_of(two) is error
    finish(run, one)
    assert x.set_position == 200.0


def test_the_beginning_of_a_move_bounds_its_blending_position_and_moves_with_the_coordinate() -> None:
    run, x = ready()
    x.move_absolute(50.0, velocity=300.0)
    one = x.move_absolute(200.0, velocity=300.0, buffer_mode=BufferMode.BLENDING_HIGH)
    finish(run, x.passes(100.0))
    x.define_position(10.0, relative=True)
    assert one.active
    refused = x.move_absolute(300.0, buffer_mode=BufferMode.BLENDING_LOW, blending_position=59.0)
    assert error_of(refused) is ErrorId.BLENDING_POSITION
    two = x.move_absolute(300.0, buffer_mode=BufferMode.BLENDING_LOW, blending_position=61.0)  # which it has passed
    assert one.by is two
    finish(run, two)
    run.step(2)
    assert_valid(run.trace)


def test_a_turn_at_a_blending_position() -> None:
    run, x = ready()
    x.move_absolute(200.0)
    two = x.move_absolute(-50.0, buffer_mode=BufferMode.BLENDING_LOW, blending_position=120.0)
    finish(run, two)
    run.step(2)
    assert run.trace["X.set_position"].max() <= 120.0
    assert velocity_at(run, x, 120.0) == 0.0
    assert_valid(run.trace)


@pytest.mark.parametrize("mode", [BufferMode.BUFFERED, BufferMode.BLENDING_LOW])
def test_relative_and_additive_followers_count_from_the_target(mode: BufferMode) -> None:
    for move in ("move_relative", "move_additive"):
        run, x = ready()
        x.move_absolute(100.0)
        run.step(50)
        two = getattr(x, move)(30.0, buffer_mode=mode)
        finish(run, two)
        assert x.set_position == 130.0
        assert_valid(run.trace)


def test_an_endless_follower_goes_on_from_the_target() -> None:
    run, x = ready()
    one = x.move_absolute(100.0, velocity=200.0)
    two = x.move_velocity(50.0, buffer_mode=BufferMode.BLENDING_LOW)
    finish(run, one)
    assert one.end_time is not None
    assert state_of(x) is AxisState.CONTINUOUS_MOTION
    assert two.in_velocity
    run.step(200)
    assert x.set_position == pytest.approx(100.0 + 50.0 * (run.time - one.end_time), abs=1e-9)
    halt = x.halt()
    finish(run, halt)
    assert_valid(run.trace)


def test_an_endless_follower_backwards_turns_at_the_target() -> None:
    run, x = ready()
    x.move_absolute(100.0)
    x.move_velocity(50.0, Direction.NEGATIVE, buffer_mode=BufferMode.BLENDING_HIGH)
    run.step(800)
    assert x.set_velocity == -50.0
    finish(run, x.halt())
    assert run.trace["X.set_position"].max() <= 100.0
    assert_valid(run.trace)


@pytest.mark.parametrize("mode", [BufferMode.BLENDING_LOW, BufferMode.BLENDING_NEXT])
def test_a_halt_that_keeps_the_target_may_change_the_brake(mode: BufferMode) -> None:
    run, x = ready()
    one = x.move_absolute(200.0, deceleration=2000.0)
    run.step(50)
    halt = x.halt(deceleration=6000.0, buffer_mode=mode)
    finish(run, halt)
    assert one.done
    assert x.set_position == 200.0
    run.step(2)
    assert run.trace["X.max_deceleration"].max() == 6000.0
    assert_valid(run.trace)


@pytest.mark.parametrize("mode", [BufferMode.BLENDING_PREVIOUS, BufferMode.BLENDING_HIGH])
def test_a_halt_that_brakes_behind_the_target(mode: BufferMode) -> None:
    run, x = ready()
    one = x.move_absolute(200.0, velocity=300.0)
    halt = x.halt(buffer_mode=mode)
    finish(run, one)
    assert 200.0 < x.set_position < 200.5
    finish(run, halt)
    assert x.set_position == pytest.approx(200.0 + 300.0 * math.sqrt(300.0 / 1e5), abs=1e-9)
    assert_valid(run.trace)


def test_a_buffered_halt_only_comes_behind() -> None:
    run, x = ready()
    one = x.move_absolute(200.0)
    halt = x.halt(buffer_mode=BufferMode.BUFFERED)
    finish(run, halt)
    assert one.done
    assert halt.end_time == one.end_time
    assert x.set_position == 200.0
    assert_valid(run.trace)


def test_a_follower_of_a_halt_begins_at_its_end() -> None:
    run, x = ready()
    x.move_velocity(100.0)
    run.step(300)
    halt = x.halt()
    two = x.move_relative(40.0, buffer_mode=BufferMode.BLENDING_HIGH)
    finish(run, halt)
    rest = float(run.axes["X"].set_position)
    finish(run, two)
    assert x.set_position == pytest.approx(rest + 40.0, abs=1e-3)
    assert_valid(run.trace)


@pytest.mark.parametrize("factor", [0.5, 0.05, 0.0])
@pytest.mark.parametrize("mode", [BufferMode.BUFFERED, BufferMode.BLENDING_LOW, BufferMode.BLENDING_NEXT])
def test_the_override_plans_both_anew(mode: BufferMode, factor: float) -> None:
    run, x = ready()
    one = x.move_absolute(150.0, velocity=300.0)
    two = x.move_absolute(300.0, velocity=200.0, buffer_mode=mode)
    run.step(100)
    x.set_override(factor)
    run.step(300)
    assert one.busy or factor > 0.0
    x.set_override(1.0)
    finish(run, one)
    finish(run, two)
    assert x.set_position == 300.0
    assert_valid(run.trace)


def test_an_override_in_force_before_scales_the_velocity_at_the_joint() -> None:
    run, x = ready()
    x.set_override(0.25)
    x.move_absolute(100.0, velocity=400.0)
    two = x.move_absolute(200.0, velocity=200.0, buffer_mode=BufferMode.BLENDING_LOW)
    finish(run, two)
    run.step(2)
    assert velocity_at(run, x, 100.0) == 50.0
    assert_valid(run.trace)


def test_what_is_held_by_override_0_takes_a_follower() -> None:
    run, x = ready()
    x.set_override(0.0)
    one = x.move_absolute(100.0)
    two = x.move_absolute(200.0, buffer_mode=BufferMode.BLENDING_LOW)
    run.step(50)
    assert x.set_position == 0.0
    assert two.busy
    x.set_override(1.0)
    finish(run, two)
    assert one.done
    assert x.set_position == 200.0
    assert_valid(run.trace)


def test_the_override_of_a_follower_changes_while_a_halt_brakes() -> None:
    run, x = ready()
    x.move_velocity(400.0)
    run.step(150)
    x.halt()
    two = x.move_relative(40.0, buffer_mode=BufferMode.BUFFERED)
    run.step(10)
    x.set_override(0.1)
    finish(run, two)
    assert_valid(run.trace)


def test_a_follower_beyond_a_software_limit_is_refused() -> None:
    run, x = ready()
    one = x.move_absolute(300.0)
    assert error_of(x.move_relative(150.0, buffer_mode=BufferMode.BUFFERED)) is ErrorId.TARGET_OUTSIDE_LIMITS
    assert error_of(x.move_absolute(math.nan, buffer_mode=BufferMode.BLENDING_LOW)) is ErrorId.TARGET_NOT_FINITE
    finish(run, one)
    assert_valid(run.trace)


def test_a_motion_that_takes_no_time_hands_over_at_once() -> None:
    run, x = ready()
    one = x.move_absolute(0.0)
    two = x.move_absolute(50.0, buffer_mode=BufferMode.BUFFERED)
    start = run.time
    finish(run, two)
    assert one.end_time == start
    run.step(2)
    assert_valid(run.trace)


def test_with_a_target_window_a_buffered_command_waits_for_the_actual_position() -> None:
    run, (x,) = ready_servos(monitor={"target_window": 0.05, "target_time": 0.01})
    one = x.move_absolute(50.0)
    two = x.move_absolute(80.0, buffer_mode=BufferMode.BUFFERED)
    finish(run, one)
    assert abs(x.actual_position - 50.0) <= 0.05
    assert x.set_position == 50.0
    assert two.active
    finish(run, two)
    assert_valid(run.trace)


def test_a_blended_command_is_too_late_once_the_setpoint_has_arrived() -> None:
    run, (x,) = ready_servos(monitor={"target_window": 0.05, "target_time": 0.05})
    one = x.move_absolute(50.0)
    while not one.at_target:
        run.step()
    assert one.busy
    late = x.move_absolute(80.0, buffer_mode=BufferMode.BLENDING_LOW)
    assert error_of(late) is ErrorId.DISTANCE_TOO_SHORT
    finish(run, one)
    assert_valid(run.trace)


def test_watches_are_exact_in_the_cycle_of_the_change() -> None:
    run, x = ready()
    one = x.move_absolute(100.0, velocity=200.0)
    x.move_absolute(200.0, velocity=200.0, buffer_mode=BufferMode.BLENDING_PREVIOUS)
    before, at, behind = x.passes(100.0 - 0.01), x.passes(100.0), x.passes(100.0 + 0.01)
    finish(run, behind)
    assert one.end_time is not None
    for watch, way in ((before, -0.01), (at, 0.0), (behind, 0.01)):
        assert watch.end_time == pytest.approx(one.end_time + way / 200.0, abs=1e-12)


@pytest.mark.parametrize("mode", [None, 3, "low", Direction.POSITIVE])
def test_a_mode_that_is_none_is_a_mistake_of_the_program(mode: object) -> None:
    _, x = ready()
    with pytest.raises(TypeError, match=r"BufferMode\.BUFFERED"):
        x.move_absolute(1.0, buffer_mode=mode)  # type: ignore[arg-type]


@pytest.mark.parametrize("wait", [1e-4, -1e-4])
def test_the_judge_sees_a_change_at_another_instant(wait: float) -> None:
    """A plan that begins inside a cycle is held against the end of the one before it."""
    run, x = ready()
    x.move_absolute(100.0, velocity=200.0)
    finish(run, x.move_absolute(200.0, velocity=100.0, buffer_mode=BufferMode.BLENDING_LOW))
    trace = run.trace
    plans = [replace(plan, offset=plan.offset + wait) if plan.offset < 0.0 else plan for plan in trace.plans]
    assert verify(trace).ok
    trace.plans = tuple(plans)
    assert not verify(trace).ok
