"""Beginning and end of a run (rule 7), the edge of the runtime, and the watchdog (rule 6)."""

import contextlib
import signal
import threading
import time

import pytest

from motionlayer import Machine, Simulation
from motionlayer.command import CommandError
from motionlayer.runtime import Cancelled, CycleFault, ProgramStuck
from tests.machines import machine, one_axis, ready


def test_a_run_ends_with_its_last_program() -> None:
    run, _ = one_axis()

    async def program(seconds: float) -> None:
        await run.sleep(seconds)

    run.start(program(0.02))
    run.run(program(0.01))
    assert run.tick == 21  # the tick in which the last one ended is complete
    assert run.time == pytest.approx(0.021, rel=1e-15)


def test_a_run_ends_with_its_time_and_cancels_in_reverse_order() -> None:
    run, _ = one_axis()
    order: list[str] = []

    async def program(name: str) -> None:
        try:
            await run.sleep(100.0)
        except Cancelled:
            order.append(name)
            raise

    programs = [run.start(program(name)) for name in "abc"]
    run.run(time=0.025)
    assert run.tick == 25
    assert order == ["c", "b", "a"]
    assert all(program.aborted for program in programs)


def test_a_program_that_waits_again_when_the_run_is_over_is_closed() -> None:
    run, _ = one_axis()
    steps: list[str] = []

    async def stubborn() -> None:
        try:
            await run.sleep(100.0)
        except Cancelled:
            steps.append("cancelled")
            try:
                await run.sleep(100.0)
            finally:
                steps.append("closed")

    program = run.start(stubborn())
    run.run(time=0.01)
    assert steps == ["cancelled", "closed"]
    assert program.aborted
    assert run.tick == 10


def test_an_exception_during_the_final_cancel_is_a_failure() -> None:
    run, _ = one_axis()

    async def program() -> None:
        try:
            await run.sleep(100.0)
        finally:
            raise LookupError("in finally")

    main = run.start(program())
    run.run(time=0.01)
    assert isinstance(main.failure, LookupError)
    assert run.failures == [main]


def test_a_run_can_go_on() -> None:
    run, x = ready()

    async def there() -> None:
        await x.move_absolute(10.0)

    async def back() -> None:
        await x.move_absolute(0.0)

    run.run(there())
    tick = run.tick
    assert x.set_position == 10.0
    run.run(back())
    assert x.set_position == 0.0
    assert run.tick > tick


def test_a_run_with_a_time_alone() -> None:
    run, _ = one_axis()
    run.run(time=1.0)
    assert run.tick == 1000


def test_a_run_that_would_never_end_is_refused() -> None:
    run, _ = one_axis()
    with pytest.raises(ValueError, match="program or a time"):
        run.run()
    assert run.tick == 0


def test_time_follows_the_base_cycle() -> None:
    description = {
        "format": 1,
        "name": "t",
        "base_cycle_ns": 250_000,
        "axis": machine().description.model_dump()["axis"],
    }
    run = Simulation(Machine.from_dict(description))

    async def program() -> None:
        await run.sleep(0.01)
        assert run.tick == 40

    run.run(program())
    assert run.time == pytest.approx(41 * 0.00025, rel=1e-15)


def test_a_fault_of_our_own_step_ends_the_run_and_names_the_tick(monkeypatch: pytest.MonkeyPatch) -> None:
    run, x = ready()
    x.move_absolute(5.0)

    def broken(_ended: object) -> None:
        raise ArithmeticError("broken")

    monkeypatch.setattr(x, "cycle", x.cycle._replace(profile_ended=broken))
    with pytest.raises(CycleFault, match=r"tick \d+: broken") as caught:
        run.run(time=1.0)
    assert isinstance(caught.value.__cause__, ArithmeticError)


def stuck_in(run: Simulation) -> ProgramStuck:
    async def spinning() -> None:
        await run.sleep(0.002)
        while True:
            time.monotonic()

    with pytest.raises(ProgramStuck) as caught:
        run.run(spinning())
    return caught.value


def check_stuck(run: Simulation, stuck: ProgramStuck) -> None:
    for part in ("program spinning", "tick 2", "run.sleep", "test_run.py", "in spinning"):
        assert part in str(stuck)
    assert run.tick == 2


def test_a_program_that_does_not_yield_ends_the_run_with_its_stack() -> None:
    run = Simulation(machine(), patience=0.2)
    check_stuck(run, stuck_in(run))


def test_a_stuck_program_where_interrupts_are_ignored() -> None:
    """As in a job that a shell runs in the background."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        run = Simulation(machine(), patience=0.2)
        check_stuck(run, stuck_in(run))
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_stuck_program_in_another_thread() -> None:
    run = Simulation(machine(), patience=0.2)
    found: list[ProgramStuck] = []
    thread = threading.Thread(target=lambda: found.append(stuck_in(run)))
    thread.start()
    thread.join(60.0)
    assert not thread.is_alive()
    check_stuck(run, found[0])


def test_the_others_are_cancelled_when_a_program_is_stuck() -> None:
    run = Simulation(machine(), patience=0.2)
    order: list[str] = []

    async def other() -> None:
        with contextlib.suppress(Cancelled):
            await run.sleep(100.0)
        order.append("cancelled")

    run.start(other())
    stuck_in(run)
    assert order == ["cancelled"]


def test_a_program_cannot_run_ticks_itself() -> None:
    run, _ = ready()

    async def program() -> None:
        with pytest.raises(RuntimeError, match=r"await run\.sleep"):
            run.step()

    run.run(program())


def test_an_awaited_program_that_fails_says_so() -> None:
    run, _ = ready()

    async def child() -> None:
        raise LookupError("lost")

    async def parent() -> None:
        with pytest.raises(CommandError, match=r"a program failed .*LookupError: lost.*0xF000"):
            await run.start(child())

    run.run(parent())
