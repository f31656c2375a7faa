"""The same motion in another unit: what is taken, what is refused and how long it takes do not depend on the unit."""

from typing import Any, NamedTuple

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from motionlayer.command import ErrorId
from motionlayer.nc import BufferMode, Direction, RampKeywords
from motionlayer.profile import RANGES
from motionlayer.verify import assert_valid
from tests.effort import examples
from tests.machines import LINEAR, error_of, ready

SCALED = [key for key in LINEAR if key.startswith(("max_", "software_"))]
UNITS = [2.0**-40, 2.0**-10, 2.0**10, 2.0**30]
"""Powers of two: nothing is rounded otherwise for the other unit."""


class Told(NamedTuple):
    """What became of a motion: errors, times, and end positions in units of its axis."""

    errors: list[ErrorId | None]
    times: list[float | None]
    place: float


def play(unit: float, target: float, moves: list[tuple[int, str, float, float]], feed: tuple[bool, bool]) -> Told:
    """Command moves after some ticks each; all ways and velocities are multiples of the unit."""
    run, x = ready(**{key: LINEAR[key] * unit for key in SCALED})
    x.enable(positive=feed[0], negative=feed[1])
    commands = [x.move_absolute(target * unit)]
    for ticks, name, value, share in moves:
        run.step(ticks)
        if name == "override":
            x.set_override(share)
            continue
        velocity = {"velocity": share * 500.0 * unit, "deceleration": share * 6000.0 * unit}
        call: dict[str, Any] = {
            "absolute": lambda value=value, v=velocity: x.move_absolute(value * unit, **v),
            "blend": lambda value=value, v=velocity: x.move_relative(
                value * unit, buffer_mode=BufferMode.BLENDING_LOW, **v
            ),
            "up": lambda share=share: x.move_velocity(share * 500.0 * unit, Direction.POSITIVE),
            "halt": lambda share=share: x.halt(deceleration=share * 6000.0 * unit),
        }
        commands.append(call[name]())
    x.set_override(1.0)
    run.step(3000)
    told = Told([error_of(one) for one in commands], [one.end_time for one in commands], x.set_position / unit)
    assert_valid(run.trace)
    return told


def in_range(distance: float) -> float:
    """Return 0 for a distance that is finer than the published range in one of the units."""
    return distance if abs(distance) * min(UNITS) >= RANGES.smallest else 0.0


MOVE = st.tuples(
    st.integers(0, 200),
    st.sampled_from(["absolute", "blend", "up", "halt", "override"]),
    st.one_of(st.floats(-120.0, 420.0).map(in_range), st.sampled_from([-100.0, 400.0, 0.0])),
    st.sampled_from([1.0, 0.5, 0.05]),
)


@settings(max_examples=examples(15), deadline=None, phases=(Phase.explicit, Phase.reuse, Phase.generate))
@given(
    target=st.floats(-100.0, 400.0).map(in_range),
    moves=st.lists(MOVE, min_size=1, max_size=4),
    feed=st.sampled_from([(True, True), (True, True), (True, False)]),
    unit=st.sampled_from(UNITS),
)
def test_motion_is_the_same_in_every_unit(
    target: float, moves: list[tuple[int, str, float, float]], feed: tuple[bool, bool], unit: float
) -> None:
    here, there = play(1.0, target, moves, feed), play(unit, target, moves, feed)
    assert there.errors == here.errors
    for one, other in zip(here.times, there.times, strict=True):
        assert (one is None) == (other is None)
        assert one is None or other == pytest.approx(one, rel=1e-12)
    assert there.place == pytest.approx(here.place, rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("unit", [1e-9, 1e-3, 1.0, 1e3, 1e9])
def test_a_way_beyond_the_limit_is_refused_however_small_its_unit_makes_it(unit: float) -> None:
    """The blur of the limits is a share of what is compared: in metres a micrometre is one as it is in millimetres."""
    run, x = ready(**{key: LINEAR[key] * unit for key in SCALED})
    x.move_velocity(500.0 * unit)
    while x.set_position < 340.0 * unit:
        run.step()
    overshoots = x.move_absolute(390.0 * unit, deceleration=1500.0 * unit)
    assert error_of(overshoots) is ErrorId.OVERRUN


@settings(max_examples=examples(25), deadline=None, phases=(Phase.explicit, Phase.reuse, Phase.generate))
@given(
    ticks=st.integers(150, 800),
    share=st.floats(0.05, 1.0),
    goal=st.floats(-100.0, 400.0),
    order=st.booleans(),
    endless=st.booleans(),
)
def test_a_weaker_move_and_override_0_in_one_tick_keep_to_the_software_limits(
    ticks: int, share: float, goal: float, order: bool, endless: bool
) -> None:
    """The hold brakes with the dynamics of the new move; that it can is what the move was checked for."""
    run, x = ready()
    x.move_velocity(500.0)
    run.step(ticks)
    if order:
        x.set_override(0.0)
    weak: RampKeywords = {"acceleration": share * 5000.0, "deceleration": share * 6000.0, "jerk": share * 1e5}
    if endless:
        x.move_velocity(500.0 * share, Direction.NEGATIVE, **weak)
    else:
        x.move_absolute(goal, velocity=500.0 * share, **weak)
    x.set_override(0.0)
    run.step(1500)
    trace = run.trace
    assert trace["X.set_position"].max() <= 400.0 * (1.0 + 1e-9)
    assert trace["X.set_position"].min() >= -100.0 * (1.0 + 1e-9)
    assert_valid(trace)
