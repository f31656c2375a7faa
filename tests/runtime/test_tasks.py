"""Cyclic programs and the tasks that call them."""

from types import SimpleNamespace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.runtime import Run, TaskConfig
from motionlayer.runtime._tasks import heaviest, spread
from tests.runtime.bare import bare, noting

PERIOD = 360
"""Ticks after which any tasks of `CONFIGS` meet again as they did."""

CONFIGS = st.lists(
    st.builds(
        lambda every, phase: (every, None if phase is None else phase % every),
        st.sampled_from([every for every in range(1, 41) if PERIOD % every == 0]),
        st.none() | st.integers(0, 39),
    ),
    min_size=1,
    max_size=6,
).map(lambda rows: [TaskConfig(f"t{index}", every, phase) for index, (every, phase) in enumerate(rows)])


def test_a_function_is_called_in_every_cycle_and_keeps_its_memory() -> None:
    run = bare()

    def main(_: Run, memory: SimpleNamespace) -> None:
        memory.calls = getattr(memory, "calls", 0) + 1

    program = run.cyclic(main)
    run.step(7)
    assert program.memory.calls == 7
    assert (program.name, program.busy, program.active) == ("main", True, True)


@settings(deadline=None)
@given(CONFIGS)
def test_a_task_runs_at_its_phase_and_the_faster_ones_first(configs: list[TaskConfig]) -> None:
    run = bare(*configs)
    seen: list[tuple[int, str]] = []
    for config in reversed(configs):
        run.cyclic(noting(seen, config.name), task=config.name)
    run.step(100)
    by_speed = sorted(configs, key=lambda config: config.every)
    phases = {config.name: run.tasks[config.name].phase for config in configs}
    due = [(n, one.name) for n in range(100) for one in by_speed if n % one.every == phases[one.name]]
    assert seen == due
    for config in configs:
        assert 0 <= phases[config.name] < config.every
        assert config.phase in (None, phases[config.name])
        assert run.tasks[config.name].compute.count == sum(name == config.name for _, name in due)


@settings(deadline=None)
@given(CONFIGS)
def test_an_open_phase_is_one_in_which_the_task_meets_the_fewest_others(configs: list[TaskConfig]) -> None:
    phases = spread(configs)
    order = sorted(configs, key=lambda one: (one.phase is None, one.every))
    for index, config in enumerate(order):
        if config.phase is not None:
            continue

        def met(phase: int, every: int = config.every, before: list[TaskConfig] = order[:index]) -> int:
            ticks = range(phase, PERIOD, every)
            return sum(n % other.every == phases[other.name] for n in ticks for other in before)

        assert met(phases[config.name]) == min(map(met, range(config.every)))


@settings(deadline=None)
@given(CONFIGS, st.lists(st.sampled_from([None, 0.001, 0.002, 0.004]), min_size=6, max_size=6))
def test_the_heaviest_tick_is_found(configs: list[TaskConfig], budgets: list[float | None]) -> None:
    configs = [one._replace(budget=budget) for one, budget in zip(configs, budgets, strict=False)]
    phases = spread(configs)
    sums = (sum(one.budget or 0.0 for one in configs if n % one.every == phases[one.name]) for n in range(PERIOD))
    crowd = heaviest(configs)
    assert sum(one.budget or 0.0 for one in crowd) == pytest.approx(max(sums), abs=1e-12)
    assert any(all(n % one.every == phases[one.name] for one in crowd) for n in range(PERIOD))


def test_tasks_alike_take_turns_where_there_is_room() -> None:
    assert spread([TaskConfig(name, 3) for name in "abc"]) == {"a": 0, "b": 1, "c": 2}
    assert spread([TaskConfig("slow", 4), TaskConfig("fixed", 2, 0)]) == {"fixed": 0, "slow": 1}


def test_coroutines_come_before_the_tasks_and_programs_of_a_task_in_order_of_start() -> None:
    run = bare()
    seen: list[tuple[int, str]] = []
    run.cyclic(noting(seen, "first"))
    run.cyclic(noting(seen, "second"))

    async def coroutine() -> None:
        for _ in range(2):
            seen.append((run.tick, "coroutine"))
            await run.sleep(0.0)

    run.start(coroutine())
    run.step(2)
    assert seen == [(tick, name) for tick in range(2) for name in ("coroutine", "first", "second")]


@pytest.mark.parametrize("by_coroutine", [False, True])
def test_a_program_started_by_another_is_first_called_in_the_next_tick(by_coroutine: bool) -> None:
    run = bare()
    seen: list[tuple[int, str]] = []

    def start(run: Run) -> None:
        if run.tick == 2:
            run.cyclic(noting(seen, "new"))

    async def coroutine() -> None:
        await run.sleep(0.002)
        start(run)

    if by_coroutine:
        run.start(coroutine())
    else:
        run.cyclic(start)
    run.step(5)
    assert seen == [(3, "new"), (4, "new")]
    assert run._scheduler.programs[-1].owner is not None


@pytest.mark.parametrize("every", [1, 5])
def test_cancel_ends_a_program_at_its_next_turn(every: int) -> None:
    run = bare(TaskConfig("task", every))
    seen: list[tuple[int, str]] = []
    program = run.cyclic(noting(seen, "p"), task="task")
    run.step(6)
    calls = len(seen)
    program.cancel()
    run.step(every)
    assert program.aborted
    assert len(seen) == calls
    assert not run.failures
    assert run.events.last()[-1].text == "cancelled"


def test_a_program_ends_itself_and_with_it_the_run() -> None:
    run = bare()

    def main(run: Run) -> None:
        if run.tick == 9:
            run.program.cancel()

    program = run.cyclic(main)
    assert run.run()
    assert (program.aborted, run.tick) == (True, 11)


def test_the_end_of_a_run_cancels_cyclic_programs_and_says_that_it_was_cut_off() -> None:
    run = bare()
    program = run.cyclic(noting([], "p"))
    assert not run.run(time=0.1)
    assert (program.aborted, run.tick) == (True, 100)


def test_asking_for_the_program_outside_of_one_is_an_error() -> None:
    run = bare()
    with pytest.raises(RuntimeError, match="no program runs now"):
        _ = run.program


# machine files
