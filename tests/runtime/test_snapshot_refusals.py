"""Snapshots that there cannot be, and ways back that are closed: each says why, and nothing has changed."""

from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest

from motionlayer import Simulation
from motionlayer.record import Trace, TraceError
from motionlayer.runtime import NotCopyable, Run
from motionlayer.verify import assert_valid
from tests.machines import machine, one_axis, ready
from tests.runtime.bare import stepped

if TYPE_CHECKING:
    from collections.abc import Callable


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
