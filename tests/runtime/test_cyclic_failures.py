"""Cyclic programs that fail, never return, or are none."""

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from motionlayer import AxisState, CommandError, Simulation
from motionlayer.command import ErrorId
from motionlayer.event import Input, Kind, Level
from motionlayer.runtime import MAIN, ProgramStuck, Run, TaskConfig
from motionlayer.verify import assert_valid
from tests.machines import machine
from tests.runtime.bare import bare, noting


def test_an_exception_ends_the_program_and_halts_its_axes_alone() -> None:
    with Simulation(machine(2)) as run:
        x, y = run.axes.values()

        def bad(run: Simulation) -> None:
            if run.tick == 5:
                x.move_velocity(300.0)
            if run.tick == 60:
                raise LookupError("lost")

        def good(run: Simulation) -> None:
            if run.tick == 5:
                y.move_velocity(300.0)

        x.enable()
        y.enable()
        failing, going = run.cyclic(bad), run.cyclic(good)
        run.run(time=1.0)
        assert run.failures == [failing]
        assert isinstance(failing.failure, LookupError)
        assert failing.error is not None
        assert failing.error.id is ErrorId.PROGRAM_FAILED
        assert going.aborted
        assert (x.state, x.set_velocity) == (AxisState.STANDSTILL, 0.0)
        assert y.set_velocity == 300.0
        (event,) = [event for event in run.events.last(Level.ERROR) if event.kind is Kind.ERROR]
        assert (event.tick, event.source, event.command) == (60, "program bad", failing.number)
        assert "LookupError: lost (test_cyclic_failures.py" in event.text
        assert_valid(run.trace)


def test_an_awaited_failure_belongs_to_who_awaits() -> None:
    run = bare(failed=lambda program: pytest.fail(program.name))

    def bad(_: Run) -> None:
        raise LookupError("lost")

    async def waiting() -> None:
        with pytest.raises(CommandError, match="LookupError: lost"):
            await run.cyclic(bad)

    run.run(waiting())
    assert not run.failures


def answering(_: object) -> bool:
    return True


async def coroutine(_: object) -> None: ...


def hidden(run: object) -> object:
    return coroutine(run)


def three(run: object, memory: object, more: object) -> None: ...


@pytest.mark.parametrize(
    ("function", "said"),
    [
        (answering, r"answering returned True; a cyclic program returns nothing, and ends with run.program.cancel\(\)"),
        (hidden, r"returned a coroutine; write `async def"),
    ],
    ids=["value", "coroutine"],
)
def test_a_function_that_returns_something_is_told_what_it_meant(function: Callable[[Any], Any], said: str) -> None:
    run = bare(failed=lambda _: None)
    program = run.cyclic(function)
    run.step()
    with pytest.raises(TypeError, match=said):
        raise program.failure or AssertionError


def with_default(_: object, speed: float = 3.0) -> None:
    assert speed == 3.0


def generator(_: object) -> Any:
    yield


@pytest.mark.parametrize(
    ("function", "said"),
    [
        (coroutine, r"coroutine: not a plain function; .* started with run.start\(coroutine\(\)\)"),
        (generator, "generator: not a plain function"),
        (lambda: None, r"a cyclic program is `def <lambda>\(run\)` or"),
        (three, r"three\(run: object, memory: object, more: object\).*: a cyclic program is"),
        (5, "5"),
    ],
    ids=["coroutine", "generator", "none", "three", "number"],
)
def test_what_cannot_be_called_each_cycle_is_refused_at_once(function: Any, said: str) -> None:
    run = bare()
    with pytest.raises(TypeError, match=said):
        run.cyclic(function)
    run.step()
    assert not run.events.last()


def test_a_second_parameter_with_a_default_is_no_memory() -> None:
    run = bare()
    program = run.cyclic(with_default)
    run.step()
    assert program.busy


def test_an_unknown_task_is_refused_with_those_there_are() -> None:
    run = bare(TaskConfig("fast"), TaskConfig("slow", 10))
    with pytest.raises(KeyError, match="no task 'fats'; this run has fast, slow, main"):
        run.cyclic(noting([], "p"), task="fats")
    assert list(run.tasks) == ["fast", "slow", MAIN]


def test_fail_after_is_for_coroutines() -> None:
    run = bare(failed=lambda _: None)

    def main(run: Run) -> None:
        with run.fail_after(1.0):
            pass

    program = run.cyclic(main)
    run.step()
    assert "what a coroutine waits for" in str(program.failure)


def test_a_program_that_never_returns_is_named_with_its_stack() -> None:
    run = Simulation(machine(), patience=0.2)

    def endless(_: Run) -> None:
        while True:
            pass

    program = run.cyclic(endless)
    with pytest.raises(ProgramStuck, match=r"program endless has not yielded for 0\.2 s in tick 0") as caught:
        run.run(time=1.0)
    assert "in endless" in str(caught.value)
    assert isinstance(program.failure, KeyboardInterrupt)


def test_the_stack_of_a_stuck_program_begins_where_it_was_called() -> None:
    """Also if it stays in a function of the runtime, here one that asks for inputs which never come."""

    def never() -> Iterator[Input]:
        while run.tick == 0:
            pass
        yield Input(0, "part", b"")

    run = Simulation(machine(), patience=0.2)
    run.cyclic(lambda run: run.mailbox.feed(never()), name="waiting")
    with pytest.raises(ProgramStuck) as caught:
        run.run(time=1.0)
    frames = [line for line in str(caught.value).splitlines() if line.lstrip().startswith("File")]
    assert "test_cyclic_failures.py" in frames[0]
    assert any("_mailbox.py" in line and line.endswith("in feed") for line in frames[1:]), frames
