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


DOUBTFUL = """\
software_limit_min = -10.0
start_position = -20.0

[axis.X.drive]
kind = "servo"
position_gain = 50.0
max_acceleration = 4000.0

[axis.Y]
max_velocity = 1000.0
max_acceleration = 8000.0
max_jerk = 100000.0
home = { mode = "switch", switch = -300.0, travel = 120.0 }
"""


def test_what_is_valid_and_can_hardly_be_meant_is_a_warning(machine: Path) -> None:
    machine.write_text(MACHINE + DOUBTFUL, encoding="utf-8")
    done = call("check", machine)
    assert done.exit_code == ExitCode.OK
    said = [line for line in done.stderr.splitlines() if not line.startswith(" ")]
    assert [line.partition("Warning: machine.toml:")[2] for line in said] == [
        "9: axis.X.start_position = -20.0: outside of the software limits",
        "14: axis.X.drive.max_acceleration = 4000.0: less than the 8000.0 that the axis may ask for (mm/s²)",
        "20: axis.Y.home.switch = -300.0: 300 from start_position, and a search goes 120 (mm)",
    ]
    assert "lower max_acceleration and max_deceleration" in done.stderr
    assert done.stdout == "machine.toml: valid: one, axes: X, Y; programs: none\n"


@pytest.mark.parametrize("host", ["plc-17.fabrik.local", "plc"])
def test_a_server_that_is_to_listen_at_another_computer(machine: Path, host: str) -> None:
    machine.write_text(MACHINE + f'[ads]\nhost = "{host}"\n', encoding="utf-8")
    line = f'Warning: machine.toml:9: ads.host = "{host}": a name, where the server needs an address of this computer'
    assert call("check", machine).stderr.splitlines()[0] == line


@pytest.mark.parametrize("host", ["127.0.0.1", "0.0.0.0", "::1", "localhost"])  # noqa: S104 - only checked
def test_a_server_that_listens_here(machine: Path, host: str) -> None:
    machine.write_text(MACHINE + f'[ads]\nhost = "{host}"\n', encoding="utf-8")
    assert call("check", machine).stderr == ""


def test_what_can_be_meant_is_none(machine: Path) -> None:
    text = DOUBTFUL.replace("-20.0", "-5.0").replace("= 4000.0", "= 8000.0").replace("-300.0", "-100.0")
    machine.write_text(MACHINE + text, encoding="utf-8")
    assert call("check", machine).stderr == ""


def test_a_start_outside_the_limits_is_nothing_where_homing_defines_the_positions_anew(machine: Path) -> None:
    text = MACHINE + 'software_limit_min = 0.0\nstart_position = -20.0\nhome = { mode = "switch", switch = -30.0 }\n'
    machine.write_text(text, encoding="utf-8")
    assert call("check", machine).stderr == ""
