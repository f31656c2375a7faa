"""`motionlayer soak`: that it counts and reports; nothing here judges a time or a size of memory."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from motionlayer.cli import ExitCode
from motionlayer.cli import _memory as memory
from tests.cli.support import MACHINE, SOURCE, call, program, python

QUIET = "[realtime]\npriority = 0\nlock_memory = false\n"


def soak(*options: object, code: ExitCode = ExitCode.OK) -> tuple[list[str], dict[str, Any]]:
    """Return the lines of the report, and the report as data."""
    done = call("soak", "machine.toml", *options, "--report", "report.json")
    assert done.exit_code == code, done.output
    return done.stdout.splitlines(), json.loads(Path("report.json").read_text(encoding="utf-8"))


@pytest.mark.usefixtures("machine")
def test_programs_that_end_are_started_again() -> None:
    lines, report = soak("--cycles", 3000, *program("noisy"))
    assert (report["cycles"], report["wanted"], report["problem"]) == (3000, 3000, "")
    ends = {one["end"]: one["times"] for one in report["programs"]}
    assert ends["ended"] > 200  # it takes eleven ticks
    assert report["messages"]["warning"] >= 7 * ends["ended"]
    assert report["memory"]["first"] >= 300
    assert report["memory"]["last"] == 3000
    assert "simulated   3 s, 3000 of 3000 cycles of 1 ms" in lines
    assert [line for line in lines if line.startswith("memory")]
    assert not [line for line in lines if "soak" in line]


def test_cyclic_programs_go_on(machine: Path) -> None:
    entries = '[task.rare]\nevery = 10\n[program.p]\nfile = "p.py"\ntask = "rare"\n'
    machine.write_text(MACHINE + entries, encoding="utf-8")
    Path("p.py").write_text("def main(run, memory):\n    assert run.tick % 10 == memory.__dict__.setdefault('at', 0)\n")
    lines, report = soak("--cycles", 2000, "--warm-up", 0)
    assert report["cycles"] == 2000
    assert [line for line in lines if line.startswith("tasks       rare: min ")]
    assert report["programs"] == [{"name": "p", "end": "cancelled", "times": 1}]


@pytest.mark.usefixtures("machine")
def test_a_machine_without_programs() -> None:
    assert soak("--cycles", 1000)[1]["cycles"] == 1000


def test_a_program_that_fails_ends_it_with_the_report_so_far(machine: Path) -> None:
    done = call("soak", machine, "--cycles", 100_000, *program("raising"))
    assert done.exit_code == ExitCode.FAILED
    assert "program raising: ValueError: boom" in done.stderr
    assert "the run ended before its warm-up" in done.stdout


def test_in_real_time_it_reports_drift_and_lateness(machine: Path) -> None:
    machine.write_text(MACHINE + QUIET, encoding="utf-8")
    Path("p.py").write_text("async def main(run):\n    await run.sleep(2.0)\n", encoding="utf-8")  # nothing to brake
    lines, report = soak("--cycles", 300, "--realtime", "--speed", 5, "--program", "p.py")
    assert report["lateness"]["max"] > report["lateness"]["min"] >= 0
    assert report["cycles"] == 300
    assert report["drift"] > -0.01  # not before the clock; how far behind it depends on the computer
    assert [line for line in lines if line.startswith("drift")]
    assert [line for line in lines if line.startswith("overruns")]


@pytest.mark.slow
def test_an_interrupt_gives_the_report_so_far(machine: Path) -> None:
    options = [str(machine), "--cycles", "1000000000", "--warm-up", "1000", "--report", "report.json"]
    Path("p.py").write_text("async def main(run):\n    print('going', flush=True)\n    await run.sleep(2.0)\n")
    process = subprocess.Popen(
        [sys.executable, "-m", "motionlayer", "soak", *options, "--program", "p.py"],
        env={**os.environ, "PYTHONPATH": str(SOURCE)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    for _ in range(3):
        assert process.stdout.readline() == "going\n"
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=120.0)
    assert process.returncode == ExitCode.INTERRUPTED
    report = json.loads(Path("report.json").read_text(encoding="utf-8"))
    assert errors == f"Error: interrupted after {report['cycles']} cycles\n"
    assert report["memory"]["last"] == report["cycles"] > 4000


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ([], "Missing option '--cycles'"),
        (["--cycles", "0"], "'--cycles': 0 is not in the range"),
        (["--cycles", "10", "--warm-up", "10"], "a warm-up of 10 cycles leaves none of 10: give more --cycles"),
        (["--cycles", "10", "--speed", "2"], "--speed is that of a clock: give --realtime as well"),
        (["--cycles", "10", "--report", "machine.toml"], "a report is written as .json"),
    ],
)
def test_wrong_options(machine: Path, options: list[str], said: str) -> None:
    done = call("soak", machine, *options)
    assert done.exit_code == ExitCode.USAGE
    assert said in done.stderr
    assert machine.read_text(encoding="utf-8") == MACHINE


def test_memory_counts_from_the_end_of_the_warm_up(monkeypatch: pytest.MonkeyPatch) -> None:
    held = iter([500, 900, 700])
    monkeypatch.setattr(memory, "resident", lambda: next(held))
    watch = memory.MemoryWatch(1000, 3000, collect=True)
    for tick in (0, 256, 999, 1024, 1025, 1026, 1027, 1028):
        watch(tick)
    growth = watch.growth(3000)
    assert growth == memory.Growth(1024, 3000, 500, 700, 900)
    assert growth.per_million == pytest.approx(200 / 1976e-6)


def test_memory_grows_by_what_is_kept() -> None:
    fresh = (  # in a process that has nothing to give back
        "import os\nfrom motionlayer.cli import _memory as memory\n"
        "before = memory.resident()\nkept = bytearray(os.urandom(1 << 24))\nprint(memory.resident() - before)"
    )
    assert int(python("-c", fresh).stdout) > 0.9 * (1 << 24)
