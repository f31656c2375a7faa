"""Moves in motion that overshoot a target ahead, and turn back, say so: warning 0x427E."""

import pytest

from motionlayer import Simulation
from motionlayer.command import ErrorId
from motionlayer.event import Level
from motionlayer.nc import BufferMode
from motionlayer.verify import assert_valid
from tests.machines import finish, ready


def warned(run: Simulation, number: int) -> bool:
    """Tell whether there was the warning for a command."""
    found = [event for event in run.trace.events if event.code == ErrorId.AS_GOOD_AS_POSSIBLE]
    assert all(event.level is Level.WARNING and event.source == "X" for event in found)
    return any(event.command == number for event in found)


@pytest.mark.parametrize(
    ("target", "turns", "warns"), [(0.0, True, False), (70.0, True, False), (95.0, True, True), (395.0, False, False)]
)
def test_an_absolute_move_warns_if_it_turns_back_unasked(target: float, turns: bool, warns: bool) -> None:
    run, x = ready()
    x.move_absolute(350.0)
    run.step(250)
    speed, begin = x.set_velocity, x.set_position
    move = x.move_absolute(target)
    assert move.error is None
    finish(run, move)
    assert x.set_position == target
    run.step(2)
    trace = run.trace
    assert (trace["X.set_velocity"].min() < 0.0) == turns
    assert speed > 0.0
    assert (target > begin) == (warns or not turns)
    assert warned(run, move.number) == warns
    assert_valid(trace)


def test_nothing_turns_back_from_rest_or_at_a_joint() -> None:
    run, x = ready()
    first = x.move_absolute(100.0)
    second = x.move_absolute(-50.0, buffer_mode=BufferMode.BLENDING_HIGH)
    finish(run, second)
    run.step(2)
    assert_valid(run.trace)
    assert not warned(run, first.number)
    assert not warned(run, second.number)


@pytest.mark.parametrize(("way", "warns"), [(-40.0, False), (0.5, True)])
def test_a_continuous_motion_warns_too(way: float, warns: bool) -> None:
    run, x = ready()
    x.move_velocity(200.0)
    run.step(150)
    back = x.move_continuous_absolute(x.set_position + way, 1.0)
    run.step(400)
    halt = x.halt()
    finish(run, halt)
    run.step(2)
    assert_valid(run.trace)
    assert warned(run, back.number) == warns
