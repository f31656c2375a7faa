"""What the cycles of tasks may cost, and what is said of those that cost more."""

from motionlayer import RealTime, Simulation
from motionlayer.event import Input, Level
from motionlayer.runtime import Run, TaskConfig
from motionlayer.runtime._tasks import CHANNEL
from tests.machines import machine
from tests.runtime.bare import MILLISECOND, bare, noting
from tests.runtime.clock import FakeClock


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
