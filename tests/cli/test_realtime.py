"""`motionlayer run --realtime`, and the signals that end a run.

How late the ticks are depends on the computer, so no test here looks at it; `tests/machine/test_realtime.py` does, on
a clock of its own.
"""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from motionlayer.cli._distribution import overruns
from motionlayer.cli._options import FASTEST, SLOWEST
from motionlayer.machine import REALTIME_PATIENCE
from motionlayer.record import Trace
from motionlayer.runtime import FASTEST as FASTEST_PACE
from motionlayer.runtime import SLOWEST as SLOWEST_PACE
from motionlayer.runtime import Histogram, Statistics
from tests.cli.support import MACHINE, SOURCE, call, program, recorded

QUIET = "[realtime]\npriority = 0\nlock_memory = false\n"


@pytest.fixture
def slow_machine(machine: Path) -> Path:
    """A machine whose ticks take ten seconds at the lowest speed."""
    machine.write_text(MACHINE.replace('"one"', '"one"\nbase_cycle_ns = 100_000_000') + QUIET, encoding="utf-8")
    return machine


def test_a_run_in_real_time_shows_what_was_measured(machine: Path) -> None:
    machine.write_text(MACHINE + QUIET, encoding="utf-8")
    done = call("run", machine, *program("noisy"), "--realtime", "--time", 0.1, "--trace", "run.trace")
    assert done.exit_code == ExitCode.OK, done.output
    lines = done.stdout.splitlines()
    ticks = len(Trace.load("run.trace").ticks)
    assert f"real time   {ticks / 1000:.9g} s in {ticks} ticks of 1 ms" in lines
    spread = r"min [\d.]+ [nµm]?s, median [\d.]+ [nµm]?s, p99 [\d.]+ [nµm]?s, max [\d.]+ [nµm]?s"
    for name in ("compute", "lateness"):
        assert [line for line in lines if re.fullmatch(rf"{name:<11} {spread}", line)]
    start = next(number for number, line in enumerate(lines) if line.startswith("histogram"))
    assert lines[start].split() == ["histogram", "from", "compute", "lateness"]
    (overruns,) = [line for line in lines if line.startswith("overruns")]
    assert re.match(rf"overruns +\d+ of {ticks} ticks; time (never )?slipped", overruns)
    assert [line for line in lines if line.startswith("slowest")]
    assert not [line for line in lines if line.startswith("refused")]


def test_the_histogram_counts_every_tick(machine: Path) -> None:
    done = call("run", machine, "--time", 0.5, "--statistics")
    assert done.exit_code == ExitCode.OK
    rows = re.findall(r"^ +\d+ [nµm]?s +(\d+) #+$", done.stdout, re.MULTILINE)
    assert sum(map(int, rows)) == 500
    assert "lateness" not in done.stdout


def test_nothing_is_measured_unless_asked(machine: Path) -> None:
    assert "compute" not in call("run", machine, "--time", 0.01).stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--speed", "2"], "--speed is that of a clock: give --realtime as well"),
        (["--realtime", "--speed", "0"], "'--speed': 0 must be 0.01 to 1000 (times real time)"),
        (["--realtime", "--speed", "1001"], "'--speed': 1001 must be 0.01 to 1000 (times real time)"),
        (["--realtime", "--speed", "nan"], "'--speed': nan must be 0.01 to 1000 (times real time)"),
        (["--realtime", "--speed", "fast"], "'--speed': 'fast' is not a valid float"),
    ],
)
def test_wrong_options(machine: Path, arguments: list[str], said: str) -> None:
    done = call("run", machine, "--time", 1, *arguments)
    assert done.exit_code == ExitCode.USAGE
    assert said in done.stderr


def test_the_help_tells_the_bounds_of_the_runtime() -> None:
    assert (SLOWEST, FASTEST) == (SLOWEST_PACE, FASTEST_PACE)
    text = " ".join(call("run", "--help").stdout.split())
    assert f"{SLOWEST:g} to {FASTEST:g}" in text
    assert f"in real time [{REALTIME_PATIENCE:g}]" in text


@pytest.mark.parametrize(
    ("key", "value", "allowed"),
    [("priority", "100", "99"), ("priority", "-1", "0"), ("spin_us", "5000", "1_000"), ("lock_memory", "1", "true")],
)
def test_wrong_values_in_the_machine_file(machine: Path, key: str, value: str, allowed: str) -> None:
    machine.write_text(f"{MACHINE}[realtime]\n{key} = {value}\n", encoding="utf-8")
    done = call("check", machine)
    assert done.exit_code == ExitCode.FAILED
    assert f"realtime.{key}" in done.stderr
    assert allowed in done.stderr


def test_a_program_that_does_not_yield_in_real_time(machine: Path) -> None:
    machine.write_text(MACHINE + QUIET, encoding="utf-8")
    done = call("run", machine, *program("stuck"), "--realtime", "--patience", 0.2, "--trace", "run.trace")
    assert done.exit_code == ExitCode.STUCK
    assert "program stuck has not yielded for 0.2 s in tick " in done.stderr
    assert Trace.load("run.trace").complete


@pytest.mark.parametrize(
    ("name", "code", "said"),
    [
        ("terminating", ExitCode.TERMINATED, "terminated at 0.011 s of the run"),
        ("hanging_up", ExitCode.HUNG_UP, "the terminal was closed at 0.011 s of the run"),
    ],
)
def test_a_signal_ends_a_run_in_order(machine: Path, name: str, code: ExitCode, said: str) -> None:
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT)}
    done = call("run", machine, *program(name), "--trace", "run.trace")
    assert (done.exit_code, done.stderr) == (code, f"Error: {said}\n")
    trace = recorded(Path("run.trace"), 11)
    assert done.stdout.splitlines()[-1] == f"trace hash: {trace.hash}"
    assert {number: signal.getsignal(number) for number in before} == before


def test_a_hang_up_that_is_ignored_stays_ignored(machine: Path) -> None:
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        assert call("run", machine, *program("hanging_up")).exit_code == ExitCode.OK
    finally:
        signal.signal(signal.SIGHUP, before)


@pytest.mark.parametrize(
    ("number", "code"),
    [
        (signal.SIGINT, ExitCode.INTERRUPTED),
        pytest.param(signal.SIGTERM, ExitCode.TERMINATED, marks=pytest.mark.slow),
    ],
)
def test_a_signal_does_not_wait_for_the_next_tick(slow_machine: Path, number: signal.Signals, code: ExitCode) -> None:
    options = [str(slow_machine), *program("waiting"), "--realtime", "--speed", "0.01", "--trace", "run.trace"]
    process = subprocess.Popen(
        [sys.executable, "-m", "motionlayer", "run", *options],
        env={**os.environ, "PYTHONPATH": str(SOURCE)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "waiting\n"
    process.send_signal(number)
    try:
        _, errors = process.communicate(timeout=120.0)
    finally:
        process.kill()
    assert process.returncode == code, errors
    recorded(Path("run.trace"), 1)  # the next tick is ten seconds away


@pytest.mark.parametrize(
    ("brakes", "said"),
    [(0, "3 of 0 ticks; time never slipped"), (1, "; all axes braked once"), (2, "; all axes braked 2 times")],
)
def test_the_summary_says_how_often_the_axes_braked(brakes: int, said: str) -> None:
    found = Statistics(Histogram(), Histogram(), {}, overruns=3, slips=0, slipped=0.0, brakes=brakes)
    assert overruns(found).endswith(said)
