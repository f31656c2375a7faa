"""An exception that leaves a program (rule 5) and what cannot be awaited (rule 6)."""

import asyncio
from collections.abc import Awaitable, Callable, Generator
from typing import Any

import pytest

from motionlayer import AxisState, CommandError, Simulation, any_of
from motionlayer.command import ErrorId
from motionlayer.event import Event, Kind, Level
from tests.machines import SWITCH, machine, one_axis, play, ready


def two() -> Simulation:
    run = Simulation(machine(2))
    for axis in run.axes.values():
        axis.enable()
    run.step(2)
    return run


def errors(run: Simulation) -> list[Event]:
    return [event for event in run.events.last(Level.ERROR) if event.kind is Kind.ERROR]


def test_an_exception_ends_the_program_halts_its_axes_and_lets_others_go_on() -> None:
    run = two()
    x, y = run.axes.values()
    tick = run.tick

    async def bad() -> None:
        x.move_velocity(300.0)
        await run.sleep(0.05)
        raise LookupError("lost")

    async def good() -> None:
        await y.move_absolute(300.0)

    failing, going = run.start(bad(), "bad"), run.start(good(), "good")
    run.run()
    assert failing.error is not None
    assert failing.error.id is ErrorId.PROGRAM_FAILED
    assert isinstance(failing.failure, LookupError)
    assert run.failures == [failing]
    assert going.done
    assert y.set_position == 300.0
    assert x.state is AxisState.STANDSTILL
    assert (x.set_velocity, x.set_acceleration) == (0.0, 0.0)
    (event,) = errors(run)
    assert (event.tick, event.source, event.command) == (tick + 50, "program bad", failing.number)
    for part in ("LookupError", "lost", "in bad"):
        assert part in event.text


def test_an_exception_leaves_axes_of_others_alone() -> None:
    run = two()
    x, y = run.axes.values()

    async def other() -> None:
        await y.move_absolute(300.0)

    async def bad() -> None:
        x.move_absolute(300.0)
        y.move_absolute(200.0)  # taken over by the other one before the failure
        await run.sleep(0.01)
        run.start(other())
        await run.sleep(0.05)
        raise LookupError

    run.start(bad())
    run.run()
    assert y.set_position == 300.0
    assert 0.0 < x.set_position < 300.0


def test_an_exception_brings_even_a_homing_axis_to_rest() -> None:
    run, x = ready(home=SWITCH)

    async def bad() -> None:
        x.home()
        await run.sleep(0.05)
        raise LookupError

    run.start(bad())
    run.run()
    run.step(500)
    assert x.state is AxisState.STANDSTILL
    assert not x.homed
    assert x.set_position > -40.0


def test_an_awaited_failure_belongs_to_who_awaits() -> None:
    run, x = ready()

    async def bad() -> None:
        x.move_velocity(100.0)
        await run.sleep(0.01)
        raise LookupError("lost")

    async def program() -> None:
        child = run.start(bad(), "bad")
        with pytest.raises(CommandError, match="LookupError: lost") as caught:
            await child
        assert caught.value.command is child
        assert x.state is AxisState.CONTINUOUS_MOTION
        await x.halt()

    play(run, program)
    assert not run.failures


@pytest.mark.parametrize("through_any_of", [False, True])
def test_a_wait_that_was_given_up_awaits_no_longer(through_any_of: bool) -> None:
    run, x = ready()

    async def bad() -> None:
        x.move_velocity(100.0)
        await run.sleep(0.1)
        raise LookupError("lost")

    async def parent() -> None:
        child = run.start(bad())
        if through_any_of:
            await any_of(child, x.passes(x.set_position))
        else:
            with pytest.raises(TimeoutError), run.fail_after(0.02):
                await child
        await run.sleep(1.0)

    run.start(parent())
    run.run()
    assert len(run.failures) == 1
    assert x.state is AxisState.STANDSTILL


def test_the_error_of_a_command_that_leaves_a_program_keeps_its_id() -> None:
    run, x = ready()

    async def bad() -> None:
        await x.move_absolute(1000.0)

    program = run.start(bad())
    run.run()
    assert program.error is not None
    assert program.error.id is ErrorId.TARGET_OUTSIDE_LIMITS
    assert errors(run)[0].code == ErrorId.TARGET_OUTSIDE_LIMITS


def test_the_failure_of_the_main_program_is_raised_in_the_end() -> None:
    run = two()
    y = run.axes["Y"]

    async def good() -> None:
        await y.move_absolute(300.0)

    async def bad() -> None:
        run.start(good())
        await run.sleep(0.01)
        raise LookupError("lost")

    with pytest.raises(LookupError, match="lost"):
        run.run(bad())
    assert y.set_position == 300.0
    assert not run.failures


def test_a_failure_in_the_first_step() -> None:
    run, _ = one_axis()

    async def bad() -> None:
        raise LookupError

    with pytest.raises(LookupError):
        run.run(bad())
    assert run.tick == 1


class Foreign:
    """Yields something that is no wait of a run."""

    def __await__(self) -> Generator[Any, Any, None]:
        yield self


@pytest.mark.parametrize(
    ("wait", "words"),
    [
        (lambda: asyncio.sleep(0.0), ["run.sleep", "asyncio.sleep"]),
        (lambda: asyncio.sleep(0.1), ["run.sleep", "asyncio.sleep"]),
        (Foreign, ["Foreign", "run.sleep", "run.until"]),
    ],
    ids=["asyncio.sleep(0)", "asyncio.sleep(0.1)", "foreign"],
)
def test_awaiting_anything_foreign_raises_at_that_line(wait: Callable[[], Awaitable[None]], words: list[str]) -> None:
    run, _ = one_axis()

    async def program() -> None:
        await run.sleep(0.003)
        with pytest.raises(TypeError) as caught:
            await wait()
        assert all(word in str(caught.value) for word in words), str(caught.value)
        assert run.tick == 3
        await run.sleep(0.003)
        assert run.tick == 6

    play(run, program)


def test_a_foreign_await_inside_an_asyncio_program_is_refused_as_well() -> None:
    run, _ = one_axis()

    async def program() -> None:
        with pytest.raises(TypeError, match=r"run\.sleep"):
            await asyncio.sleep(0.001)
        await run.sleep(0.01)

    async def host() -> None:
        play(run, program)

    asyncio.run(host())
    assert run.tick == 11


def test_a_foreign_await_that_nobody_catches_ends_the_program() -> None:
    run, _ = one_axis()

    async def program() -> None:
        await Foreign()

    failed = run.start(program())
    run.run()
    assert isinstance(failed.failure, TypeError)
    assert "TypeError" in errors(run)[0].text
