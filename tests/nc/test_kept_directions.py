"""What is to be passed in motion is passed in the direction that was decided, whatever the override does on the way.

Near such a place an axis can no longer come to rest before it. Who asks anew where it arrives from finds that it has to
turn round.
"""

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from motionlayer import Simulation
from motionlayer.nc import Axis, AxisCommand, BufferMode
from motionlayer.verify import assert_valid
from tests.effort import examples, thinned
from tests.machines import LINEAR, finish, ready

JOINT, END = 200.0, 350.0
WEAK, STRONG = 300.0, LINEAR["max_deceleration"]
"""At 400 mm/s the weak brake takes 270 mm: it ends outside the software limit."""

FACTORS = st.sampled_from([0.02, 0.3, 0.5, 0.9, 1.0])


def weak_chain(follower: str = "move_absolute", velocity: float = 400.0) -> tuple[Simulation, Axis, list[AxisCommand]]:
    """Return a chain whose first motion has a weak brake, and its two commands."""
    run, x = ready()
    first = x.move_absolute(JOINT, velocity=velocity, deceleration=WEAK)
    mode, strong = BufferMode.BLENDING_HIGH, STRONG
    match follower:
        case "move_absolute":
            second = x.move_absolute(END, velocity=velocity, deceleration=strong, buffer_mode=mode)
        case "move_continuous_absolute":
            second = x.move_continuous_absolute(230.0, 350.0, velocity=velocity, deceleration=strong, buffer_mode=mode)
        case "move_velocity":
            second = x.move_velocity(velocity, deceleration=strong, buffer_mode=mode)
        case _:
            second = x.halt(deceleration=strong, buffer_mode=mode)
    assert second.error is None
    return run, x, [first, second]


def knob(run: Simulation, x: Axis, changes: list[tuple[float, int]]) -> None:
    """Set an override, for so many ticks each, and then 1."""
    for factor, ticks in changes:
        x.set_override(factor)
        run.step(ticks)
    x.set_override(1.0)


FOLLOWERS = ["move_absolute", "move_continuous_absolute", "move_velocity", "halt"]


@pytest.mark.parametrize("follower", FOLLOWERS)
@pytest.mark.parametrize("place", thinned([100.0, 199.0, 199.99], 2))
@pytest.mark.parametrize("factor", [0.999, 0.5, 0.02])
def test_a_joint_is_passed_in_the_direction_that_was_decided(follower: str, place: float, factor: float) -> None:
    run, x, (first, second) = weak_chain(follower)
    finish(run, x.passes(place))
    knob(run, x, [(factor, 40)])
    run.step(2000)
    assert first.done
    assert not second.busy
    assert (run.trace["X.set_velocity"] >= 0.0).all()
    assert_valid(run.trace)


@pytest.mark.parametrize("follower", FOLLOWERS)
@pytest.mark.parametrize("ticks", [1, 10, 500])
def test_what_the_override_holds_before_a_joint_brakes_as_hard_as_its_follower(follower: str, ticks: int) -> None:
    """Alone the running motion would come to rest outside; only the way of both was checked."""
    run, x, (first, second) = weak_chain(follower)
    finish(run, x.passes(199.0))
    knob(run, x, [(0.0, ticks), (0.5, 30)])
    run.step(3000)
    assert first.done
    assert not second.busy
    assert run.trace["X.set_position"].max() <= LINEAR["software_limit_max"]
    assert_valid(run.trace)


def test_a_motion_that_can_still_rest_before_its_joint_is_held_by_its_own_brake() -> None:
    run, x, _ = weak_chain(velocity=200.0)
    finish(run, x.passes(100.0))
    knob(run, x, [(0.0, 1000)])
    (held,) = (plan for plan in run.trace.plans if plan.kind == "stop")
    assert held.deceleration == WEAK
    assert x.set_position < JOINT


@pytest.mark.parametrize("brake", ["halt", "stop"])
def test_a_brake_before_a_joint_is_no_weaker_than_the_motion_behind_it(brake: str) -> None:
    run, x, _ = weak_chain()
    finish(run, x.passes(199.0))
    command: AxisCommand = getattr(x, brake)()
    finish(run, command)
    assert x.set_position < END
    run.step(2)
    assert_valid(run.trace)


@settings(max_examples=examples(25), deadline=None)
@given(
    end_velocity=st.floats(50.0, 400.0),
    deceleration=st.floats(100.0, STRONG),
    before=st.floats(0.01, 150.0),
    factors=st.lists(st.tuples(FACTORS, st.integers(1, 30)), max_size=4),
)
@example(end_velocity=40.0, deceleration=100.0, before=2.0, factors=[(0.9, 250)])
def test_a_target_that_is_passed_with_an_end_velocity_stays_ahead(
    end_velocity: float, deceleration: float, before: float, factors: list[tuple[float, int]]
) -> None:
    """It once turned round and went on backwards, without end."""
    run, x = ready(software_limit_max=None)
    move = x.move_continuous_absolute(JOINT, end_velocity, velocity=300.0, deceleration=deceleration)
    finish(run, x.passes(JOINT - before))
    knob(run, x, factors)
    run.step(4000)
    assert move.in_end_velocity
    assert (run.trace["X.set_velocity"] >= 0.0).all()
    assert_valid(run.trace)


@pytest.mark.parametrize("before", [1.0, 10.0, 0.01])
def test_a_target_behind_which_the_override_held_the_axis_is_not_gone_back_to(before: float) -> None:
    run, x = ready(software_limit_max=None)
    move = x.move_continuous_absolute(JOINT, 300.0, velocity=300.0, deceleration=1000.0)
    finish(run, x.passes(JOINT - before))
    knob(run, x, [(0.0, 600)])
    run.step(600)
    assert move.in_end_velocity
    assert (run.trace["X.set_velocity"] >= 0.0).all()
    assert_valid(run.trace)


def test_a_follower_passes_its_target_straight_on_where_it_could_not_rest_before_it() -> None:
    """It enters as fast as it can still slow down to its end velocity; coming to rest takes longer."""
    run, x = ready(software_limit_max=None)
    x.move_absolute(100.0, velocity=300.0)
    mode = BufferMode.BLENDING_PREVIOUS
    after = x.move_continuous_absolute(110.0, 250.0, velocity=300.0, deceleration=2000.0, buffer_mode=mode)
    run.step(1000)
    assert after.in_end_velocity
    assert (run.trace["X.set_velocity"] >= 0.0).all()
    assert_valid(run.trace)


@pytest.mark.parametrize("shift", [5.0, -150.0])
def test_a_target_that_was_passed_is_shifted_with_the_coordinate(shift: float) -> None:
    """The check of the shifted motion does not go back to it either."""
    run, x = ready(software_limit_min=None, software_limit_max=None)
    move = x.move_continuous_absolute(100.0, 80.0)
    finish(run, x.passes(101.0))
    run.step(50)
    shifted = x.define_position(shift, relative=True)
    assert shifted.done
    run.step(200)
    assert move.in_end_velocity
    assert x.set_velocity == 80.0
    assert_valid(run.trace)


@pytest.mark.parametrize("room", [0.0, 1e-6, 1.0])
@pytest.mark.parametrize("ticks", [5, 160, 265, 290])
def test_a_target_before_a_software_limit_is_passed_no_faster_than_can_be_braked(room: float, ticks: int) -> None:
    """Rest can be nearer than any slow motion: the nearest speed that can be reached is not a faster one then."""
    run, x = ready()
    limit = LINEAR["software_limit_max"]
    x.move_continuous_absolute(limit - room, 500.0, velocity=500.0, jerk=2e4)
    for _ in range(40):
        run.step(ticks // 5)
        x.set_override(0.97 if x.override == 1.0 else 1.0)
    run.step(2000)
    assert run.trace["X.set_position"].max() <= limit
    assert x.set_position == limit
    assert_valid(run.trace)
