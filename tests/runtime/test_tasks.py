"""Cyclic programs and the tasks that call them."""

from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer import AxisState, CommandError, Machine, RealTime, Simulation
from motionlayer.command import ErrorId
from motionlayer.event import Input, Kind, Level
from motionlayer.machine import ProgramError, Source, load_program
from motionlayer.runtime import MAIN, CyclicProgram, ProgramStuck, Run, TaskConfig
from motionlayer.runtime._tasks import CHANNEL, heaviest, spread
from motionlayer.verify import assert_valid
from tests.machines import LINEAR, machine
from tests.runtime.bare import MILLISECOND, bare
from tests.runtime.clock import FakeClock

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


def noting(seen: list[tuple[int, str]], name: str) -> Callable[[Run], None]:
    """Return a cyclic function that notes when it is called."""

    def note(run: Run) -> None:
        seen.append((run.tick, name))

    return note


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
        assert "LookupError: lost (test_tasks.py" in event.text
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
    assert "test_tasks.py" in frames[0]
    assert any("_mailbox.py" in line and line.endswith("in feed") for line in frames[1:]), frames


def timed(budget: float | None, costs: dict[int, int], *, real_time: bool) -> tuple[Run, list[Input]]:
    """Return a run with a program that takes so many nanoseconds in these ticks and none in others."""
    run, clock, inputs = bare(TaskConfig("fast", budget=budget)), FakeClock(read_ns=0), list[Input]()
    run.tasks.report(clock.now_ns)
    run.tasks._reporting = real_time
    run.mailbox.listen(inputs.append)

    def work(run: Run) -> None:
        clock.work(costs.get(run.tick, 0))

    run.cyclic(work, task="fast")
    run.step(12)
    return run, inputs


def test_cycles_over_the_budget_are_counted_and_told_once_a_row() -> None:
    costs = {2: 300_000, 3: 300_001, 4: 900_000, 5: 100, 8: 400_000}
    run, inputs = timed(0.0003, costs, real_time=True)
    task = run.tasks["fast"]
    assert (task.compute.count, task.over_budget) == (12, 3)
    assert task.compute.spread.max == 900_000
    assert [(one.tick, one.channel) for one in inputs] == [(4, CHANNEL), (9, CHANNEL)]
    warnings = run.events.last(Level.WARNING)
    assert [event.tick for event in warnings] == [4, 9]
    assert warnings[0].source == "task fast"
    assert warnings[0].text == "over its budget: 0.300 ms of 0.300 ms; give its programs less to do"


def test_the_default_budget_is_half_a_base_cycle() -> None:
    run, _ = timed(None, {1: MILLISECOND // 2, 3: MILLISECOND // 2 + 1}, real_time=True)
    assert run.tasks["fast"].over_budget == 1


def test_in_simulation_measured_time_changes_nothing_and_a_replay_is_told_what_was() -> None:
    costs = {2: 900_000}
    simulated, inputs = timed(0.0003, costs, real_time=False)
    assert simulated.tasks["fast"].over_budget == 1
    assert not inputs
    assert not simulated.events.last(Level.WARNING)
    real, recorded = timed(0.0003, costs, real_time=True)
    replayed = bare(TaskConfig("fast", budget=0.0003))
    replayed.cyclic(noting([], "work"), task="fast", name="work")
    replayed.mailbox.feed(recorded)
    replayed.step(12)
    assert replayed.events.last() == real.events.last()


class Busy(FakeClock):
    """A clock beside which a program works now and then."""

    def program(self, run: RealTime) -> None:
        self.work(700_000 if run.tick in (5, 6, 20) else 0)


def test_in_real_time_the_warning_comes_in_the_tick_after_and_again_in_a_simulation_that_is_fed() -> None:
    clock = Busy()
    run, inputs = RealTime(machine(), clock=clock), list[Input]()
    run.mailbox.listen(inputs.append)
    run.cyclic(clock.program, name="busy")
    run.run(time=0.03)
    assert [(one.tick, one.channel) for one in inputs] == [(6, CHANNEL), (21, CHANNEL)]
    assert [event.source for event in run.events.last(Level.WARNING)] == ["task main"] * 2
    again = Simulation(machine())
    again.cyclic(lambda _: None, name="busy")
    again.mailbox.feed(inputs)
    again.run(time=0.03)
    assert again.trace.hash == run.trace.hash


# machine files

FILE = """\
format = 1
name = "tasks"
[axis.X]
max_velocity = 500.0
max_acceleration = 5000.0
max_jerk = 100_000.0
[task.slow]
every = 10
phase = 3
[program.count]
file = "programs.py"
function = "count"
task = "slow"
[program.drive]
file = "programs.py"
"""

PROGRAMS = """\
def count(run, memory):
    memory.ticks = [*getattr(memory, "ticks", []), run.tick]

def main(run):
    x = run.axes["X"]
    if run.tick == 0:
        x.enable()
    elif run.tick == 5:
        x.move_absolute(20.0)

async def sequence(run):
    await run.sleep(1.0)
"""


def load(tmp_path: Path, text: str = FILE, programs: str = PROGRAMS) -> Machine:
    (tmp_path / "m.toml").write_text(text)
    (tmp_path / "programs.py").write_text(programs)
    return Machine.load(tmp_path / "m.toml")


def test_a_machine_file_names_functions_and_their_tasks(tmp_path: Path) -> None:
    with Simulation(load(tmp_path)) as run:
        count, _ = run._scheduler.programs
        run.run(time=0.3)
        assert isinstance(count, CyclicProgram)
        assert count.memory.ticks == list(range(3, 300, 10))
        assert run.axes["X"].set_position == 20.0
        assert_valid(run.trace)


def test_the_same_machine_with_the_same_cyclic_programs_gives_the_same_hash(tmp_path: Path) -> None:
    loaded, hashes = load(tmp_path), set[str]()
    for _ in range(2):
        run = Simulation(loaded, trace=False)
        run.run(time=0.2)
        hashes.add(run.close())
    assert len(hashes) == 1


@pytest.mark.parametrize(
    ("task", "function", "said"),
    [("slow", "sequence", "is a coroutine function, which no task calls"), (None, "generate", "must be `async def")],
)
def test_a_function_that_is_no_program_is_refused_at_load(
    tmp_path: Path, task: str | None, function: str, said: str
) -> None:
    load(tmp_path, programs=PROGRAMS + "def generate(run):\n    yield\n")
    with pytest.raises(ProgramError, match=said):
        load_program(Source("p", tmp_path / "programs.py", function, task))


def test_a_task_in_python_is_the_one_of_the_file() -> None:
    data = {"format": 1, "name": "t", "axis": {"X": LINEAR}, "task": {"main": {"every": 2, "budget": 1e-4}}}
    run = Simulation(Machine.from_dict(data))
    assert list(run.tasks) == [MAIN]
    assert (run.tasks[MAIN].every, run.tasks[MAIN].budget_ns) == (2, 100_000)
