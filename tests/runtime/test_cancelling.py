"""Cancelling programs: where they wait, in the next tick, and never what they commanded (rule 4)."""

from typing import Any

import pytest

from motionlayer.runtime import Cancelled
from tests.machines import one_axis, play, ready


def test_a_cancelled_program_ends_aborted_where_it_waits() -> None:
    run, x = ready()
    seen: list[object] = []

    async def victim() -> None:
        try:
            await x.move_absolute(300.0)
        except Cancelled:
            seen.append(run.tick)
            raise

    async def program() -> None:
        child = run.start(victim())
        await run.sleep(0.02)
        child.cancel()
        tick = run.tick
        await child.settled()
        assert child.aborted
        assert seen == [tick + 1]

    play(run, program)


def test_cancelling_a_wait_never_stops_motion() -> None:
    run, x = ready()

    async def victim() -> None:
        await x.move_absolute(300.0)

    async def program() -> None:
        child = run.start(victim())
        await run.sleep(0.02)
        move = x.command
        assert move is not None
        child.cancel()
        await child.settled()
        assert x.command is move
        await move
        assert x.set_position == 300.0

    play(run, program)


def test_a_cancel_in_the_tick_in_which_the_program_is_due_is_not_lost() -> None:
    run, _ = one_axis()
    steps: list[int] = []

    async def victim() -> None:
        while True:
            await run.sleep(0.0)
            steps.append(run.tick)

    async def program() -> None:
        children.append(run.start(victim()))
        await run.sleep(0.005)
        children[0].cancel()  # the victim comes after, and is due in this very tick

    children: list[Any] = []
    run.start(program())
    run.run(time=0.05)
    assert children[0].aborted
    assert steps[-1] == 5


def test_a_program_may_cancel_itself() -> None:
    run, _ = one_axis()

    async def program() -> None:
        main.cancel()
        await run.sleep(1.0)
        pytest.fail("it went on")

    main = run.start(program())
    run.run()
    assert main.aborted
    assert run.tick == 2


def test_cancelling_before_the_first_step_runs_nothing() -> None:
    run, _ = one_axis()
    seen: list[int] = []

    async def program() -> None:
        seen.append(run.tick)

    main = run.start(program())
    main.cancel()
    run.run(time=0.01)
    assert main.aborted
    assert not seen


def test_cancelling_an_ended_program_changes_nothing() -> None:
    run, _ = one_axis()

    async def program() -> int:
        return 1

    main = run.start(program())
    run.run()
    main.cancel()
    run.step(3)
    assert main.result == 1


def test_a_program_may_refuse_to_be_cancelled() -> None:
    run, _ = one_axis()

    async def stubborn() -> str:
        try:
            await run.sleep(10.0)
        except Cancelled:
            await run.sleep(0.01)
        return "finished"

    async def program() -> None:
        child = run.start(stubborn())
        await run.sleep(0.005)
        child.cancel()
        assert await child == "finished"

    play(run, program)
