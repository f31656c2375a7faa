"""`motionlayer run` with message files; what ends a run comes in order."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from motionlayer.record import Trace
from tests.cli.support import SOURCE, call, program
from tests.record.log.support import files, small_disk, texts

CHATTY = """
from motionlayer.event import Device, Event, Kind, Level

async def main(run):
    while True:
        tick = run.tick
        for number in range(20):
            run.events.add(Event(tick, Level.INFO, Kind.MESSAGE, "", f"{tick} {number}", 0, 0, Device.Device_Main, 0))
        if tick == 50:
            print("under way", flush=True)
        await run.sleep(0.001)
"""


def written(folder: Path) -> list[str]:
    (lines,) = files(folder).values()
    return texts(lines)


def test_the_options_take_the_place_of_the_table(machine: Path, tmp_path: Path) -> None:
    machine.write_text(machine.read_text() + '[log]\nfolder = "a"\nlevel = "error"\n')
    assert call("run", machine, *program("main")).exit_code == ExitCode.OK
    assert written(tmp_path / "a") == []
    done = call("run", machine, *program("main"), "--log", "b", "--log-level", "verbose")
    assert done.exit_code == ExitCode.OK
    assert f"log         {tmp_path / 'b'}\n" in done.stdout
    assert "accepted: enable()" in written(tmp_path / "b")


def test_a_folder_without_a_table(machine: Path, tmp_path: Path) -> None:
    assert call("run", machine, *program("main"), "--log", "messages").exit_code == ExitCode.OK
    assert written(tmp_path / "messages") == [
        "program programs: accepted: started",
        "program programs: done: ended",
    ]


def test_a_level_and_nowhere_to_write_to(machine: Path) -> None:
    done = call("run", machine, *program("main"), "--log-level", "info")
    assert done.exit_code == ExitCode.USAGE
    assert "machine.toml has no table [log], so nothing is written: give --log DIR" in done.stderr


def test_a_folder_that_cannot_be_written(machine: Path) -> None:
    done = call("run", machine, *program("main"), "--log", f"{machine}/messages")
    assert done.exit_code == ExitCode.OUTPUT
    assert "cannot be made: Not a directory; name another one" in done.stderr


def test_an_unknown_level_is_refused_with_the_known_ones(machine: Path) -> None:
    done = call("run", machine, "--time", 1, "--log", "b", "--log-level", "loud")
    assert done.exit_code == ExitCode.USAGE
    assert "'error', 'warning', 'info', 'verbose', 'sentient'" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(("number", "code"), [(signal.SIGTERM, 143), (signal.SIGINT, 130)])
def test_a_signal_loses_nothing(machine: Path, tmp_path: Path, number: signal.Signals, code: int) -> None:
    Path("chatty.py").write_text(CHATTY)
    command = [sys.executable, "-m", "motionlayer", "run", str(machine), "--program", "chatty.py"]
    command += ["--log", "messages", "--trace", "run.trace"]
    environment = {**os.environ, "PYTHONPATH": str(SOURCE)}
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as run:
        assert run.stdout is not None
        assert run.stdout.readline() == "under way\n"
        run.send_signal(number)
        run.communicate(timeout=60)
    assert run.returncode == code
    said = [event.text for event in Trace.load("run.trace").events]
    lines = [line.rpartition(": ")[2] for line in written(tmp_path / "messages")]
    said = [text.rpartition(": ")[2] for text in said]
    lost = [text for text in said if text not in lines]
    assert lines == [text for text in said if text not in lost]
    assert len(lost) <= 1  # a program is interrupted wherever it is: it may be about to say this very message
    assert len(lines) > 20 * 50


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of 64 KiB."""
    with small_disk(tmp_path / "disk") as made:
        yield made


def test_a_full_disk_is_one_message_and_the_run_goes_on(machine: Path, disk: Path) -> None:
    Path("chatty.py").write_text(CHATTY)
    arguments = ["--program", "chatty.py", "--time", "0.5", "--log", disk, "--trace", "run.trace"]
    done = call("run", machine, *arguments)
    assert done.exit_code == ExitCode.OUTPUT
    trace = Trace.load("run.trace")
    assert trace.complete
    assert len(trace.ticks) == 500
    whole = written(disk)
    missing = len(trace.events) - len(whole)
    (error,) = [line for line in done.stderr.splitlines() if line.startswith("Error")]
    assert error == (
        f"Error: {missing} messages are missing in {disk} and are lost: No space left on device; free space"
    )
    told = [event for event in trace.events if event.source == "log"]
    assert [one.payload.decode() for one in trace.inputs if one.channel == "log"] == [event.text for event in told]
    assert len(told) <= 1  # it comes in with the next tick, if there is one
