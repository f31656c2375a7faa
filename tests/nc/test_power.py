"""Power: enable, disable, and what they do to a motion."""

import pytest

from motionlayer import AxisState, Simulation
from motionlayer.command import ErrorId
from motionlayer.event import Kind
from motionlayer.nc import Axis, AxisCommand
from motionlayer.store import Q
from motionlayer.verify import assert_valid
from tests.machines import error_of, finish, one_axis, play, ready, state_of
from tests.nc.servos import servo_machine

S = AxisState


def test_enable_is_done_when_the_drive_is_ready() -> None:
    run, x = one_axis(start_position=33.0)

    async def program() -> None:
        assert state_of(x) is S.DISABLED
        command = x.enable()
        assert (command.busy, x.enabled) == (True, False)
        assert state_of(x) is S.DISABLED
        await command
        assert state_of(x) is S.STANDSTILL
        assert x.enabled
        assert x.set_position == x.actual_position == 33.0

    play(run, program)
    assert run.tick == 3  # called in 0, ready in 1, woken in 2


def test_a_drive_that_is_not_ready_yet_takes_no_motion() -> None:
    run = Simulation(servo_machine("X", drive={"ready_delay": 0.01}))
    x = run.axes["X"]
    assert error_of(x.move_absolute(5.0)) is ErrorId.NOT_ENABLED
    x.enable()
    for _ in range(9):
        assert error_of(x.move_absolute(5.0)) is ErrorId.NOT_READY_AT_START
        run.step()
    run.step(5)
    assert x.move_absolute(5.0).busy
    run.step(500)
    assert_valid(run.trace)


def test_enable_twice() -> None:
    run, x = one_axis()
    first, second = x.enable(), x.enable()
    assert first.aborted
    assert first.by is second
    run.step(2)
    assert second.done
    assert x.enable().done  # ready already
    assert state_of(x) is S.STANDSTILL


def test_enable_in_motion_changes_nothing() -> None:
    run, x = ready()
    move = x.move_absolute(300.0)
    run.step(50)
    table = x._store.table.copy()
    assert x.enable().done
    assert (x._store.table == table).all()
    finish(run, move)
    assert x.set_position == 300.0


def test_disable_at_rest() -> None:
    run, x = ready()
    command = x.disable()
    run.step(2)
    assert command.done
    assert state_of(x) is S.DISABLED
    assert error_of(x.move_absolute(10.0)) is ErrorId.NOT_ENABLED
    assert x.disable().done


@pytest.mark.parametrize("endless", [False, True])
def test_disable_in_motion_brakes_first(endless: bool) -> None:
    run, x = ready()
    move = x.move_velocity(300.0) if endless else x.move_absolute(300.0)
    run.step(100)
    command = x.disable()
    assert move.aborted
    assert move.by is command
    assert state_of(x) is S.STOPPING
    again = x.disable()
    assert command.aborted
    assert command.by is again
    while again.busy:
        if x.set_velocity != 0.0:
            assert x.enabled
            assert state_of(x) is S.STOPPING
        assert x.actual_position == pytest.approx(x.set_position, abs=0.5)
        run.step()
    assert state_of(x) is S.DISABLED
    assert not x.enabled
    position = x.set_position
    run.step(50)
    assert x.set_position == x.actual_position == position


@pytest.mark.parametrize("sequence", ["ede", "ed", "dede", "de", "eed"])
def test_the_last_request_of_a_tick_wins(sequence: str) -> None:
    run, x = one_axis() if sequence[0] == "e" else ready()
    commands: list[AxisCommand] = [x.enable() if letter == "e" else x.disable() for letter in sequence]
    run.step(3)
    assert state_of(x) is (S.STANDSTILL if sequence[-1] == "e" else S.DISABLED)
    assert x.enabled == (sequence[-1] == "e")
    assert commands[-1].done
    assert not any(command.busy for command in commands)


@pytest.mark.parametrize("call", ["move_absolute", "move_relative", "move_velocity", "halt", "stop", "home"])
def test_no_motion_begins_on_a_drive_that_was_told_to_switch_off(call: str) -> None:
    """Between the request and the drive's answer lies a tick: a motion begun in it would end in an error."""
    run, x = ready()
    disable = x.disable()
    command = getattr(x, call)(*[50.0] if call.startswith("move") else [])
    assert error_of(command) is ErrorId.NOT_ENABLED
    run.step(3)
    assert disable.done
    assert state_of(x) is S.DISABLED
    assert x.error is None
    assert x.set_position == 0.0


def test_disable_ends_a_homing() -> None:
    run, x = ready(home={"mode": "switch", "switch": -50.0, "velocity": 40.0})
    home = x.home()
    run.step(100)
    disable = x.disable()
    assert home.aborted
    assert home.by is disable
    finish(run, disable)
    assert state_of(x) is S.DISABLED
    assert not x.homed
    run.step(3000)
    assert x.set_position > -50.0


def test_disable_in_error_keeps_the_error() -> None:
    run, x = ready()
    x.move_velocity(300.0)
    run.step(100)
    x.fault(ErrorId.INTERNAL)
    disable = x.disable()
    assert state_of(x) is S.ERRORSTOP
    finish(run, disable)
    assert state_of(x) is S.ERRORSTOP
    assert not x.enabled
    assert error_of(x.enable()) is ErrorId.CANNOT_START
    finish(run, x.reset())
    assert state_of(x) is S.DISABLED
    finish(run, x.enable())
    assert state_of(x) is S.STANDSTILL


def test_disable_and_reset_in_error_in_motion_both_end() -> None:
    run, x = ready()
    x.move_velocity(300.0)
    run.step(100)
    x.fault(ErrorId.INTERNAL)
    disable, reset = x.disable(), x.reset()
    finish(run, disable)
    assert reset.done
    assert state_of(x) is S.DISABLED
    assert x.error is None


def lose_power(x: Axis) -> None:
    """What a drive does that switches itself off."""
    x._store.table[Q.ENABLE, 0] = 0.0


def test_power_lost_in_motion_is_an_error() -> None:
    run, x = ready()
    move = x.move_velocity(100.0)
    run.step(200)
    lose_power(x)
    run.step()
    assert error_of(move) is ErrorId.NOT_ENABLED
    assert state_of(x) is S.ERRORSTOP
    position = x.actual_position
    run.step(200)
    assert x.set_velocity == 0.0
    assert x.actual_position == position  # a drive without power stays where it is
    finish(run, x.reset())
    assert state_of(x) is S.DISABLED
    finish(run, x.enable())
    assert x.set_position == x.actual_position == position  # adopted, without a jump of the drive


def test_power_lost_at_rest() -> None:
    run, x = ready()
    lose_power(x)
    run.step()
    assert state_of(x) is S.DISABLED
    assert x.error is None


def test_every_power_command_ends_exactly_once_in_the_events() -> None:
    run, x = one_axis()
    for letter in "edeedd":
        x.enable() if letter == "e" else x.disable()
        run.step()
    run.step(5)
    events = run.events.last()
    accepted = [event.command for event in events if event.kind is Kind.ACCEPTED]
    ended = [event.command for event in events if event.kind in (Kind.DONE, Kind.ABORTED, Kind.ERROR)]
    assert sorted(accepted) == sorted(ended)
    assert len(accepted) == 6
