"""The shortest example: what README says of it holds, and it is the same program however it is run."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from motionlayer import Machine, Simulation
from motionlayer.verify import assert_valid

FOLDER = Path(__file__).resolve().parent.parent.parent / "examples" / "first"


def test_x_turns_round_in_motion_and_comes_back(capsys: pytest.CaptureFixture[str]) -> None:
    with Simulation(Machine.load(FOLDER / "machine.toml")) as run:
        assert run.run()
    assert not run.failures
    trace = run.trace
    assert_valid(trace)
    back = next(plan for plan in trace.plans if plan.axis == "X" and plan.kind == "position" and plan.target == 0.0)
    row = back.tick - int(trace.ticks[0])
    assert trace["X.set_velocity"][row] > 100.0
    assert trace["X.set_position"].max() < 800.0
    assert (trace["X.set_position"][-1], trace["Y.set_position"][-1]) == (0.0, 50.0)
    assert capsys.readouterr().out.endswith("s: X at 0.0, Y at 50.0\n")


def test_the_command_line_gives_the_hash_that_python_gives(tmp_path: Path) -> None:
    with Simulation(Machine.load(FOLDER / "machine.toml")) as run:
        run.run()
    command = [sys.executable, "-m", "motionlayer", "run", str(FOLDER / "machine.toml"), "--hash"]
    done = subprocess.run(command, cwd=tmp_path, env=os.environ, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == f"trace hash: {run.close()}"
