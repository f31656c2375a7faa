"""`motionlayer replay`: runs, most of them of real processes, each run again from its trace alone."""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from motionlayer.event import Level
from motionlayer.record import Trace
from motionlayer.verify import assert_valid
from tests.cli.support import MACHINE, SOURCE, call, command

PROGRAMS = Path(__file__).with_name("replayed.py")
QUIET = "[realtime]\npriority = 0\nlock_memory = false\n"
SERVO = """\
[axis.X.drive]
kind = "servo"
position_gain = 80.0
time_constant = 0.002
noise = 0.001
[[fault]]
axis = "X"
kind = "drive_error"
time = 0.3
"""


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine, real-time conditions left alone, and the programs, in the working directory."""
    monkeypatch.chdir(tmp_path)
    Path("machine.toml").write_text(MACHINE + QUIET, encoding="utf-8")
    shutil.copy(PROGRAMS, "programs.py")


def recorded(*options: object, code: ExitCode = ExitCode.OK) -> Trace:
    """Record a run in a process of its own."""
    done = command("run", "machine.toml", *options, "--trace", "run.trace")
    assert done.returncode == code, done.stderr
    return Trace.load("run.trace")


def simulated(*options: object, code: ExitCode = ExitCode.OK) -> Trace:
    """Record a run in this process."""
    done = call("run", "machine.toml", *options, "--trace", "run.trace")
    assert done.exit_code == code, done.output
    return Trace.load("run.trace")


def same(compared: str = "the hash, ") -> None:
    """Replay in this process; it must be the same run."""
    done = call("replay", "run.trace")
    assert (done.exit_code, done.stderr) == (ExitCode.OK, "")
    assert f"compared    {compared}" in done.stdout
    assert done.stdout.endswith("same        yes\n")


def written() -> bool:
    """Tell whether a block of the trace is in its file."""
    file = Path("run.trace")
    return file.exists() and file.stat().st_size > 0 and len(Trace.load(file).ticks) > 0


def signalled(number: signal.Signals, *options: object, after: float) -> int:
    """Send a signal to a run some time after its first block was written; return its exit code."""
    process = subprocess.Popen(
        [sys.executable, "-m", "motionlayer", "run", "machine.toml", *map(str, options), "--trace", "run.trace"],
        env={**os.environ, "PYTHONPATH": str(SOURCE)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        deadline = time.monotonic() + 60.0
        while not written():
            assert time.monotonic() < deadline, "no block was written"
            assert process.poll() is None, "the run has ended"
        time.sleep(after)
        process.send_signal(number)
        return process.wait(timeout=120.0)
    finally:
        process.kill()
        process.wait()


def test_a_simulation() -> None:
    trace = recorded("--program", "programs.py:shuttle", "--time", 1.2)
    assert trace.end is not None
    assert (trace.end.tick, trace.end.cause) == (1200, "time over")
    done = command("replay", "run.trace", PYTHONHASHSEED="5")
    assert (done.returncode, done.stderr) == (ExitCode.OK, "")
    assert done.stdout.splitlines()[1:] == [f"compared    the hash, {trace.hash}", "same        yes"]


def test_faults_noise_and_another_seed() -> None:
    Path("machine.toml").write_text(MACHINE + SERVO + QUIET, encoding="utf-8")
    trace = simulated("--program", "programs.py:shuttle", "--time", 0.6, "--seed", 77, code=ExitCode.FAILED)
    assert trace.header["seed"] == 77
    assert [event for event in trace.events if event.level is Level.ERROR]
    same()


def test_programs_of_the_machine_file_with_tasks() -> None:
    entries = '[task.rare]\nevery = 5\n[program.p]\nfile = "programs.py"\nfunction = "told"\ntask = "rare"\n'
    Path("machine.toml").write_text(MACHINE + QUIET + entries, encoding="utf-8")
    assert simulated("--realtime", "--time", 0.4).inputs
    same()


@pytest.mark.slow
def test_late_ticks_in_real_time_are_late_again() -> None:
    trace = recorded("--program", "programs.py:slow", "--realtime")
    assert [event for event in trace.events if "all axes brake" in event.text]
    assert "late" in {one.channel for one in trace.inputs}
    assert_valid(trace)
    same()


@pytest.mark.slow
def test_what_threads_have_posted_comes_from_the_trace() -> None:
    trace = recorded("--program", "programs.py:told", "--realtime", "--time", 1.0)
    assert len([one for one in trace.inputs if one.channel == "area.wish"]) > 50
    assert_valid(trace)
    same()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("number", "code", "cause"),
    [
        pytest.param(signal.SIGINT, ExitCode.INTERRUPTED, "interrupted", marks=pytest.mark.slow),
        (signal.SIGTERM, ExitCode.TERMINATED, "terminated"),
        pytest.param(signal.SIGHUP, ExitCode.HUNG_UP, "the terminal was closed", marks=pytest.mark.slow),
    ],
)
def test_a_signal_at_any_time(number: signal.Signals, code: ExitCode, cause: str) -> None:
    """In simulation, where most of them come in a program or in a step of the runtime."""
    assert signalled(number, "--program", "programs.py:shuttle", after=0.05) == code
    trace = Trace.load("run.trace")
    assert trace.end == (len(trace.ticks), cause, False)
    assert [event.text for event in trace.events if event.tick == trace.end.tick][-1] == "cancelled"
    same()


def test_a_program_that_never_yields_is_compared_up_to_that_tick() -> None:
    trace = simulated("--program", "programs.py:stuck", "--patience", 0.3, code=ExitCode.STUCK)
    assert trace.end is not None
    assert trace.end.inside
    same(f"up to tick {trace.end.tick}, inside of which the run ended (a program did not yield)")


def test_one_signal_ends_a_program_that_never_yields() -> None:
    Path("machine.toml").write_text(MACHINE + QUIET, encoding="utf-8")
    Path("programs.py").write_text(
        "import os, signal\n"
        "async def main(run):\n"
        "    await run.sleep(0.02)\n"
        "    os.kill(os.getpid(), signal.SIGTERM)\n"
        "    while True:\n"
        "        pass\n",
        encoding="utf-8",
    )
    trace = simulated("--program", "programs.py", code=ExitCode.TERMINATED)
    assert trace.end == (20, "terminated", True)


@pytest.mark.slow
def test_a_run_that_was_killed_is_compared_up_to_its_last_block() -> None:
    assert signalled(signal.SIGKILL, "--program", "programs.py:shuttle", after=0.1) == -signal.SIGKILL
    trace = Trace.load("run.trace")
    assert (trace.complete, trace.end, trace.damage) == (False, None, "")
    same(f"all that it holds: it broke off after tick {trace.ticks[-1]}")


@pytest.mark.parametrize("share", [0.4, 0.9])
def test_a_truncated_trace(share: float) -> None:
    simulated("--program", "programs.py:shuttle", "--time", 6)
    data = Path("run.trace").read_bytes()
    Path("run.trace").write_bytes(data[: int(share * len(data))])
    same("all that it holds: it broke off after tick ")


def test_a_changed_program_is_named_and_differs() -> None:
    simulated("--program", "programs.py:shuttle", "--time", 1.2)
    text = Path("programs.py").read_text(encoding="utf-8")
    Path("programs.py").write_text(text.replace("200.0", "201.0"), encoding="utf-8")
    done = call("replay", "run.trace")
    assert done.exit_code == ExitCode.FAILED
    assert "programs.py is not the file that was recorded (SHA-256 " in done.stderr
    assert "run.trace: the replay is another run: tick 2 (0.002 s): the trace has " in done.stderr
    assert "move_absolute(position=200.0)' (accepted), the replay the verbose X: 'move_absolute(" in done.stderr
    assert re.search(r"; hash [0-9a-f]{32} in the trace, [0-9a-f]{32} in the replay\n$", done.stderr)
    Path("programs.py").write_text(text.replace("axis.move_absolute(200.0)", "run.sleep(1.0)"), encoding="utf-8")
    done = call("replay", "run.trace")
    assert done.exit_code == ExitCode.FAILED
    assert "a script may have" not in done.stderr  # the file explains it
    Path("programs.py").write_text(text + "\n# the same but for this line\n", encoding="utf-8")
    done = call("replay", "run.trace")
    assert done.exit_code == ExitCode.OK
    assert "the hash may differ" in done.stderr


def test_the_program_is_looked_for_beside_the_trace_and_can_be_given() -> None:
    simulated("--program", "programs.py:shuttle", "--time", 0.3)
    Path("moved").mkdir()
    for name in ("run.trace", "programs.py"):
        Path(name).rename(Path("moved", name))
    assert call("replay", "moved/run.trace").exit_code == ExitCode.OK
    Path("moved", "programs.py").rename("renamed.py")
    done = call("replay", "moved/run.trace")
    assert done.exit_code == ExitCode.OUTPUT
    assert "program shuttle: no file " in done.stderr
    assert "give it with --program FILE" in done.stderr
    done = call("replay", "moved/run.trace", "--program", "renamed.py:shuttle")
    assert "compared    the hash" in done.stdout


def test_an_unchanged_file_beside_the_trace_comes_before_a_changed_one() -> None:
    simulated("--program", "programs.py:shuttle", "--time", 0.3)
    Path("kept").mkdir()
    Path("run.trace").rename("kept/run.trace")
    shutil.copy("programs.py", "kept/programs.py")
    Path("programs.py").write_text("async def shuttle(run):\n    pass\n", encoding="utf-8")
    done = call("replay", "kept/run.trace")
    assert (done.exit_code, done.stderr) == (ExitCode.OK, "")


def test_the_machine_is_that_of_the_trace() -> None:
    simulated("--program", "programs.py:shuttle", "--time", 0.3)
    Path("machine.toml").write_text(MACHINE.replace("1000.0", "10.0"), encoding="utf-8")
    assert call("replay", "run.trace").exit_code == ExitCode.OK
    done = call("replay", "run.trace", "machine.toml")
    assert done.exit_code == ExitCode.USAGE


def test_files_that_are_no_trace() -> None:
    for text, said in (("none.trace", "cannot be read"), ("machine.toml", "not a trace of motionlayer")):
        done = call("replay", text)
        assert done.exit_code == ExitCode.OUTPUT
        assert said in done.stderr


def test_a_damaged_trace_is_compared_up_to_the_damage() -> None:
    simulated("--program", "programs.py:shuttle", "--time", 6)
    data = bytearray(Path("run.trace").read_bytes())
    data[-2000] ^= 1
    Path("run.trace").write_bytes(data)
    done = call("replay", "run.trace")
    assert done.exit_code == ExitCode.OK
    assert "Warning: run.trace is damaged: chunk " in done.stderr
    assert "all that it holds" in done.stdout


def test_another_program_for_one_that_does_not_exist() -> None:
    entries = "".join(f'[program.{name}]\nfile = "{name}.py"\n' for name in ("a", "b"))
    Path("machine.toml").write_text(MACHINE + entries, encoding="utf-8")
    for name in ("a", "b"):
        Path(f"{name}.py").write_text("async def main(run):\n    await run.sleep(0.01)\n", encoding="utf-8")
    simulated()
    done = call("replay", "run.trace", "--program", "programs.py")
    assert done.exit_code == ExitCode.OUTPUT
    assert "programs.py stands in for no program of the trace; it has a (a.py), b (b.py)" in done.stderr
    assert call("replay", "run.trace", "--program", "b.py").exit_code == ExitCode.OK
