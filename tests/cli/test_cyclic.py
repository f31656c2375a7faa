"""Cyclic programs on the command line."""

from pathlib import Path

from motionlayer.cli import ExitCode
from tests.cli.support import PROGRAMS, call, line_of, program, recorded


def test_a_cyclic_program_runs_as_long_as_it_is_told(machine: Path) -> None:
    done = call("run", machine, *program("cyclic"), "--time", 0.4, "--trace", "run.trace")
    assert done.exit_code == ExitCode.OK, done.output
    assert "there 20.0" in done.stdout
    assert "programs    cyclic cancelled" in done.stdout
    recorded(Path("run.trace"), 400)
    assert call("verify", "run.trace").exit_code == ExitCode.OK


def test_a_cyclic_program_needs_a_time(machine: Path) -> None:
    done = call("run", machine, *program("cyclic"))
    assert done.exit_code == 2
    assert (
        "cyclic program cyclic goes on until it is cancelled, and the run might never end: give --time S" in done.stderr
    )


def test_a_cyclic_program_that_fails_ends_with_its_code(machine: Path) -> None:
    done = call("run", machine, *program("cyclic_raising"), "--time", 0.4)
    assert done.exit_code == ExitCode.FAILED
    line = line_of('raise ValueError("cyclic boom")')
    assert done.stderr == (
        f"Error: program cyclic_raising: ValueError: cyclic boom ({PROGRAMS}:{line} in cyclic_raising)\n"
    )


def test_a_cyclic_program_that_does_not_return_is_named(machine: Path) -> None:
    done = call("run", machine, *program("cyclic_stuck"), "--time", 0.4, "--patience", 0.2)
    assert done.exit_code == ExitCode.STUCK
    assert "program cyclic_stuck has not yielded for 0.2 s in tick 20;" in done.stderr
    assert "a cyclic program returns" in done.stderr
