"""Moves that can come to their target only by turning back say so: warning 0x427E."""

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


@pytest.mark.parametrize(("target", "turns"), [(0.0, True), (70.0, True), (395.0, False)])
def test_an_absolute_move_warns_if_it_turns_back(target: float, turns: bool) -> None:
    run, x = ready()
    x.move_absolute(350.0)
    run.step(250)
    speed = x.set_velocity
    move = x.move_absolute(target)
    assert move.error is None
    finish(run, move)
    assert x.set_position == target
    run.step(2)
    trace = run.trace
    assert (trace["X.set_velocity"].min() < 0.0) == turns
    assert speed > 0.0
    assert warned(run, move.number) == turns
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


def test_a_continuous_motion_behind_warns_too() -> None:
    run, x = ready()
    x.move_velocity(200.0)
    run.step(150)
    back = x.move_continuous_absolute(-20.0, 50.0)
    run.step(400)
    halt = x.halt()
    finish(run, halt)
    run.step(2)
    assert_valid(run.trace)
    assert warned(run, back.number)
