"""Sleeps and predicates are commands: they combine with all others, and cost no tick more for it."""

import pytest

from motionlayer import all_of, any_of
from motionlayer.command import Command, CommandError
from tests.machines import ready


def test_a_move_or_a_time() -> None:
    run, x = ready()

    async def program() -> int:
        began = run.tick
        move = x.move_absolute(300.0)
        first: Command[object] = await any_of(move, run.sleep(0.1))
        assert first is not move
        return run.tick - began

    main = run.start(program())
    run.run()
    assert main.result == 100


def test_a_move_or_a_place() -> None:
    run, x = ready()

    async def program() -> None:
        move = x.move_absolute(300.0)
        await any_of(move, run.until(lambda: x.set_position > 100.0))
        assert 100.0 < x.set_position < 102.0
        await all_of(move, run.sleep(0.05))
        assert x.set_position == 300.0

    run.run(program())


def test_a_predicate_that_raises_is_raised_where_it_is_awaited() -> None:
    run, x = ready()

    async def alone() -> None:
        with pytest.raises(ZeroDivisionError):
            await run.until(lambda: bool(1 // 0))

    async def combined() -> None:
        with pytest.raises(CommandError, match="ZeroDivisionError"):
            await all_of(run.sleep(1.0), run.until(lambda: bool(1 // 0)))

    run.run(alone())
    run.run(combined())
    assert x.error is None


def test_a_predicate_that_nobody_waits_for_any_more_is_not_asked() -> None:
    run, _ = ready()
    asked: list[int] = []

    async def program() -> None:
        with pytest.raises(TimeoutError, match="until"), run.fail_after(0.01):
            await run.until(lambda: bool(asked.append(run.tick)))  # type: ignore[func-returns-value]
        count = len(asked)
        await run.sleep(0.05)
        assert len(asked) <= count + 1

    run.run(program())
    assert asked


def test_run_tells_whether_the_programs_ended_by_themselves() -> None:
    run, _ = ready()

    async def program() -> None:
        await run.sleep(0.1)

    assert run.run(program(), time=1.0)
    assert not run.run(program(), time=0.05)


def test_the_run_goes_on_until_what_a_failed_program_moved_is_at_rest() -> None:
    run, x = ready()

    async def program() -> None:
        x.move_velocity(400.0)
        await run.sleep(0.3)
        raise LookupError("lost")

    run.start(program(), "loser")
    run.run()
    assert [failure.name for failure in run.failures] == ["loser"]
    assert x.set_velocity == 0.0
    assert str(x.state) == "StandStill"
