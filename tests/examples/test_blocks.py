"""The saw: its blocks and its step chain do what a PLC would."""

import shutil
from pathlib import Path

import pytest

from motionlayer import Machine, Simulation
from motionlayer.drive import Fault, FaultKind
from motionlayer.verify import assert_valid

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "blocks"


def test_the_saw_cuts_its_pieces_and_switches_off(capsys: pytest.CaptureFixture[str]) -> None:
    with Simulation(Machine.load(FOLDER / "machine.toml")) as run:
        assert run.run(time=20.0)
    assert not run.failures
    assert capsys.readouterr().out.splitlines() == [f"piece {number} of 120 mm" for number in range(1, 6)]
    assert run.axes["Feed"].set_position == 600.0
    assert not run.axes["Feed"].enabled
    trace = run.trace
    assert_valid(trace)
    cutting = trace["Blade.set_position"] < 10.0
    later = trace.ticks > 1000  # the homing is over
    assert abs(trace["Feed.set_velocity"][cutting & later]).max() == 0.0


def test_a_drive_that_fails_is_reset_and_the_saw_goes_on(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(FOLDER, tmp_path / "saw")
    file = tmp_path / "saw" / "machine.toml"
    servo = 'software_limit_max = 2000.0\ndrive = { kind = "servo", position_gain = 60.0 }'
    file.write_text(file.read_text(encoding="utf-8").replace("software_limit_max = 2000.0", servo), encoding="utf-8")
    with Simulation(Machine.load(file)) as run:
        run.inject("Feed", Fault(FaultKind.DRIVE_ERROR), 1500)
        assert run.run(time=20.0)
    assert not run.failures
    assert capsys.readouterr().out.count("piece") == 5
    trace = run.trace
    assert any(event.source == "Feed" and event.text.startswith("reset") for event in trace.events)
    assert_valid(trace)
