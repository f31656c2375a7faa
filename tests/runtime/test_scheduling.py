"""Who is due is decided before programs run; each runs at most once per tick, in order of start (rule 2)."""

from typing import Any

import pytest

from motionlayer import CommandAborted
from motionlayer.event import Kind
from tests.machines import one_axis, play, ready


def test_programs_run_once_per_tick_in_order_of_start() -> None:
    run, _ = one_axis()
    seen: list[tuple[int, str]] = []

    async def note(name: str) -> None:
        for _ in range(3):
            seen.append((run.tick, name))
            await run.sleep(0.0)

    for name in "cab":
        run.start(note(name))
    run.run()
    assert seen == [(tick, name) for tick in range(3) for name in "cab"]


def test_a_program_started_by_a_program_first_runs_in_the_next_tick() -> None:
    run, _ = one_axis()
    ticks: list[int] = []

    async def child() -> None:
        ticks.append(run.tick)

    async def parent() -> None:
        await run.sleep(0.005)
        run.start(child())
        ticks.append(run.tick)

    play(run, parent)
    assert ticks == [5, 6]


def test_due_is_decided_before_any_program_runs() -> None:
    """What an earlier program of the tick makes true is seen by a later one only in the next tick."""
    run, _ = one_axis()
    state = {"flag": False}
    met: dict[str, int] = {}

    async def waiter(name: str) -> None:
        await run.until(lambda: state["flag"])
        met[name] = run.tick

    async def setter() -> None:
        await run.sleep(0.004)
        state["flag"] = True

    run.start(waiter("before"))
    run.start(setter())
    run.start(waiter("after"))
    run.run()
    assert met == {"before": 5, "after": 5}


def test_a_predicate_that_stops_holding_within_the_tick_still_wakes_its_program() -> None:
    run, _ = one_axis()
    state = {"flag": False}
    met: list[int] = []

    async def clearer() -> None:
        await run.until(lambda: state["flag"])
        state["flag"] = False

    async def waiter() -> None:
        await run.until(lambda: state["flag"])
        met.append(run.tick)

    async def setter() -> None:
        await run.sleep(0.003)
        state["flag"] = True

    for program in (clearer, waiter, setter):
        run.start(program())
    run.run(time=0.1)
    assert met == [4]


def test_a_predicate_is_asked_once_per_tick() -> None:
    run, _ = one_axis()
    asked: list[int] = []

    def enough() -> bool:
        asked.append(run.tick)
        return len(asked) == 4

    async def program() -> None:
        await run.until(enough)

    play(run, program)
    assert asked == [1, 2, 3, 4]


def test_a_command_wakes_its_waiters_in_the_tick_after_its_end() -> None:
    run, x = ready()
    ends: list[int] = []
    woken: list[tuple[str, int]] = []

    async def waiter(name: str, command: Any) -> None:
        await command
        woken.append((name, run.tick))

    async def program() -> None:
        move = x.move_absolute(50.0)
        move.on_end(lambda: ends.append(run.tick))
        run.start(waiter("second", move))
        await move
        woken.append(("first", run.tick))

    play(run, program)
    assert woken == [("first", ends[0] + 1), ("second", ends[0] + 1)]


def test_a_command_that_a_program_ends_wakes_even_earlier_programs_only_in_the_next_tick() -> None:
    run, x = ready()
    woken: dict[str, int] = {}

    async def waiter(name: str) -> None:
        await run.until(lambda: x.command is not None)
        command = x.command
        assert command is not None
        with pytest.raises(CommandAborted):
            await command
        woken[name] = run.tick

    async def mover() -> None:
        x.move_absolute(300.0)
        await run.sleep(0.05)
        woken["ended"] = run.tick
        await x.halt()

    run.start(waiter("before"))
    run.start(mover())
    run.start(waiter("after"))
    run.run()
    assert woken["before"] == woken["after"] == woken["ended"] + 1


def test_awaiting_what_has_ended_costs_no_tick() -> None:
    run, x = ready()

    async def nothing() -> int:
        return 3

    async def program() -> None:
        move = x.move_absolute(10.0)
        await move
        other = run.start(nothing())
        assert await other == 3
        tick = run.tick
        await move
        assert await other == 3
        assert await move.settled() is move
        refused = x.move_absolute(1e9)
        assert (await refused.settled()).error is not None
        assert run.tick == tick

    play(run, program)


def test_a_program_is_a_command_with_its_return_value() -> None:
    run, _ = one_axis()

    async def child() -> str:
        await run.sleep(0.01)
        return "value"

    async def parent() -> tuple[int, str]:
        program = run.start(child())
        assert program.busy
        assert program.active
        value: str = await program
        return run.tick, value

    main = run.start(parent())
    run.run()
    assert main.done
    assert main.result == (12, "value")  # started in 0, runs 1 to 11, wakes its waiter in 12


def test_the_life_of_a_program_is_in_the_events() -> None:
    run, _ = one_axis()

    async def good() -> None:
        await run.sleep(0.003)

    async def endless() -> None:
        await run.sleep(1000.0)

    run.start(good(), "good")
    run.start(endless(), "endless")
    run.run(time=0.01)
    lives = [(event.tick, event.source, event.kind) for event in run.events.last()]
    assert lives == [
        (0, "program good", Kind.ACCEPTED),
        (0, "program endless", Kind.ACCEPTED),
        (3, "program good", Kind.DONE),
        (10, "program endless", Kind.ABORTED),
    ]


def test_start_wants_a_coroutine() -> None:
    run, _ = one_axis()

    async def program() -> None: ...

    with pytest.raises(TypeError, match=r"start\(program\(\)\)"):
        run.start(program)  # type: ignore[arg-type]
    assert not run.events.last()
