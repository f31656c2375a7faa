"""A process that records is killed, as the system does it when memory runs out: what it wrote is readable."""

import random
import subprocess
import sys
from pathlib import Path

import pytest

from motionlayer.record import Trace
from motionlayer.record._dimensions import BLOCK_TICKS, BLOCKS
from motionlayer.verify import assert_valid

PENDULUM = """
import sys
from motionlayer import Machine, Simulation

limits = {"max_velocity": 1000.0, "max_acceleration": 8000.0, "max_jerk": 1e5}
machine = Machine.from_dict({"format": 1, "name": "one", "axis": {"X": limits}})
run = Simulation(machine, trace=sys.argv[1])

async def program():
    await run.axes["X"].enable()
    while True:
        for target in (100.0, -37.5):
            await run.axes["X"].move_absolute(target)

run.start(program())
while True:
    run.step(100)
    print(run.tick, flush=True)
"""

LOST = BLOCKS * BLOCK_TICKS[1]
"""Ticks: the block that is filled, the one that is written and the one that waits."""


def killed(path: Path, lines: int) -> int:
    """Record until so many hundred ticks have passed, and kill the process; return the last tick it told."""
    with subprocess.Popen([sys.executable, "-c", PENDULUM, str(path)], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        told = [process.stdout.readline() for _ in range(lines)]
        process.kill()
    return int(told[-1])


def judge(path: Path, told: int) -> None:
    trace = Trace.load(path)
    assert (trace.complete, trace.damage, trace.hash) == (False, "", "")
    assert trace.ticks.tolist() == list(range(len(trace.ticks)))
    assert len(trace.ticks) >= told - LOST
    assert_valid(trace, partial=True)


def test_a_killed_run_leaves_a_valid_trace_up_to_its_last_block(tmp_path: Path) -> None:
    path = tmp_path / "x.trace"
    judge(path, killed(path, 60))
    assert len(Trace.load(path).ticks) > LOST


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_so_it_is_at_any_moment(tmp_path: Path, seed: int) -> None:
    path = tmp_path / "x.trace"
    told = killed(path, random.Random(seed).randrange(35, 400))
    judge(path, told)
