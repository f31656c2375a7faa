"""The cutter: its tests pass, and find a control program that moves material under the knife."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "commissioning"


def outcome(folder: Path, choice: str) -> subprocess.CompletedProcess[str]:
    """Run tests of the cutter as a user does, from the folder they are in."""
    call = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        "-c",
        "/dev/null",
        "--rootdir",
        ".",
        "-k",
        choice,
    ]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    return subprocess.run(call, cwd=folder, env=environment, capture_output=True, text=True, timeout=300, check=False)


@pytest.mark.parametrize(
    "choice",
    ["three or alarm", pytest.param("moment", marks=pytest.mark.slow)],
    ids=["some", "moments"],
)
def test_the_control_program_passes_its_tests(choice: str) -> None:
    done = outcome(FOLDER, choice)
    assert done.returncode == 0, done.stdout


@pytest.mark.slow
def test_a_mistake_in_the_recovery_is_found(tmp_path: Path) -> None:
    folder = tmp_path / "cutter"
    shutil.copytree(FOLDER, folder, ignore=shutil.ignore_patterns("__pycache__"))
    program = folder / "cutter.py"
    right = "Step.SWITCH_ON: Step.RETRACT"
    assert right in program.read_text()
    program.write_text(program.read_text().replace(right, "Step.SWITCH_ON: Step.FEED"))
    done = outcome(folder, "0.7 and Knife and enable")
    assert done.returncode == 1
    assert "material moves under the knife at" in done.stdout
