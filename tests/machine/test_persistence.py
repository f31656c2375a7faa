"""Parameters that outlive a run."""

from pathlib import Path
from typing import Any

import pytest
from tests.machines import finish

from motionlayer import Machine, MachineError, Simulation
from motionlayer.command import ErrorId
from motionlayer.fb import (
    MC_AxisParameter,
    MC_WriteBoolParameterPersistent,
    MC_WriteParameterPersistent,
)
from motionlayer.machine import replay
from motionlayer.verify import assert_valid

P = MC_AxisParameter
FILE = """
format = 1
name = "kept"
persistent_file = "parameters.toml"
[axis.X]
max_velocity = 500.0
max_acceleration = 5000.0
max_jerk = 1e5
"""


def machine(folder: Path, text: str = FILE) -> Machine:
    file = folder / "machine.toml"
    file.write_text(text, encoding="utf-8")
    return Machine.load(file)


def write(run: Simulation, number: int, value: Any) -> int:
    kind: Any = MC_WriteBoolParameterPersistent if isinstance(value, bool) else MC_WriteParameterPersistent
    block = kind(run.axis_refs["X"])
    block(Execute=True, ParameterNumber=number, Value=value)
    run.step()
    block()
    assert block.Done != block.Error
    return int(block.ErrorID)


def kept(folder: Path) -> str:
    return (folder / "parameters.toml").read_text(encoding="utf-8")


def test_what_is_written_holds_in_the_next_run(tmp_path: Path) -> None:
    with Simulation(machine(tmp_path)) as run:
        assert write(run, P.AxisMaxVelocity, 100.0) == 0
        assert write(run, P.SWLimitPos, 50.0) == 0
        assert write(run, P.EnableLimitPos, True) == 0
    assert "[X]\nAxisMaxVelocity = 100.0\nSWLimitPos = 50.0\nEnableLimitPos = true\n" in kept(tmp_path)
    with Simulation(machine(tmp_path)) as run:
        x = run.axes["X"]
        x.enable()
        run.step(2)
        assert (x.config.maximum.velocity, x.config.limit_max) == (100.0, 50.0)
        assert x.move_absolute(51.0).error is not None
        finish(run, x.move_absolute(40.0))
        run.step(2)
    trace = run.trace
    assert abs(trace["X.set_velocity"]).max() <= 100.0 * (1.0 + 1e-9)
    assert_valid(trace)


def test_a_replay_uses_what_was_recorded_and_writes_nothing(tmp_path: Path) -> None:
    file = tmp_path / "parameters.toml"
    file.write_text("[X]\nAxisMaxVelocity = 120.0\n", encoding="utf-8")
    with Simulation(machine(tmp_path)) as run:
        run.step(3)
    file.write_text("[X]\nAxisMaxVelocity = 80.0\n", encoding="utf-8")
    again = replay(run.trace, folder=tmp_path)
    assert again.same, again.difference
    assert "80.0" in file.read_text(encoding="utf-8")


def test_of_two_names_for_one_parameter_the_last_counts(tmp_path: Path) -> None:
    with Simulation(machine(tmp_path)) as run:
        for number, value in ((P.AxisMaxVelocity, 300.0), (P.MaxVelocityAppl, 200.0), (P.AxisMaxVelocity, 250.0)):
            assert write(run, number, value) == 0
    with Simulation(machine(tmp_path)) as run:
        run.step()
        assert run.axes["X"].config.maximum.velocity == 250.0


def test_what_is_refused_is_not_kept(tmp_path: Path) -> None:
    with Simulation(machine(tmp_path)) as run:
        assert write(run, P.AxisMaxVelocity, 501.0) == ErrorId.PARAMETER
    assert not (tmp_path / "parameters.toml").exists()


def test_without_a_file_nothing_is_written_persistently(tmp_path: Path) -> None:
    with Simulation(machine(tmp_path, FILE.replace("persistent_file", "# "))) as run:
        assert write(run, P.AxisMaxVelocity, 100.0) == ErrorId.FUNCTION_NOT_ALLOWED
        assert run.axes["X"].config.maximum.velocity == 500.0


def test_a_file_that_cannot_be_written_is_an_error_of_the_block(tmp_path: Path) -> None:
    with Simulation(machine(tmp_path, FILE.replace("parameters.toml", "nowhere/parameters.toml"))) as run:
        assert write(run, P.AxisMaxVelocity, 100.0) == ErrorId.INTERNAL


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("[Y]\nAxisAcc = 1.0", "Y: must be the table of an axis: X"),
        ("X = 3", "must be the table of an axis"),
        ("[X]\nAxisAccc = 1.0", "X.AxisAccc: must be a parameter that can be written"),
        ("[X]\nActualVelocity = 1.0", "must be a parameter that can be written"),
        ("[X]\nAxisAcc = true", "X.AxisAcc = true: must be a number"),
        ("[X]\nEnableLimitPos = 1.0", "must be true or false"),
        ("[X\n", "must be TOML"),
    ],
)
def test_a_file_that_means_nothing_is_refused(tmp_path: Path, text: str, match: str) -> None:
    (tmp_path / "parameters.toml").write_text(text, encoding="utf-8")
    with pytest.raises(MachineError, match=match):
        Simulation(machine(tmp_path))


def test_a_value_that_no_longer_fits_is_refused_with_a_message(tmp_path: Path) -> None:
    (tmp_path / "parameters.toml").write_text("[X]\nAxisMaxVelocity = 900.0\n", encoding="utf-8")
    with Simulation(machine(tmp_path)) as run:
        run.step()
        assert run.axes["X"].config.maximum.velocity == 500.0
    assert any("AxisMaxVelocity = 900.0, allowed: 0.0 < x <= 500.0 mm/s" in event.text for event in run.trace.events)
