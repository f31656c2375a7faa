"""The feeder: it lags as its parameters say, loses a drive, and goes on."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from motionlayer import Machine, Simulation
from motionlayer.event import Level
from motionlayer.verify import assert_valid

FOLDER = Path(__file__).resolve().parent.parent.parent / "examples" / "servo"


def test_the_feeder_lags_fails_and_goes_on(capsys: pytest.CaptureFixture[str]) -> None:
    with Simulation(Machine.load(FOLDER / "machine.toml")) as run:
        run.run()
    assert not run.failures
    out = capsys.readouterr().out
    assert "the drive is not ready" in out
    assert "part 4" in out
    errors = [event for event in run.events.last(Level.ERROR) if event.source == "Feed"]
    assert {event.tick for event in errors} == {1850}
    trace = run.trace
    assert_valid(trace)
    v, state = trace["Feed.set_velocity"], trace["Feed.state"]
    lag = np.concatenate([np.zeros(2), trace["Feed.set_position"][:-2]]) - trace["Feed.actual_position"]
    steady = np.abs(v) == 800.0
    steady &= np.concatenate([np.zeros(60, bool), steady[:-60]])  # transients of 1/60 s are over
    assert steady.sum() > 50
    expected = np.sign(v[steady]) * (0.3 * 800.0 / 60.0 + 0.01)
    assert np.abs(lag[steady] - expected).max() < 0.15
    assert np.abs(lag[state > 3.0]).max() < 8.0
    stopped = trace["Lift.state"] == 4.0
    assert stopped.any()


@pytest.mark.slow
@pytest.mark.parametrize("seconds", ["0.3", "2"])
def test_the_hash_of_noisy_drives_is_the_same_compiled_and_plain(tmp_path: Path, seconds: str) -> None:
    lines = set()
    for mode in ("compiled", "plain"):
        command = [
            sys.executable,
            "-m",
            "motionlayer",
            "run",
            str(FOLDER / "machine.toml"),
            "--time",
            seconds,
            "--hash",
        ]
        done = subprocess.run(
            command,
            cwd=tmp_path,
            env=os.environ | {"MOTIONLAYER_KERNELS": mode},
            capture_output=True,
            text=True,
            check=True,
        )
        lines.add(done.stdout.splitlines()[-1])
    assert len(lines) == 1
    assert lines.pop().startswith("trace hash: ")


def test_the_seed_is_in_the_noise() -> None:
    hashes = set()
    for seed in (1, 1, 2):
        run = Simulation(Machine.load(FOLDER / "machine.toml"), seed=seed, trace=False)
        run.run(time=0.3)
        hashes.add(run.close())
    assert len(hashes) == 2
