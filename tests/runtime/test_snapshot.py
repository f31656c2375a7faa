"""Snapshots: after `restore` a run goes on bit for bit as one that has never been elsewhere."""

from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer import RealTime, Simulation
from motionlayer.event import Input, Level
from motionlayer.fb import MC_MoveAbsolute, MC_Power
from motionlayer.machine import LogDescription
from motionlayer.record import Trace, TraceError
from motionlayer.runtime import CycleFault, NotCopyable, Run
from motionlayer.verify import assert_valid
from tests.effort import examples
from tests.machines import machine, one_axis, ready
from tests.record.log.support import files
from tests.runtime.bare import stepped
from tests.runtime.clock import FakeClock
from tests.runtime.lives import lively, state

if TYPE_CHECKING:
    from collections.abc import Callable


def elsewhere(run: Simulation, ticks: int) -> None:
    """Let a run go on as it never would by itself: other commands, programs that fail, coroutines that wait."""
    axes = list(run.axes.values())

    def bad(_: Run) -> None:
        raise LookupError("on purpose")

    async def waits() -> None:
        try:
            await axes[2].move_absolute(10.0).settled()
            await run.sleep(100.0)
        finally:
            axes[2].halt()

    run.cyclic(bad)
    run.start(waits())
    run.emergency_stop()
    for axis in axes:
        axis.passes(axis.set_position + 1.0)
    run.step(ticks)


def undisturbed(seed: int, ticks: int) -> tuple[Any, Trace]:
    run = lively(seed)
    run.step(ticks)
    return state(run), run.trace


@settings(max_examples=examples(8), deadline=None, derandomize=True)
@given(st.integers(0, 10**6), st.integers(0, 1200), st.lists(st.integers(1, 400), min_size=1, max_size=3))
def test_a_restored_run_goes_on_as_one_that_has_never_been_elsewhere(seed: int, first: int, ways: list[int]) -> None:
    run = lively(seed)
    run.step(first)
    then, kept = state(run), run.snapshot()
    for way in ways:
        elsewhere(run, way)
        run.restore(kept)
        assert state(run) == then
        run.step(way)
        run.restore(kept)
    run.step(500)
    ended, trace = undisturbed(seed, first + 500)
    assert state(run) == ended
    again = run.trace
    assert again.hash == trace.hash
    assert (again.plans, again.events, again.inputs) == (trace.plans, trace.events, trace.inputs)
    assert all((again[name] == trace[name]).all() for name in trace)
    assert_valid(again)


@pytest.mark.slow
@settings(max_examples=100, deadline=None, derandomize=True)
@given(st.integers(0, 10**6), st.integers(0, 3000), st.lists(st.integers(1, 1000), min_size=1, max_size=3))
def test_many_restored_runs(seed: int, first: int, ways: list[int]) -> None:
    test_a_restored_run_goes_on_as_one_that_has_never_been_elsewhere.hypothesis.inner_test(seed, first, ways)  # type: ignore[attr-defined]


def test_the_machine_of_the_property_is_lively() -> None:
    trace = undisturbed(1, 6000)[1]
    assert len({event.code for event in trace.events if event.code}) >= 4
    assert len({plan.kind for plan in trace.plans}) == 5
    assert trace["Z.state"].max() == 7


def test_snapshots_lead_forward_and_to_and_fro() -> None:
    run, shots, states = lively(3), [], []
    for _ in range(4):
        run.step(300)
        shots.append(run.snapshot())
        states.append(state(run))
    for index in (2, 0, 3, 1, 1, 3):
        run.restore(shots[index])
        assert state(run) == states[index]
        run.step(100)
    run.restore(shots[3])
    assert run.trace.hash == undisturbed(3, 1200)[1].hash


def test_a_reset_run_is_like_a_new_one_with_its_seed() -> None:
    run = lively(5)
    fresh = {seed: undisturbed(seed, 700) for seed in (5, 6)}
    run.step()
    for seed, ticks in ((6, 700), (None, 250), (5, 1000), (6, 3), (6, 700)):
        run.reset(seed)
        assert run.tick == 0
        elsewhere(run, ticks)
        run.reset(seed)
        run.step(ticks)
        if ticks == 700:
            assert state(run) == fresh[6][0]
    trace = run.trace
    assert (trace.hash, trace.header["seed"]) == (fresh[6][1].hash, 6)
    assert trace.events == fresh[6][1].events
    assert_valid(trace)
    assert fresh[5][1].hash != fresh[6][1].hash


def test_reset_without_a_seed_takes_that_of_the_beginning() -> None:
    run = lively(5, trace=False)
    run.step(10)
    run.reset(9)
    assert run.seed == 9
    run.reset()
    run.step(200)
    assert run.seed == 5
    assert run.close() == undisturbed(5, 200)[1].hash


def test_reset_before_the_first_tick_only_sows_anew() -> None:
    run = lively(5)
    run.reset(6)
    run.step(300)
    assert run.trace.hash == undisturbed(6, 300)[1].hash


def test_commands_keep_their_identity() -> None:
    run, x = ready()
    move, halt = x.move_absolute(100.0), None
    run.step(10)
    kept = run.snapshot()
    halt = x.halt()
    run.step(200)
    assert (move.aborted, move.by) == (True, halt)
    run.restore(kept)
    assert (move.busy, move.by, x.command) == (True, None, move)
    run.step(1000)
    assert move.done
    assert x.set_position == 100.0


def test_a_watch_is_passed_again() -> None:
    run, x = ready()
    passed = x.passes(50.0)
    move = x.move_absolute(100.0)
    run.step(10)
    kept = run.snapshot()
    times = []
    for _ in range(2):
        while move.busy:
            run.step()
        assert passed.done
        times.append(passed.end_time)
        run.restore(kept)
        assert (passed.busy, passed.end_time) == (True, None)
    assert times[0] == times[1]


def test_coroutines_are_named_and_those_that_have_ended_are_no_hindrance() -> None:
    run, x = one_axis()

    async def first() -> Any:
        await x.enable()
        return (n for n in range(3))  # cannot be copied, and need not be

    async def second() -> None:
        await run.sleep(1.0)

    run.run(first())
    run.snapshot()
    run.start(second())
    run.start(second(), name="third")
    run.step()
    with pytest.raises(NotCopyable, match=r"^program second, third: a coroutine, and where it waits cannot"):
        run.snapshot()


def test_a_run_that_begins_with_a_coroutine_says_so_when_it_is_reset() -> None:
    run, x = one_axis()

    async def first() -> None:
        await x.enable()

    run.run(first())
    with pytest.raises(NotCopyable, match="no way back to before the first tick: program first: a coroutine"):
        run.reset()
    run.restore(run.snapshot())


def test_a_coroutine_that_the_snapshot_does_not_know_is_closed() -> None:
    run, x = ready()
    kept, seen = run.snapshot(), []

    async def later() -> None:
        try:
            await run.sleep(1.0)
        finally:
            seen.append(run.tick)
            x.move_absolute(5.0)

    program = run.start(later())
    run.step(30)
    run.restore(kept)
    run.step(50)
    assert (program.aborted, seen, x.set_position, run.failures) == (True, [32], 0.0, [])


def test_a_failed_program_goes_on_after_restore() -> None:
    run = stepped()

    def counts(_: Run, memory: SimpleNamespace) -> None:
        memory.n = getattr(memory, "n", 0) + 1
        if memory.n == 20:
            raise LookupError("on purpose")

    program = run.cyclic(counts)
    run.step(10)
    kept = run.snapshot()
    for _ in range(2):
        run.step(30)
        assert (run.failures, program.error is not None, program.memory.n) == ([program], True, 20)
        run.restore(kept)
        assert (run.failures, program.busy, program.failure, program.memory.n) == ([], True, None, 10)


def test_restore_after_a_fault_of_the_cycle() -> None:
    run, x = ready()
    x.move_absolute(100.0)
    run.step(20)
    kept, place = run.snapshot(), x.set_position
    store, run._stage._store = run._stage._store, None  # type: ignore[assignment]
    with pytest.raises(CycleFault):
        run.step()
    run._stage._store = store
    run.restore(kept)
    assert x.set_position == place
    run.step(1000)
    assert x.set_position == 100.0


def test_areas_come_back_and_readers_see_the_tick() -> None:
    run = stepped()
    inside, outside = run.areas.add("inside", 2), run.areas.add("outside", 2, outside=True)

    def counts(run: Run) -> None:
        inside.claim()[0] = run.tick

    run.cyclic(counts)
    outside.post(b"ab")
    run.step(6)
    kept = run.snapshot()
    outside.post(b"cd")
    run.step(20)
    assert outside.read() == b"cd"
    run.restore(kept)
    assert (inside.read_with_tick(), outside.read()) == ((5, b"\x05\0"), b"ab")
    run.step()
    assert inside.read_with_tick() == (6, b"\x06\0")


def test_what_is_posted_and_not_applied_stays_and_what_was_fed_comes_again() -> None:
    run, got = stepped(), list[bytes]()
    run.mailbox.register("test", got.append)
    waiting = run.mailbox.post("test", b"posted")
    kept = run.snapshot()
    run.restore(kept)
    assert not waiting.settled
    run.step()
    assert waiting.wait(0.0) == 0
    run.mailbox.feed([Input(3, "test", b"early"), Input(8, "test", b"late")])
    run.step(5)
    kept = run.snapshot()
    for _ in range(2):
        run.step(10)
        run.restore(kept)
    assert got == [b"posted", b"early", b"late", b"late"]


def test_what_cannot_be_copied_is_named_with_its_place() -> None:
    run = stepped()

    def opens(_: Run, memory: SimpleNamespace) -> None:
        memory.files = {"log": [open(__file__)]}  # noqa: SIM115, PTH123 - it is closed below

    program = run.cyclic(opens)
    run.step()
    with pytest.raises(NotCopyable) as caught:
        run.snapshot()
    program.memory.files["log"][0].close()
    assert str(caught.value) == (
        "program opens.memory.files['log'][0] is a _io.TextIOWrapper, which cannot be copied; "
        "keep it in a global or a closure instead"
    )


def test_a_method_is_a_program_with_its_object_as_memory() -> None:
    class Counter:
        __slots__ = ("last", "n")

        def __init__(self) -> None:
            self.n = 0

        def step(self, run: Run) -> None:
            self.n += 1
            self.last = run.tick

    run, counter = stepped(), Counter()
    run.cyclic(counter.step)
    kept = run.snapshot()
    run.step(5)
    run.restore(kept)
    assert counter.n == 0
    assert not hasattr(counter, "last")


def test_only_between_ticks_and_only_its_own() -> None:
    run, other = stepped(), stepped()
    kept = other.snapshot()
    with pytest.raises(ValueError, match=r"<Snapshot of tick 0> is of another run: restore it there"):
        run.restore(kept)
    failures = []

    def inside(run: Any) -> None:
        for action in (run.snapshot, lambda: run.restore(kept), run.advance):
            with pytest.raises(RuntimeError, match="a program cannot") as caught:
                action()
            failures.append(str(caught.value))

    run.cyclic(inside)
    run.step()
    assert failures[0].startswith("a program cannot take a snapshot itself: that is for who made the run")
    assert len(failures) == 3
    assert not run.failures


def test_a_trace_in_a_file_cannot_go_back_and_nothing_has_changed(tmp_path: Path) -> None:
    with Simulation(machine(), trace=tmp_path / "x.trace") as run:
        x = run.axes["X"]
        kept = run.snapshot()
        x.enable()
        run.step(20)
        actions: list[Callable[[], None]] = [lambda: run.restore(kept), run.reset]
        for action in actions:
            with pytest.raises(TraceError, match=r"x\.trace: a trace that is written to a file cannot go back; keep"):
                action()
        assert (run.tick, x.enabled) == (20, True)
    assert_valid(Trace.load(tmp_path / "x.trace"))


def test_a_run_that_has_ended_cannot_go_back() -> None:
    run, _ = ready()
    kept = run.snapshot()
    run.close()
    with pytest.raises(RuntimeError, match="make a new Simulation"):
        run.restore(kept)


def test_a_real_time_run_goes_back_and_begins_in_time() -> None:
    run = RealTime(machine(), clock=FakeClock(), trace=False)
    x, clock = run.axes["X"], run._pace._clock
    assert isinstance(clock, FakeClock)
    x.enable()
    run.run(time=0.1)
    clock.work(10**9)
    run.reset()
    run.run(time=0.1)
    assert run.statistics.overruns == 0
    assert run.statistics.lateness.count == 200
    assert not run.events.last(Level.WARNING)
    fresh = Simulation(machine(), trace=False)
    fresh.axes["X"].enable()
    fresh.run(time=0.1)
    assert run.close() == fresh.close()


def test_time_in_message_files_goes_on(tmp_path: Path) -> None:
    log = LogDescription(folder=str(tmp_path), level="verbose", start="2025-10-24T13:00:00")
    with Simulation(machine(), log=log) as run:
        x = run.axes["X"]
        run.step(50)
        kept = run.snapshot()
        for _ in range(3):
            x.enable()
            run.step(100)
            run.restore(kept)
        run.step(10)
        x.enable()
    (lines,) = files(tmp_path).values()
    accepted = [line.split("\t")[1] for line in lines if line.endswith("enable()")]
    assert accepted == [f"2025-10-24-13:00:00.{ms:03d}" for ms in (50, 150, 250, 360)]


def test_function_blocks_in_a_memory_come_back_with_their_outputs_and_images() -> None:
    run = Simulation(machine())
    ref, seen = run.axis_refs["X"], list[tuple[Any, ...]]()

    def main(_: Run, memory: SimpleNamespace) -> None:
        if not hasattr(memory, "power"):
            memory.power, memory.move = MC_Power(ref), MC_MoveAbsolute(ref)
        memory.power(Enable=True, Enable_Positive=True, Enable_Negative=True)
        move = memory.move
        move(Execute=memory.power.Status, Position=100.0, Velocity=400.0)
        status = ref.ReadStatus()
        seen.append((move.Busy, move.Active, move.Done, status.Moving, ref.NcToPlc.SetPos, ref.NcToPlc.CmdNo))

    run.cyclic(main)
    run.step(60)
    kept = run.snapshot()
    seen.clear()
    run.step(700)
    first = seen.copy()
    run.restore(kept)
    seen.clear()
    run.step(700)
    assert seen == first
    assert (first[0][:3], first[-1][:3]) == ((True, True, False), (False, False, True))
    assert_valid(run.trace)
