"""When a run ends: not while an axis brakes; and what it says about axes that go on."""

import pytest

from motionlayer import AxisState, CommandAborted, Simulation, all_of
from motionlayer.drive import Fault, FaultKind
from motionlayer.event import Device, Event, Kind, Level
from motionlayer.machine import replay
from motionlayer.verify import assert_valid
from tests.machines import SWITCH, machine

SERVO = {"kind": "servo", "position_gain": 80.0, "time_constant": 0.002}


def two(**changes: object) -> Simulation:
    run = Simulation(machine(2, **changes))
    for axis in run.axes.values():
        axis.enable()
    run.step(2)
    return run


def at_rest(run: Simulation) -> bool:
    return all(axis.set_velocity == axis.set_acceleration == 0.0 for axis in run.axes.values())


def warnings(run: Simulation) -> list[Event]:
    return [one for one in run.events.last(Level.WARNING) if one.kind is Kind.MESSAGE]


def stop_in_motion(run: Simulation) -> None:
    """Stop all axes after 0.1 s, as an operator does."""
    run.step(100)
    assert not at_rest(run)
    run.emergency_stop()


def test_an_emergency_stop_is_waited_for_by_all_axes_though_the_only_program_owns_one() -> None:
    """X belongs to the program that is left, Y to one that has ended."""
    run = two()
    x, y = run.axes.values()

    async def ended() -> None:
        y.move_velocity(400.0)

    async def only() -> None:
        with pytest.raises(CommandAborted):
            await x.move_absolute(300.0, velocity=50.0)
        raise LookupError("aborted")

    run.start(ended())
    failing = run.start(only())
    stop_in_motion(run)
    assert run.run(time=5.0)
    assert run.ending == "all programs ended"
    assert run.failures == [failing]
    assert at_rest(run)
    assert [axis.state for axis in (x, y)] == [AxisState.STANDSTILL] * 2
    assert warnings(run) == []
    assert_valid(run.trace)


def test_a_halt_a_stop_and_an_error_at_the_end_of_a_program_are_waited_for() -> None:
    run = two()
    x, y = run.axes.values()

    async def program() -> None:
        x.move_velocity(400.0)
        y.move_velocity(-300.0)
        await run.sleep(0.1)
        x.halt()
        y.stop()

    run.run(program())
    assert at_rest(run)
    assert warnings(run) == []
    assert_valid(run.trace)


def test_a_drive_that_fails_at_the_end_of_a_program_is_waited_for() -> None:
    run = two(drive=SERVO)
    x, _ = run.axes.values()

    async def program() -> None:
        with pytest.raises(Exception, match="drive"):
            await x.move_velocity(300.0)

    run.inject("X", Fault(FaultKind.DRIVE_ERROR), run.tick + 100)
    run.run(program())
    assert x.state is AxisState.ERRORSTOP
    assert at_rest(run)
    assert_valid(run.trace)


def test_the_time_ends_a_run_and_a_stop_does_though_an_axis_brakes() -> None:
    run = two()
    x, _ = run.axes.values()

    async def program() -> None:
        x.move_velocity(400.0)
        await run.sleep(0.1)
        x.halt()

    assert not run.run(program(), time=0.12)
    assert run.ending == "time over"
    assert x.braking
    run.stop("enough")
    assert not run.run(time=1.0)
    assert (run.ending, x.braking) == ("enough", True)


def test_a_held_stop_and_a_homing_that_turns_do_not_count_as_brakes_for_ever() -> None:
    run = two(home=SWITCH)
    x, y = run.axes.values()

    async def program() -> None:
        y.home()
        x.move_velocity(400.0)
        await run.sleep(0.1)
        x.stop(hold=True)

    assert run.run(program(), time=20.0)
    assert x.state is AxisState.STOPPING
    assert at_rest(run) == (y.state is not AxisState.HOMING)
    (warning,) = warnings(run)
    assert warning.text.startswith("still moves: Y.home goes on")


def test_axes_that_go_on_without_a_program_are_named_once_and_a_replay_says_the_same() -> None:
    async def program(run: Simulation) -> None:
        x, y = run.axes.values()
        await all_of(x.enable(), y.enable())
        x.move_velocity(20.0)
        y.move_absolute(300.0)
        await run.sleep(0.05)

    run = Simulation(machine(2))
    main = run.start(program(run), "program")
    run.run()
    run.step(3)
    assert main.done
    first, second = warnings(run)
    assert (first.source, second.source) == ("X", "Y")
    assert first.text == (
        "still moves: X.move_velocity goes on, and the last program has ended; await it, or halt() before"
    )
    assert (first.tick, first.device, second.device) == (52, Device.Axis + 1, Device.Axis + 2)
    trace = run.trace
    assert_valid(trace)
    again = replay(trace, programs=[program])
    assert again.same, again.difference


def test_who_steps_without_programs_is_told_nothing() -> None:
    run = two()
    run.axes["X"].move_velocity(20.0)
    run.step(100)
    assert warnings(run) == []


def test_an_advance_goes_on_until_what_brakes_rests() -> None:
    run = two()
    x = run.axes["X"]

    async def program() -> None:
        x.move_velocity(400.0)
        await run.sleep(0.1)
        x.halt()

    run.start(program())
    assert run.advance() is None
    assert at_rest(run)
    assert run.tick > 150
    assert run.advance() is None
