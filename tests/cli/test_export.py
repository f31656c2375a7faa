from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from motionlayer.iec.export import c_header, structured_text
from motionlayer.machine import Machine, interface
from tests.cli.support import MACHINE, call

LAYER = "\n[layer]\nmax_r_para = 20\n"


@pytest.fixture
def layered(machine: Path) -> Path:
    machine.write_text(MACHINE + LAYER, encoding="utf-8")
    return machine


def test_declarations_go_to_stdout(layered: Path) -> None:
    done = call("export", layered, "--c")
    assert done.exit_code == ExitCode.OK
    (header,) = c_header(interface(Machine.load(layered))).values()
    assert done.stdout == header


def test_declarations_go_into_a_folder_with_the_sizes_of_the_machine(layered: Path, tmp_path: Path) -> None:
    for _ in range(2):  # of another version, they are replaced
        done = call("export", layered, "--st", "--out", tmp_path)
        assert done.exit_code == ExitCode.OK
        names = ["motion_layer.st", "motion_layer_libraries.st"]
        assert done.stdout == "".join(f"written {tmp_path / name}\n" for name in names)
    files = structured_text(interface(Machine.load(layered)))
    assert {name: (tmp_path / name).read_text(encoding="utf-8") for name in names} == files
    text = files["motion_layer.st"]
    assert "Ctrl AT %Q* : ARRAY [1..1] OF ST_AXIS_CTRL;" in text
    assert "_rValue : ARRAY [0..20] OF LREAL;" in text


def test_csharp_has_its_file(layered: Path, tmp_path: Path) -> None:
    assert call("export", layered, "--csharp", "--out", tmp_path).exit_code == ExitCode.OK
    assert (tmp_path / "MotionLayer.cs").read_text(encoding="utf-8").startswith("// motionlayer: interface of one")


def test_a_control_side_has_the_same_interface(machine: Path) -> None:
    machine.write_text('format = 1\nname = "plc"\n[control]\naxes = ["X", "Y"]\n', encoding="utf-8")
    done = call("export", machine, "--st")
    assert done.exit_code == ExitCode.OK
    assert "Ctrl AT %Q* : ARRAY [1..2] OF ST_AXIS_CTRL;" in done.stdout


@pytest.mark.parametrize("languages", [[], ["--st", "--c"]])
def test_one_language_must_be_said(layered: Path, languages: list[str]) -> None:
    done = call("export", layered, *languages)
    assert done.exit_code == ExitCode.USAGE
    assert "say which language: one of --st, --c, --csharp" in done.stderr


def test_a_machine_without_a_motion_layer(machine: Path) -> None:
    done = call("export", machine, "--st")
    assert done.exit_code == ExitCode.FAILED
    assert done.stderr == "Error: one has no motion layer: add [layer] to the machine file, or [control]\n"


def test_a_folder_that_is_not_there(layered: Path, tmp_path: Path) -> None:
    done = call("export", layered, "--st", "--out", tmp_path / "no")
    assert done.exit_code == ExitCode.OUTPUT
    assert done.stderr == f"Error: {tmp_path / 'no'}: there is no such folder\n"


def test_a_file_that_cannot_be_written(layered: Path, tmp_path: Path) -> None:
    (tmp_path / "motion_layer.h").mkdir()
    done = call("export", layered, "--c", "--out", tmp_path)
    assert done.exit_code == ExitCode.OUTPUT
    assert f"{tmp_path / 'motion_layer.h'} cannot be written" in done.stderr
