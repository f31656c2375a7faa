"""sleep, until, fail_after: waits in the run's own time."""

import math

import pytest

from motionlayer import all_of
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


@pytest.mark.parametrize("seconds", [-1e-9, math.nan, math.inf, -math.inf])
def test_sleep_and_fail_after_refuse_what_is_no_time(seconds: float) -> None:
    run, _ = one_axis()

    async def program() -> None:
        with pytest.raises(ValueError, match=r"sleep.*finite"):
            run.sleep(seconds)
        with pytest.raises(ValueError, match=r"fail_after.*finite"), run.fail_after(seconds):
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
