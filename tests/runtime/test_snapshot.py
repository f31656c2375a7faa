"""Snapshots: after `restore` a run goes on bit for bit as one that has never been elsewhere."""

from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer import Simulation
from motionlayer.fb import MC_MoveAbsolute, MC_Power
from motionlayer.record import Trace
from motionlayer.runtime import CycleFault, Run
from motionlayer.verify import assert_valid
from tests.effort import examples
from tests.machines import machine, ready
from tests.runtime.bare import stepped
from tests.runtime.lives import lively, state


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
