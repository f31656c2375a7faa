import re
import subprocess
import sys
from pathlib import Path

import pytest

from motionlayer import Machine, Simulation
from motionlayer.cli import ExitCode
from motionlayer.cli._new import FILES
from motionlayer.machine import load_program, sources_of
from motionlayer.verify import assert_valid
from tests.cli.support import call, command


def test_a_new_machine_runs_at_once_and_moves_within_its_limits(tmp_path: Path) -> None:
    made = command("new", "press-7", "--folder", str(tmp_path))
    assert made.returncode == ExitCode.OK, made.stderr
    assert made.stdout.splitlines()[-1] == f"run it with: motionlayer run {tmp_path / 'press-7' / 'machine.toml'}"
    done = command("run", str(tmp_path / "press-7" / "machine.toml"))
    assert done.returncode == ExitCode.OK, done.stderr
    assert "done" in done.stdout
    machine = Machine.load(tmp_path / "press-7" / "machine.toml")
    assert machine.name == "press-7"
    with Simulation(machine, programs=[load_program(source) for source in sources_of(machine)]) as run:
        assert run.run()
        assert run.failures == []
        assert (run.axes["X"].set_position, run.axes["Y"].set_position) == (0.0, 0.0)
        assert_valid(run.trace)


def test_what_is_commented_out_becomes_a_machine_that_clients_reach(tmp_path: Path) -> None:
    call("new", "cell", "--folder", tmp_path)
    path = tmp_path / "cell" / "machine.toml"
    text = path.read_text(encoding="utf-8")
    path.write_text(re.sub(r"^# (?=\[|port|folder)", "", text, flags=re.MULTILINE), encoding="utf-8")
    description = Machine.load(path).description
    assert description.layer is not None
    assert (description.ads is not None, description.log is not None) == (True, True)


@pytest.mark.slow
def test_the_new_program_has_correct_types(tmp_path: Path) -> None:
    call("new", "cell", "--folder", tmp_path)
    checker = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", str(tmp_path / "cell" / "program.py")]
    done = subprocess.run(checker, capture_output=True, text=True, check=False, timeout=120)
    assert (done.stdout, done.returncode) == ("", 0)


@pytest.mark.parametrize("taken", FILES)
def test_nothing_is_overwritten(tmp_path: Path, taken: str) -> None:
    (tmp_path / "cell").mkdir()
    (tmp_path / "cell" / taken).write_text("mine", encoding="utf-8")
    done = call("new", "cell", "--folder", tmp_path)
    assert done.exit_code == ExitCode.USAGE
    assert f"{tmp_path / 'cell' / taken} is there already" in done.stderr
    assert [path.name for path in (tmp_path / "cell").iterdir()] == [taken]
    assert (tmp_path / "cell" / taken).read_text(encoding="utf-8") == "mine"


def test_a_folder_with_other_files_is_taken(tmp_path: Path) -> None:
    (tmp_path / "cell").mkdir()
    (tmp_path / "cell" / "notes.txt").touch()
    assert call("new", "cell", "--folder", tmp_path).exit_code == ExitCode.OK


@pytest.mark.parametrize("name", ["a/b", "..", "", 'x"', "-x", "a b"])
def test_a_name_that_is_no_good_for_a_folder(tmp_path: Path, name: str) -> None:
    done = call("new", "--folder", tmp_path, "--", name)
    assert done.exit_code == ExitCode.USAGE
    assert "must be letters, digits, - and _" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_where_nothing_can_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    (tmp_path / "cell").symlink_to(tmp_path / "file")
    done = call("new", "cell", "--folder", tmp_path)
    assert done.exit_code == ExitCode.OUTPUT
    assert "cannot be written" in done.stderr
