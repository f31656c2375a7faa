"""What an axis takes at the edges of the published ranges, and how it refuses what lies beyond."""

import math
from collections.abc import Callable

import pytest

from motionlayer.command import ErrorId
from motionlayer.nc import Axis, AxisCommand, BufferMode
from motionlayer.profile import RANGES
from motionlayer.verify import assert_valid
from tests.machines import error_of, finish, ready

FREE = {"software_limit_min": None, "software_limit_max": None}
"""No software limits."""

SLOW = 10.0
"""mm/s: gained and lost in 0.014 s."""

FARTHEST = RANGES.duration * SLOW
"""mm; a move at `SLOW` over this way takes a little more than is allowed."""

BELOW = math.nextafter(RANGES.smallest, 0.0)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_the_shortest_way_is_gone_exactly_and_anything_shorter_refused(sign: float) -> None:
    run, x = ready()
    there = x.move_absolute(sign * RANGES.smallest)
    finish(run, there)
    assert x.set_position == sign * RANGES.smallest
    back = x.move_absolute(0.0)
    finish(run, back)
    assert x.set_position == 0.0
    for tiny in (BELOW, 1e-107, 5e-324):
        refused = x.move_absolute(sign * tiny)
        assert refused.error is not None
        assert refused.error.id is ErrorId.DISTANCE_TOO_SHORT
        assert f"way = {tiny}, allowed: 0, or from 1e-60 mm on" in refused.error.text
    assert error_of(x.move_relative(sign * BELOW)) is ErrorId.DISTANCE_TOO_SHORT
    run.step(2)
    assert_valid(run.trace)


def test_a_residue_beside_an_ordinary_position_is_no_way_at_all() -> None:
    run, x = ready()
    finish(run, x.move_absolute(100.0))
    finish(run, x.move_relative(1e-107))
    assert x.set_position == 100.0
    run.step(2)
    assert_valid(run.trace)


def test_a_follower_is_judged_from_where_it_begins() -> None:
    run, x = ready()
    first = x.move_absolute(50.0)
    assert error_of(x.move_relative(RANGES.smallest, buffer_mode=BufferMode.BUFFERED)) is None
    finish(run, first)
    first = x.move_absolute(0.0)
    tiny = x.move_absolute(BELOW, buffer_mode=BufferMode.BUFFERED)
    far = x.move_absolute(FARTHEST, velocity=SLOW, buffer_mode=BufferMode.BUFFERED)
    assert error_of(tiny) is ErrorId.DISTANCE_TOO_SHORT
    assert error_of(far) is ErrorId.TARGET_OUTSIDE_LIMITS
    finish(run, first)
    run.step(2)
    assert_valid(run.trace)


Call = Callable[[Axis], AxisCommand]

TOO_LONG: dict[str, Call] = {
    "a way": lambda x: x.move_absolute(1e12, velocity=SLOW),
    "a way just too far": lambda x: x.move_absolute(FARTHEST, velocity=SLOW),
    "hardly any jerk": lambda x: x.move_absolute(100.0, jerk=1e-50),
    "hardly any velocity": lambda x: x.move_absolute(1.0, velocity=RANGES.smallest),
    "a velocity with hardly any jerk": lambda x: x.move_velocity(100.0, jerk=1e-50),
    "a place to pass": lambda x: x.move_continuous_absolute(FARTHEST, SLOW, velocity=SLOW),
}


LONG: dict[str, Call] = {
    "a way just near enough": lambda x: x.move_absolute(FARTHEST - SLOW, velocity=SLOW),
    "a velocity that lasts": lambda x: x.move_velocity(RANGES.smallest),
    "a place to pass": lambda x: x.move_continuous_absolute(FARTHEST - SLOW, SLOW, velocity=SLOW),
}


@pytest.mark.parametrize("factor", [1.0, 0.5, 0.0])
@pytest.mark.parametrize("call", TOO_LONG.values(), ids=list(TOO_LONG))
def test_what_takes_longer_than_the_clock_is_fine_is_refused(call: Call, factor: float) -> None:
    run, x = ready(**FREE)
    x.set_override(factor)
    run.step()
    refused = call(x)
    assert refused.error is not None
    assert refused.error.id is ErrorId.POSITIONING_TOO_LONG
    assert "allowed: up to 9007199 s, 104 days" in refused.error.text
    run.step(20)
    assert x.set_position == 0.0
    assert_valid(run.trace)


@pytest.mark.parametrize("factor", [1.0, 1e-6, 0.0])
@pytest.mark.parametrize("call", LONG.values(), ids=list(LONG))
def test_what_takes_as_long_at_most_is_taken_whatever_the_override(call: Call, factor: float) -> None:
    run, x = ready(**FREE)
    x.set_override(factor)
    run.step()
    assert error_of(call(x)) is None
    run.step(20)
    assert_valid(run.trace)


def test_an_endless_motion_may_have_its_software_limit_farther_away_than_that() -> None:
    run, x = ready(software_limit_max=1e12)
    assert error_of(x.move_velocity(SLOW)) is None
    run.step(20)
    assert_valid(run.trace)


def test_an_end_velocity_that_is_gained_between_two_steps_of_the_clock() -> None:
    run, x = ready(**FREE)
    onward = x.move_continuous_absolute(0.5, 1e-50, velocity=SLOW)
    run.step(200)
    assert (x.set_position, x.set_velocity) == (0.5, 1e-50)
    assert onward.in_end_velocity
    assert_valid(run.trace)
