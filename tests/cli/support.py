"""A machine, programs and two ways to call the command: in this process, and as a user does."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Final

from click.testing import CliRunner, Result

from motionlayer.cli._main import group
from motionlayer.record import Trace

SOURCE: Final = Path(__file__).resolve().parents[2] / "src"

MACHINE: Final = """\
format = 1
name = "one"
[axis.X]
max_velocity = 1000.0
max_acceleration = 8000.0
max_jerk = 100000.0
software_limit_max = 500.0
"""

PROGRAMS: Final = Path(__file__).with_name("programs.py")


def call(*arguments: object) -> Result:
    """Call the command in this process."""
    return CliRunner().invoke(group, [str(argument) for argument in arguments], prog_name="motionlayer")


def command(*arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
    """Call the command in a process of its own."""
    return python("-m", "motionlayer", *(str(argument) for argument in arguments), **environment)


def python(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Call Python with this checkout on its path."""
    return subprocess.run(
        [sys.executable, *arguments],
        env={**os.environ, "PYTHONPATH": str(SOURCE), **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )


def program(name: str) -> tuple[str, str]:
    """Return the option that runs a program of `programs.py`."""
    return "--program", f"{PROGRAMS}:{name}"


def line_of(text: str) -> int:
    """Return the number of the line of `programs.py` that holds a text."""
    lines = PROGRAMS.read_text(encoding="utf-8").splitlines()
    (number,) = [number for number, line in enumerate(lines, 1) if text in line]
    return number


def recorded(path: Path, ticks: int) -> Trace:
    """Return a trace, which must hold these ticks from 0 on without a gap, and its own end."""
    trace = Trace.load(path)
    assert trace.complete
    assert trace.ticks.tolist() == list(range(ticks))
    return trace
