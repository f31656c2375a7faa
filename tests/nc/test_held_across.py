"""What override 0 carries across a place that is to be passed, or so near to it that it cannot be passed any more.

A hold brakes without regard to the joint or to the target of a continuous move. For some milliseconds before such a
place its acceleration cannot be taken back in time, and to pass it with one is not what a joint is. Nothing turns back
for it then: the motions hand over where the acceleration has been taken back, or at rest.
"""

from itertools import pairwise

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from motionlayer import Simulation
from motionlayer.command import ErrorId
from motionlayer.nc import Axis, AxisCommand, BufferMode
from motionlayer.verify import assert_valid
from tests.effort import examples, thinned
from tests.machines import finish, ready

JOINT = 200.0
BLENDS = [mode for mode in BufferMode if mode not in (BufferMode.ABORTING, BufferMode.BUFFERED)]
FOLLOWERS = ["forwards", "backwards", "continuous", "velocity", "halt"]
RISES = range(1, 120, 7)
"""Ticks of a hold that begins 1 mm before the joint: braking before it, across it, at rest behind it."""


def chained(follower: str, mode: BufferMode, place: float | None = None) -> tuple[Simulation, Axis, list[AxisCommand]]:
    """Return a run, its axis, and the commands of a running and a blended motion."""
    run, x = ready()
    first = x.move_absolute(JOINT, velocity=400.0)
    match follower:
        case "forwards":
            second = x.move_absolute(350.0, velocity=300.0, buffer_mode=mode, blending_position=place)
        case "backwards":
            second = x.move_absolute(20.0, velocity=300.0, buffer_mode=mode, blending_position=place)
        case "continuous":
            second = x.move_continuous_absolute(250.0, 200.0, buffer_mode=mode, blending_position=place)
        case "velocity":
            second = x.move_velocity(350.0, buffer_mode=mode, blending_position=place)
        case _:
            second = x.halt(buffer_mode=mode, blending_position=place)
    assert second.error is None
    return run, x, [first, second]


def ended(follower: AxisCommand) -> bool:
    """Tell whether a follower is done; an endless one ends on the software limit."""
    return follower.done or (follower.error is not None and follower.error.id is ErrorId.MAXIMUM_PASSED)


def run_out(run: Simulation, follower: AxisCommand) -> None:
    """Run until a follower has ended, for three seconds at most, and on for a moment."""
    for _ in range(30):
        run.step(100)
        if not follower.busy:
            return


def hold(run: Simulation, x: Axis, ticks: int, factor: float = 1.0) -> None:
    """Hold the axis at override 0, and let it go on."""
    x.set_override(0.0)
    run.step(ticks)
    x.set_override(factor)


def assert_never_turned(run: Simulation) -> None:
    """Assert that the axis has gone in positive direction alone."""
    assert all(after >= earlier for earlier, after in pairwise(run.trace["X.set_position"].tolist()))


@pytest.mark.parametrize("follower", FOLLOWERS)
@pytest.mark.parametrize("ticks", thinned([*RISES, 2, 3, 30, 60]))
def test_a_joint_that_a_hold_carries_the_axis_across_is_not_come_back_to(follower: str, ticks: int) -> None:
    run, x, (first, second) = chained(follower, BufferMode.BLENDING_PREVIOUS)
    finish(run, x.passes(JOINT - 1.0))
    hold(run, x, ticks)
    run_out(run, second)
    assert first.done
    assert ended(second)
    if follower != "backwards":  # that one rests at the joint: a hold stops before it
        assert_never_turned(run)
    assert_valid(run.trace)


@pytest.mark.parametrize(("ticks", "rests"), [(20, False), (64, False), (119, True), (400, True)])
def test_the_follower_takes_over_where_the_acceleration_has_been_taken_back(ticks: int, rests: bool) -> None:
    """And the first command is done there, inside a cycle, at rest where nothing is left of the velocity."""
    run, x, (first, _) = chained("forwards", BufferMode.BLENDING_PREVIOUS)
    finish(run, x.passes(JOINT - 1.0))
    hold(run, x, ticks)
    v, a, released = x.set_velocity, x.set_acceleration, run.time
    assert x.set_position > JOINT
    remains = v - a * a / 2e5
    assert (remains <= 0.0) is rests
    finish(run, first)
    assert first.end_time == pytest.approx(released + abs(a) / 1e5, abs=1e-9)
    taken_over = run.tick - 1
    run.step(3000)
    last = run.trace.plans[-1]
    assert (last.tick, last.target) == (taken_over, 350.0)
    assert last.pieces[0, 2:4].tolist() == pytest.approx([max(remains, 0.0), 0.0], abs=1e-6)
    assert_never_turned(run)
    assert_valid(run.trace)


def test_a_joint_too_near_for_the_acceleration_to_be_taken_back_is_as_good_as_passed() -> None:
    run, x, (first, second) = chained("forwards", BufferMode.BLENDING_PREVIOUS)
    finish(run, x.passes(JOINT - 8.0))
    x.set_override(0.0)
    finish(run, x.passes(JOINT - 1.0))
    room, settling = JOINT - x.set_position, x.set_velocity * abs(x.set_acceleration) / 1e5
    assert x.set_velocity > 0.0 > x.set_acceleration
    assert settling > 2.0 * room
    x.set_override(1.0)
    finish(run, first)
    assert JOINT < x.set_position < JOINT + settling
    finish(run, second)
    run.step(2)
    assert_never_turned(run)
    assert_valid(run.trace)


@pytest.mark.parametrize("factors", [(0.3, 1.0), (0.01, 0.5, 1.0), (0.5, 0.0, 1.0)])
def test_an_override_that_changes_again_before_the_follower_has_taken_over(factors: tuple[float, ...]) -> None:
    for ticks in (10, 60, 119):
        run, x, (first, second) = chained("forwards", BufferMode.BLENDING_PREVIOUS)
        finish(run, x.passes(JOINT - 1.0))
        hold(run, x, ticks, factors[0])
        for factor in factors[1:]:
            run.step(2)
            x.set_override(factor)
        run_out(run, second)
        assert first.done
        assert second.done
        assert_never_turned(run)
        assert_valid(run.trace)


def test_a_follower_that_could_not_brake_any_more_takes_over_at_rest() -> None:
    """Nobody is carried past a software limit to save a stop: the target of the follower lies on it."""
    run, x = ready(software_limit_max=JOINT + 25.0)
    first = x.move_absolute(JOINT, velocity=400.0)
    second = x.move_absolute(JOINT + 25.0, velocity=400.0, buffer_mode=BufferMode.BLENDING_PREVIOUS)
    finish(run, x.passes(JOINT - 1.0))
    hold(run, x, 70)
    finish(run, first)
    assert x.set_velocity == pytest.approx(0.0, abs=0.1)
    finish(run, second)
    run.step(2)
    assert_never_turned(run)
    assert_valid(run.trace)


def test_a_relative_follower_still_counts_from_the_joint() -> None:
    run, x = ready()
    x.move_absolute(JOINT, velocity=400.0)
    second = x.move_relative(100.0, velocity=300.0, buffer_mode=BufferMode.BLENDING_PREVIOUS)
    finish(run, x.passes(JOINT - 1.0))
    hold(run, x, 40)
    finish(run, second)
    assert x.set_position == JOINT + 100.0
    run.step(2)
    assert_valid(run.trace)


@pytest.mark.parametrize("ticks", [30, 64, 119, 400])
def test_a_continuous_follower_is_not_turned_round_for_a_target_that_was_passed_too(ticks: int) -> None:
    run, x = ready(software_limit_max=None)
    first = x.move_absolute(JOINT, velocity=400.0)
    onward = x.move_continuous_absolute(JOINT + 3.0, 150.0, buffer_mode=BufferMode.BLENDING_PREVIOUS)
    finish(run, x.passes(JOINT - 1.0))
    hold(run, x, ticks)
    assert x.set_position > JOINT + 3.0
    run.step(1000)
    assert first.done
    assert onward.in_end_velocity
    assert_never_turned(run)
    assert_valid(run.trace)


def test_a_follower_that_is_commanded_in_the_hold_takes_over_behind_its_joint_too() -> None:
    run, x = ready()
    first = x.move_absolute(300.0, velocity=400.0)
    finish(run, x.passes(JOINT - 1.0))
    x.set_override(0.0)
    run.step(1)
    place = x.set_position + 5.0
    second = x.move_absolute(350.0, velocity=300.0, buffer_mode=BufferMode.BLENDING_HIGH, blending_position=place)
    run.step(60)
    assert x.set_position > place
    assert first.busy
    x.set_override(1.0)
    finish(run, second)
    assert first.done
    run.step(2)
    assert_never_turned(run)
    assert_valid(run.trace)


@pytest.mark.parametrize("follower", ["forwards", "backwards"])
@pytest.mark.parametrize("ticks", thinned(RISES, 2))
def test_a_blending_position_before_the_target_is_met_too(follower: str, ticks: int) -> None:
    """Also where the hold ends between the blending position and the target of the running motion."""
    run, x, (first, second) = chained(follower, BufferMode.BLENDING_LOW, place=180.0)
    finish(run, x.passes(179.0))
    hold(run, x, ticks)
    run_out(run, second)
    assert first.done
    assert second.done
    assert_valid(run.trace)


@pytest.mark.parametrize("before", [0.1, 1.0, 4.0, 10.0, 20.0])
@pytest.mark.parametrize("ticks", thinned(RISES))
def test_a_continuous_move_is_not_turned_round_for_its_target(before: float, ticks: int) -> None:
    run, x = ready(software_limit_max=None)
    move = x.move_continuous_absolute(JOINT, 150.0, velocity=400.0)
    finish(run, x.passes(JOINT - before))
    hold(run, x, ticks)
    run.step(1500)
    assert move.in_end_velocity
    assert x.set_velocity == 150.0
    assert all(after >= earlier for earlier, after in pairwise(run.trace["X.set_position"].tolist()))
    assert_valid(run.trace)


@settings(max_examples=examples(40), deadline=None)
@given(
    follower=st.sampled_from(FOLLOWERS),
    mode=st.sampled_from(BLENDS),
    place=st.sampled_from([None, 60.0, 150.0, 199.0]),
    before=st.floats(0.01, 40.0),
    factors=st.lists(st.tuples(st.integers(1, 60), st.floats(0.05, 1.0), st.integers(1, 40)), min_size=1, max_size=4),
)
@example("forwards", BufferMode.BLENDING_PREVIOUS, None, 1.0, [(1, 0.5, 1)])
@example("forwards", BufferMode.BLENDING_HIGH, 150.0, 2.0, [(40, 1.0, 2), (30, 0.5, 1), (9, 1.0, 1)])
def test_holds_round_a_joint_end_nothing_in_an_error(
    follower: str,
    mode: BufferMode,
    place: float | None,
    before: float,
    factors: list[tuple[int, float, int]],
) -> None:
    run, x, (first, second) = chained(follower, mode, place)
    finish(run, x.passes((place or JOINT) - before))
    for ticks, factor, going in factors:
        hold(run, x, ticks, factor)
        run.step(going)
    x.set_override(1.0)
    run_out(run, second)
    assert first.done
    assert ended(second)
    assert_valid(run.trace)
