"""The same machine, program and seed give the same trace bit for bit, whoever looks on (design 2)."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from motionlayer import Simulation, Trace
from motionlayer.nc import Direction
from tests.machines import SWITCH, machine


def perform(run: Simulation) -> None:
    """A run with several programs, random numbers, a failure and a cancelled wait."""
    axes = list(run.axes.values())

    async def wander(number: int) -> None:
        x, random = axes[number], run.random(f"wander {number}")
        await x.enable()
        for _ in range(6):
            x.move_absolute(float(random.uniform(-90.0, 390.0)))
            await run.sleep(float(random.uniform(0.0, 0.2)))
        x.move_velocity(30.0, Direction.NEGATIVE)
        await run.sleep(0.1)
        if number == 1:
            raise LookupError("on purpose")
        await x.stop()
        await x.home()

    async def watcher() -> None:
        await run.until(lambda: axes[0].set_position > 1000.0)

    for number in range(3):
        run.start(wander(number), f"wander {number}")
    run.start(watcher())
    run.run(time=4.0)


def run_hash(**options: object) -> str:
    run = Simulation(machine(3, home=SWITCH), **options)  # type: ignore[arg-type]
    perform(run)
    return run.close()


def test_twice_the_same() -> None:
    first, second = (Simulation(machine(3, home=SWITCH)) for _ in range(2))
    perform(first)
    perform(second)
    assert first.trace == second.trace
    assert first.trace.hash


def test_observers_change_nothing(tmp_path: Path) -> None:
    path = tmp_path / "run.trace"
    plain = run_hash()
    assert plain
    assert run_hash(trace=False) == plain
    assert run_hash(trace=path) == plain
    assert Trace.load(path).hash == plain


def test_no_observer_at_all_moves_the_same() -> None:
    ends = []
    for trace in (True, None):
        run = Simulation(machine(3, home=SWITCH), trace=trace)
        perform(run)
        ends.append([axis._store.table.tobytes() for axis in run.axes.values()])
    assert ends[0] == ends[1]


def test_what_runs_decides_the_hash() -> None:
    assert run_hash(seed=1) != run_hash(seed=2)


def test_a_pause_between_ticks_changes_nothing() -> None:
    """Steps one by one, or many at once."""
    hashes = []
    for chunk in (1, 7, 300):
        run = Simulation(machine(), trace=True)
        axis = run.axes["X"]
        axis.enable()
        run.step(2)
        axis.move_absolute(300.0)
        done = 0
        while done < 2100:
            run.step(chunk)
            done += chunk
        hashes.append(run.close())
    assert len(set(hashes)) == 1


@pytest.mark.slow
def test_the_hash_seed_of_python_does_not_matter() -> None:
    code = "from tests.runtime.test_sameness import run_hash; print(run_hash(trace=False))"
    hashes = []
    for seed in ("0", "12345"):
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        done = subprocess.run(
            [sys.executable, "-c", code],
            env=environment,
            cwd=Path(__file__).parents[2],
            capture_output=True,
            text=True,
            check=True,
        )
        hashes.append(done.stdout)
    assert hashes[0] == hashes[1] == run_hash(trace=False) + "\n"
