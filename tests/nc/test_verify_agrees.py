"""Ordinary programs whose traces `verify` must find valid."""

from motionlayer.command import ErrorId
from motionlayer.verify import assert_valid
from tests.machines import one_axis, play, ready


def test_a_move_and_then_a_homing() -> None:
    run, x = ready()

    async def program() -> None:
        await x.move_absolute(10.0)
        await x.home()

    play(run, program)
    run.step(2)
    assert_valid(run.trace)


def test_a_move_in_the_tick_in_which_the_drive_becomes_ready() -> None:
    run, x = one_axis()

    async def program() -> None:
        x.enable()
        await run.until(lambda: x.enabled)
        await x.move_absolute(10.0)

    play(run, program)
    run.step(2)
    assert_valid(run.trace)


def test_an_error_in_the_tick_of_a_homing() -> None:
    run, x = ready()
    x.home(5.0)
    x.fault(ErrorId.INTERNAL)
    run.step(2)
    assert_valid(run.trace)


def test_a_homing_and_then_a_move() -> None:
    run, x = ready()

    async def program() -> None:
        await x.home(5.0)
        await x.move_absolute(10.0)

    play(run, program)
    run.step(2)
    assert_valid(run.trace)


def test_a_run_that_ends_in_the_tick_of_a_command() -> None:
    run, x = ready()

    async def program() -> None:
        await x.move_absolute(10.0)
        x.move_absolute(20.0)

    play(run, program)
    assert_valid(run.trace)
