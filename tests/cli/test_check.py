from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from tests.cli.support import MACHINE, call


def test_a_valid_machine(machine: Path) -> None:
    done = call("check", machine)
    assert done.exit_code == ExitCode.OK
    assert done.stdout == "machine.toml: valid: one, axes: X; programs: none\n"


@pytest.mark.parametrize("command", [["check"], ["run", "--time", "1"]])
def test_every_problem_with_line_field_value_range_and_nearest_key(machine: Path, command: list[str]) -> None:
    text = MACHINE.replace("max_jerk", "max_jrek").replace("velocity = 1000.0", "velocity = -5.0")
    machine.write_text(text, encoding="utf-8")
    done = call(*command, machine)
    assert done.exit_code == ExitCode.FAILED
    assert done.stdout == ""
    assert done.stderr.splitlines() == [
        "Error: 2 problems in the machine file",
        "machine.toml:4: axis.X.max_velocity = -5.0: must be greater than 0 (mm/s)",
        "machine.toml:6: axis.X.max_jrek: unknown key; did you mean max_jerk?",
    ]


def test_a_machine_that_is_not_there() -> None:
    done = call("check", "nowhere.toml")
    assert done.exit_code == ExitCode.FAILED
    assert done.stderr == "Error: a problem in the machine file\nnowhere.toml: no such file\n"


def test_a_module_is_checked_with_what_includes_it(machine: Path) -> None:
    machine.write_text(MACHINE.replace('name = "one"\n', ""), encoding="utf-8")
    done = call("check", machine)
    assert done.exit_code == ExitCode.FAILED
    _, said, hint = done.stderr.splitlines()
    assert said == "machine.toml:1: name: missing; must be a text that is not empty"
    assert hint.strip() == (
        "a module has no name, and is checked together with the machine that includes it: motionlayer check MACHINE"
    )
    machine.write_text(f"seed = 3\n{machine.read_text(encoding='utf-8')}", encoding="utf-8")  # of no module
    assert "a module" not in call("check", machine).stderr


@pytest.mark.parametrize(("unit", "said"), [('"deg"', "deg/s"), ('"%1"', "%1/s"), ("3", "u/s"), ('""', "u/s")])
def test_limits_are_said_in_the_unit_of_the_axis(machine: Path, unit: str, said: str) -> None:
    text = MACHINE.replace("max_velocity = 1000.0", f"max_velocity = 0\nunit = {unit}")
    machine.write_text(text, encoding="utf-8")
    assert f"axis.X.max_velocity = 0: must be greater than 0 ({said})" in call("check", machine).stderr
