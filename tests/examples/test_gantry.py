"""The gantry of the demo: works off its list, and its trace stands up to verify."""

import csv
import os
import subprocess
import sys
from pathlib import Path

import pytest

from motionlayer import Machine, Simulation
from motionlayer.verify import assert_valid

FOLDER = Path(__file__).resolve().parent.parent.parent / "examples" / "gantry"


@pytest.mark.parametrize(
    ("time", "parts"), [(30.0, 10), pytest.param(None, 200, marks=pytest.mark.slow)], ids=["the first", "all"]
)
def test_the_gantry_visits_every_position_of_its_list(
    capsys: pytest.CaptureFixture[str], time: float | None, parts: int
) -> None:
    with Simulation(Machine.load(FOLDER / "machine.toml")) as run:
        run.run(time=time)
    assert not run.failures
    trace = run.trace
    assert_valid(trace)
    low = trace["Z.set_position"] < 70.0
    spots = {
        (round(float(x), 3), round(float(y), 3), round(float(z), 3))
        for x, y, z in zip(*(trace[f"{axis}.set_position"][low] for axis in "XYZ"), strict=True)
    }
    with (FOLDER / "positions.csv").open(newline="") as file:
        rows = [[float(value) for value in row] for row in list(csv.reader(file))[1:]]
    assert len(rows) == 200
    for row in rows[:parts]:
        assert {tuple(row[:3]), tuple(row[3:])} <= spots
    assert ("200 parts in" in capsys.readouterr().out) == (parts == 200)


def short_run(tmp_path: Path, *options: str, **environment: str) -> str:
    """Return the last line of the first seconds of the demo."""
    command = [sys.executable, "-m", "motionlayer", "run", str(FOLDER / "machine.toml"), "--time", "6", *options]
    done = subprocess.run(
        command, cwd=tmp_path, env=os.environ | environment, capture_output=True, text=True, check=True
    )
    return done.stdout.splitlines()[-1]


@pytest.mark.slow
def test_the_hash_of_the_demo_is_the_same_however_it_is_run(tmp_path: Path) -> None:
    lines = {
        short_run(tmp_path, "--hash", PYTHONHASHSEED="1"),
        short_run(tmp_path, "--hash", PYTHONHASHSEED="2"),
        short_run(tmp_path, "--hash", MOTIONLAYER_KERNELS="plain"),
        short_run(tmp_path, "--trace", "a.trace", "--plot", "a.html"),
    }
    assert len(lines) == 1
    assert lines.pop().startswith("trace hash: ")
