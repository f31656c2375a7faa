"""sleep, until, fail_after: waits in the run's own time."""

import math
from collections.abc import Callable
from typing import Any

import pytest

from motionlayer import Simulation, all_of, any_of
from motionlayer.event import Device, Event, Level
from tests.machines import one_axis, play, ready


@pytest.mark.parametrize(
    ("seconds", "ticks"),
    [(0.0, 1), (1e-12, 1), (0.0005, 1), (0.001, 1), (0.0011, 2), (0.003, 3), (0.1 + 0.2, 300), (0.3, 300)],
)
def test_sleep_is_rounded_up_to_whole_ticks(seconds: float, ticks: int) -> None:
    run, _ = one_axis()

    async def program() -> int:
        start = run.tick
        await run.sleep(seconds)
        return run.tick - start

    main = run.start(program())
    run.run()
    assert main.result == ticks


@pytest.mark.parametrize("seconds", [-1e-9, math.nan, math.inf, -math.inf, 9.1e12, 1e300, 10**400])
def test_sleep_and_fail_after_refuse_what_is_no_time(seconds: float) -> None:
    run, _ = one_axis()

    async def program() -> None:
        with pytest.raises(ValueError, match=r"sleep.*allowed: 0 to 9\.0072e\+12 seconds"):
            run.sleep(seconds)
        with pytest.raises(ValueError, match=r"fail_after.*allowed: 0 to 9"), run.fail_after(seconds):
            pass

    play(run, program)


@pytest.mark.parametrize("seconds", ["1", None, True])
def test_sleep_and_fail_after_take_numbers(seconds: Any) -> None:
    run, _ = one_axis()

    async def program() -> None:
        with pytest.raises(TypeError, match=r"sleep.*it must be a number of seconds"):
            run.sleep(seconds)
        with pytest.raises(TypeError, match=r"fail_after.*it must be a number of seconds"), run.fail_after(seconds):
            pass

    play(run, program)


def test_until_holds_at_once_costs_a_tick() -> None:
    run, _ = one_axis()

    async def program() -> None:
        await run.until(lambda: True)
        assert run.tick == 1

    play(run, program)


def test_until_wants_a_function() -> None:
    run, _ = one_axis()
    with pytest.raises(TypeError, match="lambda"):
        run.until(True)  # type: ignore[arg-type]


def test_an_exception_in_a_predicate_is_raised_where_the_program_waits() -> None:
    run, _ = one_axis()

    async def program() -> None:
        with pytest.raises(ZeroDivisionError):
            await run.until(lambda: 1 / (3 - run.tick) > 10)
        assert run.tick == 3

    play(run, program)


def test_fail_after_raises_in_time_and_names_what_was_awaited() -> None:
    run, x = ready()

    async def program() -> None:
        start = run.tick
        move = x.move_absolute(300.0)
        with pytest.raises(TimeoutError, match=r"0\.05 s passed while waiting for X\.move_absolute"):  # noqa: SIM117
            with run.fail_after(0.05):
                await move
        assert run.tick == start + 50
        assert move.busy  # a wait that ends never stops motion
        with pytest.raises(TimeoutError, match=r"sleep\(7\)"), run.fail_after(0.01):
            await run.sleep(7.0)
        with pytest.raises(TimeoutError, match=r"until\(.*test_waits\.py:\d+"), run.fail_after(0.01):
            await run.until(lambda: False)
        with pytest.raises(TimeoutError, match=r"all_of\(X\.move_absolute, X\.move_absolute\)"), run.fail_after(0.01):
            await all_of(move, move)
        with pytest.raises(TimeoutError, match=r"X\.move_absolute"), run.fail_after(0.01):
            await move.settled()

    play(run, program)


def test_fail_after_lets_pass_what_comes_in_time() -> None:
    run, _ = one_axis()

    async def program() -> None:
        with run.fail_after(0.01):
            await run.sleep(0.004)
            await run.sleep(0.006)  # ends with the deadline: the wait is met
        assert run.tick == 10
        await run.sleep(0.05)

    play(run, program)


@pytest.mark.parametrize("inner", [0.01, 0.03])
def test_nested_deadlines_fire_by_themselves(inner: float) -> None:
    outer = 0.02
    run, _ = one_axis()
    caught: list[tuple[str, int]] = []

    async def program() -> None:
        with pytest.raises(TimeoutError, match=r"0\.02 s"), run.fail_after(outer):  # noqa: PT012 - nested on purpose
            try:
                with run.fail_after(inner):
                    await run.sleep(5.0)
            except TimeoutError as error:
                caught.append((str(error), run.tick))
            await run.sleep(5.0)
        caught.append(("outer", run.tick))

    play(run, program)
    if inner < outer:
        assert f"{inner:g} s" in caught[0][0]
        assert [tick for _, tick in caught] == [10, 20]
    else:  # the outer one falls through the inner block; caught there, it comes again at the next wait
        assert f"{outer:g} s" in caught[0][0]
        assert [tick for _, tick in caught] == [20, 21]


def test_a_deadline_watches_its_own_program_only() -> None:
    run, _ = one_axis()

    async def other() -> int:
        await run.sleep(0.1)
        return run.tick

    async def program() -> None:
        child = run.start(other())
        with pytest.raises(TimeoutError), run.fail_after(0.01):
            await child
        assert child.busy
        assert await child == 101

    play(run, program)


def test_fail_after_belongs_in_a_program() -> None:
    run, _ = one_axis()
    with pytest.raises(RuntimeError, match="inside"), run.fail_after(1.0):
        pass


def test_a_wait_after_a_timeout_can_be_taken_up_again() -> None:
    run, x = ready()

    async def program() -> None:
        move = x.move_absolute(300.0)
        for _ in range(3):
            with pytest.raises(TimeoutError), run.fail_after(0.02):
                await move
        await move
        assert x.set_position == 300.0

    play(run, program)


def line_of(function: Callable[..., object], offset: int) -> str:
    """Return the place of a line behind the first one of a function, as messages name it."""
    return f"test_waits.py:{function.__code__.co_firstlineno + offset} in {function.__name__}"


def forgotten(run: Simulation) -> list[Event]:
    return [one for one in run.events.last(Level.WARNING) if "is not awaited" in one.text]


def test_a_wait_without_await_is_a_warning_that_names_the_line_once() -> None:
    run, _ = one_axis()

    async def careless() -> None:
        for _ in range(3):
            run.sleep(1.0)
            await run.sleep(0.002)
            run.until(lambda: False)

    play(run, careless)
    at_first, at_last = forgotten(run)
    assert at_first.text == (
        f"sleep(1) at {line_of(careless, 2)} is not awaited, so it does nothing: write `await` before it"
    )
    assert at_last.text.startswith(f"until(...) at {line_of(careless, 4)} is not awaited")
    assert (at_first.tick, at_last.tick) == (0, 2)
    assert (at_first.level, at_first.source, at_first.device) == (
        Level.WARNING,
        "program careless",
        Device.Device_Main,
    )
    assert run.tick == 7


def test_a_wait_without_await_before_the_end_or_a_failure_is_found_too() -> None:
    run, _ = one_axis()

    async def returns() -> None:
        run.sleep(1.0)

    async def fails() -> None:
        run.sleep(2.0)
        raise LookupError("lost")

    def cyclic(run: Simulation) -> None:
        run.sleep(3.0)

    run.start(returns())
    run.start(fails())
    run.cyclic(cyclic)
    run.step(5)
    texts = [(one.source, one.text) for one in forgotten(run)]
    assert [source for source, _ in texts] == ["program returns", "program fails", "program cyclic"]
    assert "the next cycle" in texts[-1][1]


def test_a_wait_that_is_awaited_later_or_with_others_or_by_another_program_is_no_mistake() -> None:
    run, _ = one_axis()
    shared: list[Any] = []

    async def careful() -> None:
        later = run.sleep(0.003)
        both = all_of(run.sleep(0.001), run.until(lambda: True))
        shared.append(run.sleep(0.01))
        await run.sleep(0.002)
        await any_of(later, run.sleep(1.0))
        await both
        await run.sleep(0.0)

    async def other() -> None:
        await shared[0]

    run.start(careful())
    run.start(other())
    run.run(time=1.0)
    assert forgotten(run) == []
