"""Ctrl-C. Programs and listeners raise the signal themselves, so that it comes in a known tick."""

import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from tests.cli.support import call, program, recorded


@pytest.mark.parametrize(
    ("name", "ticks"),
    [
        ("interrupting", 11),  # in a program: after the tick
        ("interrupting_between", 2),  # in a step of the runtime: after the tick as well
        ("hanging_predicate", 1),  # it never ends: the second one counts at once
        ("interrupting_at_once", 0),  # two at once, in a program: the tick has not been recorded yet
    ],
)
def test_an_interrupted_run_ends_in_order(machine: Path, name: str, ticks: int) -> None:
    before = signal.getsignal(signal.SIGINT)
    done = call("run", machine, *program(name), "--trace", "run.trace")
    assert done.exit_code == ExitCode.INTERRUPTED
    assert done.stderr.startswith("Error: interrupted at ")
    assert "Traceback" not in done.stderr
    trace = recorded(Path("run.trace"), ticks)
    assert done.stdout.splitlines()[-1] == f"trace hash: {trace.hash}"
    assert signal.getsignal(signal.SIGINT) is before


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Let Ctrl-C count, also where the tests run as a job that ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_an_interrupt_while_loading(machine: Path) -> None:
    Path("p.py").write_text("import os, signal\nos.kill(os.getpid(), signal.SIGINT)\n", encoding="utf-8")
    done = call("run", machine, "--program", "p.py")
    assert (done.exit_code, done.stderr) == (ExitCode.INTERRUPTED, "Error: interrupted\n")
