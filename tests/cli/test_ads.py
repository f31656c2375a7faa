"""`motionlayer symbols`, `motionlayer watch` and `motionlayer run --ads`."""

import itertools
import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import click
import pytest

from motionlayer.cli import ExitCode
from motionlayer.cli._ads import address
from motionlayer.cli._watch import SHOWN
from motionlayer.connect.ads import Tree
from motionlayer.machine import Machine, Simulation
from tests.cli.support import MACHINE, SOURCE, call, program
from tests.connect.ads_clients import Paced
from tests.connect.broker import free_port

LAYER = "\n[layer]\n"
ADS = "\n[ads]\nport = 0\n"
QUIET = "[realtime]\npriority = 0\nlock_memory = false\n"


@pytest.fixture
def layered(machine: Path) -> Path:
    machine.write_text(MACHINE + LAYER, encoding="utf-8")
    return machine


@pytest.fixture
def served(machine: Path) -> Path:
    machine.write_text(MACHINE + QUIET + LAYER + ADS, encoding="utf-8")
    return machine


def tree(path: Path) -> Tree:
    with Simulation(Machine.load(path), ads=False) as run:
        run.step()
        return run.ads_tree


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("", (None, None)),
        ("10.0.0.1", ("10.0.0.1", None)),
        (":0", (None, 0)),
        ("48911", (None, 48_911)),
        ("localhost:48899", ("localhost", 48_899)),
        ("[::1]", ("::1", None)),
        ("[::1]:7", ("::1", 7)),
    ],
)
def test_addresses(text: str, found: tuple[str | None, int | None]) -> None:
    assert address(text) == found


@pytest.mark.parametrize("text", [":", ":x", "65536", "here:65536", "here:-1", "here:1.5"])
def test_what_is_no_address(text: str) -> None:
    with pytest.raises(click.BadParameter, match=r"the port must be 0 to 65535, as in 127\.0\.0\.1:48898"):
        address(text)


def test_symbols_are_listed_as_clients_see_them(layered: Path) -> None:
    done = call("symbols", layered)
    assert done.exit_code == ExitCode.OK, done.output
    lines = [line.split() for line in done.stdout.splitlines()]
    roots = tree(layered).roots
    assert [line[0] for line in lines] == [root.name for root in roots]
    rows = {line[0]: line[1:] for line in lines}
    assert rows["GVL_AXIS.Ctrl"] == ["ARRAY", "[1..1]", "OF", "ST_AXIS_CTRL", "4", "rw", "command"]
    assert rows["GVL_AXIS.State"][-3:] == ["6", "r", "state"]


def test_members_are_listed_where_asked_for(layered: Path) -> None:
    done = call("symbols", layered, "--all")
    assert done.exit_code == ExitCode.OK, done.output
    lines = [line.split() for line in done.stdout.splitlines()]
    rows = {line[0]: line[1:] for line in lines}
    assert rows["GVL_AXIS.Data[1].rSetVelo"] == ["LREAL", "8", "rw", "velocity", "(u/s)"]
    assert rows["GVL_AXIS.State[1].eState"][:3] == ["E_AXIS_STATE", "2", "r"]
    found = tree(layered)
    for name, row in rows.items():
        if "#" in name:
            continue
        place = found.find(name)
        size, access = next((int(one), two) for one, two in itertools.pairwise(row) if two in ("r", "rw"))
        assert (place.type.size, place.root.writable) == (size, access == "rw"), name


def test_methods_are_listed_with_the_bytes_of_a_call(layered: Path) -> None:
    assert "#" not in call("symbols", layered).stdout
    lines = call("symbols", layered, "--all").stdout.splitlines()
    rows = {line.split()[0]: line.split()[1:] for line in lines if "#" in line.split()[0]}
    kind = tree(layered).type_named("FB_MOTION_AXIS")
    assert list(rows) == [f"GVL_MOTION.Axis[1]#{method.name}" for method in kind.methods]
    halt = rows["GVL_MOTION.Axis[1]#Halt"]
    assert halt[:3] == ["UDINT", "18", "x"]
    assert " ".join(halt).endswith(
        "(Deceleration : LREAL, Jerk : LREAL, BufferMode : MC_BufferMode) => Command : UDINT"
    )


def test_symbols_of_a_machine_without_a_motion_layer(machine: Path) -> None:
    done = call("symbols", machine)
    assert done.exit_code == ExitCode.OK, done.output
    assert "GVL_AXIS" not in done.stdout


def test_a_listing_neither_runs_a_server_nor_writes_messages(machine: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        machine.write_text(MACHINE + LAYER + f"[ads]\nport = {port}\n[log]\nfolder = 'm'\n", encoding="utf-8")
        assert call("symbols", machine).exit_code == ExitCode.OK
    assert not Path("m").exists()


def test_a_run_says_where_clients_reach_it(served: Path) -> None:
    done = call("run", served, *program("main"))
    assert done.exit_code == ExitCode.OK, done.output
    assert re.search(r"^ads +127\.0\.0\.1:\d+, NetId 127\.0\.0\.1\.1\.1, port 851$", done.stdout, re.MULTILINE)


def test_the_option_goes_before_the_machine_file(machine: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        machine.write_text(MACHINE + LAYER + f"[ads]\nport = {port}\nnet_id = '5.1.2.3.1.1'\n", encoding="utf-8")
        done = call("run", machine, *program("main"), "--ads", ":0")
    assert done.exit_code == ExitCode.OK, done.output
    (line,) = [line for line in done.stdout.splitlines() if line.startswith("ads")]
    assert "NetId 5.1.2.3.1.1" in line
    assert f":{port}," not in line


def test_an_address_that_is_taken_ends_the_run_before_it_begins(served: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        done = call("run", served, *program("main"), "--ads", f":{port}", "--trace", "run.trace")
    assert done.exit_code == ExitCode.OUTPUT
    assert done.stderr.count("Error: ") == 1
    assert f"127.0.0.1:{port}: Address already in use" in done.stderr


def test_a_port_that_is_none(served: Path) -> None:
    done = call("run", served, *program("main"), "--ads", "here:99999")
    assert done.exit_code == ExitCode.USAGE
    assert "'here:99999': the port must be 0 to 65535" in done.stderr


def test_a_simulation_that_clients_alone_command_needs_a_time(served: Path) -> None:
    done = call("run", served)
    assert done.exit_code == ExitCode.USAGE
    assert "give --program FILE[:NAME], or --time S, or --realtime, where ADS clients command it" in done.stderr


@contextmanager
def running(path: Path) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Run a machine in real time until it is interrupted; yield the process and `HOST:PORT`."""
    line = [sys.executable, "-m", "motionlayer", "run", str(path), "--realtime"]
    environment = {**os.environ, "PYTHONPATH": str(SOURCE)}
    # A shell that starts tests in the background lets them ignore Ctrl-C, and their children with them.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        process = subprocess.Popen(
            line, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, bufsize=1
        )
    finally:
        signal.signal(signal.SIGINT, before)
    with process:
        try:
            assert process.stdout is not None
            found = re.search(r"\S+:\d+", process.stdout.readline())
            assert found is not None
            yield process, found[0]
        finally:
            process.kill()


@pytest.mark.slow
def test_values_of_a_run_are_watched_until_it_is_interrupted(served: Path) -> None:
    with running(served) as (process, where):
        done = call("watch", "GVL_AXIS.State[1]", "main_axis.einit", "--ads", where, "--cycle", 0.01, "--time", 2.0)
        assert done.exit_code == ExitCode.OK, done.output
        lines = [re.fullmatch(r"\d\d:\d\d:\d\d\.\d{3} (\S+) = (.*)", line) for line in done.stdout.splitlines()]
        values = {line[1].lower(): line[2] for line in lines if line is not None}
        assert len(values) == 3
        assert values["gvl_axis.state[1].eaxisencoder"] == "Simulation_Encoder"
        assert re.fullmatch(r"\d+ AXIS_\w+ \+ PROGRESS_\w+", values["gvl_axis.state[1].estate"])
        assert values["main_axis.einit"] == "PROGRESS_DONE"

        wrong = call("watch", "GVL_AXIS.Nothing", "--ads", where)
        assert wrong.exit_code == ExitCode.FAILED
        assert wrong.stderr.startswith("Error: GVL_AXIS.Nothing: symbol not found (0x710); did you mean GVL_AXIS.")

        many = call("watch", "GVL_MSG_AXIS.MotionMessages", "--ads", where)
        assert many.exit_code == ExitCode.USAGE
        assert f"more than {SHOWN} values are not shown; name members" in many.stderr

        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=120)
        assert process.returncode == ExitCode.INTERRUPTED, errors


def test_nobody_is_there_to_be_watched() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    done = call("watch", "GVL_AXIS.State[1]", "--ads", f":{port}")
    assert done.exit_code == ExitCode.FAILED
    assert done.stderr == f"Error: 127.0.0.1:{port}: Connection refused; is a run with --ads there?\n"


@pytest.mark.parametrize("options", [["--ads", "x:y"], ["--cycle", "-1"], ["--time", "nan"], []])
def test_wrong_use_of_watch(options: list[str]) -> None:
    names = ["GVL.X"] if options else []
    assert call("watch", *names, *options).exit_code == ExitCode.USAGE


@pytest.mark.slow
def test_a_device_that_goes_is_waited_for(served: Path) -> None:
    port = free_port()
    served.write_text(served.read_text(encoding="utf-8").replace("port = 0", f"port = {port}"), encoding="utf-8")
    name = "GVL_AXIS.Data[1].rOverride"
    line = [sys.executable, "-m", "motionlayer", "watch", name, "--ads", f":{port}", "--cycle", "0.01"]
    with ExitStack() as stack:
        run = stack.enter_context(Simulation(Machine.load(served)))
        paced = stack.enter_context(ExitStack())
        paced.enter_context(Paced(run))
        environment = {**os.environ, "PYTHONPATH": str(SOURCE)}
        watching = stack.enter_context(
            subprocess.Popen(line, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        )
        stack.callback(watching.kill)
        assert watching.stdout is not None
        assert f"{name} = " in watching.stdout.readline()
        paced.close()
        run.close()
        assert "waiting for the device to come back" in watching.stdout.readline()
        with Simulation(Machine.load(served)) as again, Paced(again):
            assert watching.stdout.readline() == "the device is there again\n"
            assert f"{name} = " in watching.stdout.readline()
