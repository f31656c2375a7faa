"""What is not the fault of a program: our own, and that of files."""

import os
import subprocess
import sys
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from motionlayer import Machine, Simulation
from motionlayer.cli import ExitCode
from motionlayer.cli._main import _Group
from motionlayer.record import Trace
from tests.cli.support import MACHINE, SOURCE, call, program, python, recorded
from tests.effort import thinned

CHATTY = """\
async def main(run):
    while True:
        print("line", run.tick, "x" * 200)
        await run.sleep(0.001)
"""


def test_a_fault_in_a_step_has_its_own_code(machine: Path) -> None:
    done = call("run", machine, *program("breaking_the_cycle"), "--trace", "run.trace")
    assert done.exit_code == ExitCode.FAULT
    assert done.stderr.startswith("Error: a fault of motionlayer itself in tick 1: broken listener; ")
    assert "RuntimeError: broken listener" in done.stderr
    trace = recorded(Path("run.trace"), 1)
    assert done.stdout.splitlines()[-1] == f"trace hash: {trace.hash}"


def test_what_no_command_expects_has_the_same_code() -> None:
    @click.command()
    def broken() -> None:
        raise LookupError("nobody expects this")

    done = CliRunner().invoke(_Group(commands=[broken]), ["broken"])
    assert done.exit_code == ExitCode.FAULT
    assert done.stderr.startswith("Error: a fault of motionlayer itself; please report it with these lines:\nTraceback")
    assert done.stderr.endswith("LookupError: nobody expects this\n")


@pytest.mark.parametrize("option", ["--trace", "--plot"])
def test_no_folder_to_write_to(machine: Path, option: str) -> None:
    done = call("run", machine, "--time", 1, option, "no/folder.html")
    assert done.exit_code == ExitCode.OUTPUT
    assert done.stderr == "Error: no/folder.html cannot be written: there is no folder no\n"


def test_a_folder_instead_of_a_file(machine: Path) -> None:
    Path("run.trace").mkdir()
    done = call("run", machine, "--time", 1, "--trace", "run.trace")
    assert done.exit_code == ExitCode.OUTPUT
    assert done.stderr == "Error: run.trace cannot be written: it is a folder\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
def test_a_full_disk(machine: Path) -> None:
    done = call("run", machine, "--time", 1, "--trace", "/dev/full")
    assert done.exit_code == ExitCode.OUTPUT
    assert "/dev/full: the trace cannot be written: No space left on device" in done.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize("name", ["check", "error", pytest.param("schema", marks=pytest.mark.slow)])
def test_results_on_a_full_disk(machine: Path, name: str) -> None:
    arguments = {"check": [str(machine)], "error": ["0x4260"], "schema": []}[name]
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        done = subprocess.run(
            [sys.executable, "-m", "motionlayer", name, *arguments],
            env={**os.environ, "PYTHONPATH": str(SOURCE)},
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
            timeout=120,
        )
    assert done.stderr == "Error: stdout cannot be written: No space left on device; redirect it elsewhere\n"
    assert done.returncode == ExitCode.OUTPUT


def test_a_trace_that_another_run_writes_stays_as_it_is(machine: Path) -> None:
    with Simulation(Machine.load(machine), trace="run.trace") as run:
        run.step(3)
        done = call("run", machine, "--time", 1, "--trace", "run.trace")
        assert done.exit_code == ExitCode.OUTPUT
        assert done.stderr == (
            "Error: run.trace: another run still writes this trace; wait for its end or close() it, "
            "or name another file with --trace\n"
        )
        run.step(2)
    recorded(Path("run.trace"), 5)
    assert call("run", machine, "--time", 1, "--trace", "run.trace").exit_code == ExitCode.OK


def test_a_disk_that_is_full_in_the_middle(machine: Path) -> None:
    limited = (
        "import resource, sys\nresource.setrlimit(resource.RLIMIT_FSIZE, (150_000, 150_000))\n"
        "from motionlayer.cli import main\nmain()"
    )
    options = (*program("shuttle"), "--time", "6", "--trace", "run.trace")
    plain = {"MOTIONLAYER_KERNELS": "plain", "PYTHONDONTWRITEBYTECODE": "1"}  # nothing else is written
    done = python("-c", limited, "run", str(machine), *options, **plain)
    assert done.returncode == ExitCode.OUTPUT, done
    (error,) = done.stderr.splitlines()
    assert error.startswith("Error: run.trace: the trace cannot be written: ")
    assert "hash" not in done.stdout
    trace = Trace.load("run.trace")
    assert not trace.complete
    assert trace.ticks.tolist() == list(range(len(trace.ticks)))
    assert len(trace.ticks)


@pytest.mark.parametrize("command", ["verify", "plot"])
def test_what_is_no_trace(machine: Path, command: str) -> None:
    for file, said in [
        ("gone.trace", "No such file"),
        (machine, "not a trace of motionlayer"),
        (".", "Is a directory"),
    ]:
        done = call(command, file, *(["-o", "page.html"] if command == "plot" else []))
        assert done.exit_code == ExitCode.OUTPUT
        assert done.stdout == ""
        assert done.stderr.startswith("Error: ")
        assert said in done.stderr


def test_a_trace_that_is_not_valid(machine: Path) -> None:
    call("run", machine, *program("main"), "--trace", "run.trace")
    trace = Trace.load("run.trace")
    positions = trace["X.set_position"].copy()
    positions[100] += 1.0
    trace.replace({"X.set_position": positions}).save("wrong.trace")
    done = call("verify", "wrong.trace")
    assert (done.exit_code, done.stdout.split(":")[0]) == (ExitCode.FAILED, "NOT VALID")


def test_a_trace_that_cannot_be_judged(machine: Path) -> None:
    machine.write_text(MACHINE + '[trace]\nsignals = ["X.state"]\n', encoding="utf-8")
    call("run", machine, "--time", 0.1, "--trace", "run.trace")
    done = call("verify", "run.trace")
    assert (done.exit_code, done.stdout.split(":")[0]) == (ExitCode.OUTPUT, "REFUSED")


def _halves(path: str) -> tuple[bytes, bytes]:
    data = Path(path).read_bytes()
    return data[: len(data) // 2], data[len(data) // 2 :]


def test_an_incomplete_trace_is_judged_but_not_passed_over(machine: Path) -> None:
    call("run", machine, *program("shuttle"), "--time", 5, "--trace", "run.trace")
    Path("cut.trace").write_bytes(_halves("run.trace")[0])
    done = call("verify", "cut.trace")
    assert (done.exit_code, done.stdout.split(":")[0]) == (ExitCode.OUTPUT, "INCOMPLETE")
    assert "its writer was cut short; judged up to tick" in done.stdout
    assert done.stderr == "Error: cut.trace is incomplete; --partial accepts the part that was judged\n"
    done = call("verify", "cut.trace", "--partial")
    assert (done.exit_code, done.stdout.split(":")[0], done.stderr) == (ExitCode.OK, "INCOMPLETE", "")
    done = call("plot", "cut.trace")
    assert done.exit_code == ExitCode.OK
    assert done.stderr == ("Warning: cut.trace is incomplete, its writer was cut short; the page shows what was read\n")


@pytest.mark.parametrize("option", thinned([[], ["--partial"]], 2))
@pytest.mark.parametrize("kind", ["flipped", "zeroed", "followed"])
def test_a_damaged_trace_is_refused(machine: Path, kind: str, option: list[str]) -> None:
    call("run", machine, *program("shuttle"), "--time", 5, "--trace", "run.trace")
    first, second = _halves("run.trace")
    damaged = {
        "flipped": first + bytes([second[0] ^ 1]) + second[1:],
        "zeroed": first + bytes(1000) + second[1000:],
        "followed": first + second + b"junk",
    }
    Path("damaged.trace").write_bytes(damaged[kind])
    done = call("verify", "damaged.trace", *option)
    assert (done.exit_code, done.stdout.split(":")[0]) == (ExitCode.OUTPUT, "REFUSED")
    assert "cannot judge: the file is damaged: " in done.stdout
    done = call("plot", "damaged.trace")
    assert done.exit_code == ExitCode.OK
    assert done.stderr.startswith("Warning: damaged.trace is damaged: ")


def test_a_page_never_replaces_its_trace(machine: Path) -> None:
    call("run", machine, "--time", 0.1, "--trace", "run.html")
    done = call("plot", "run.html")
    assert done.exit_code == ExitCode.USAGE
    assert "run.html would be overwritten" in done.stderr
    recorded(Path("run.html"), 100)


def test_a_run_of_which_there_is_nothing_to_draw(machine: Path) -> None:
    done = call("run", machine, *program("interrupting_at_once"), "--plot", "run.html")
    assert done.exit_code == ExitCode.INTERRUPTED
    assert "holds no rows of an axis" in done.stderr
    assert not os.path.lexists("run.html")


def test_bench_hands_over_its_exit_code() -> None:
    assert call("bench", "no_such_group").exit_code == ExitCode.USAGE


@pytest.mark.parametrize("buffering", ["", pytest.param("1", marks=pytest.mark.slow)])
def test_a_reader_of_stdout_that_goes_away(machine: Path, buffering: str) -> None:
    """As `motionlayer run … | head -1` does; with a buffer the pipe breaks some lines later."""
    Path("chatty.py").write_text(CHATTY, encoding="utf-8")
    with subprocess.Popen(
        [sys.executable, "-m", "motionlayer", "run", str(machine), "--program", "chatty.py", "--time", "5"],
        env={**os.environ, "PYTHONPATH": str(SOURCE), "PYTHONUNBUFFERED": buffering},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        assert process.stdout.readline().startswith("line 0")
        process.stdout.close()
        said = process.stderr.read()
        assert process.wait(120.0) == ExitCode.FAILED
    assert said == (
        "Error: program chatty: nobody reads what it writes any more, as behind `| head` "
        f"({Path('chatty.py').resolve()}:3 in main)\n"
    )
