from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from motionlayer.event import Level
from tests.cli.support import PROGRAMS, call, command, line_of, program, recorded


def ticks(stdout: str) -> int:
    (line,) = [line for line in stdout.splitlines() if line.startswith("simulated")]
    return int(line.split()[4])


@pytest.mark.parametrize(
    ("name", "said", "line"),
    [
        ("raising", "ValueError: boom", 'ValueError("boom")'),
        ("misspelling", "no attribute 'move_absolut'; did you mean move_absolute?", "move_absolut("),
        ("raising_in_library", "JSONDecodeError: Expecting value", 'json.loads("nonsense")'),
        ("foreign", "await run.sleep(seconds)", "await asyncio.sleep(1)"),
        ("refused", "the axis is not enabled", "move_absolute(10.0)"),
        ("in_error", "the axis cannot start this in its state", "await axis.move_absolute(0.0)  # in error"),
        ("exiting", "sys.exit(7) was called; return instead", "sys.exit(7)"),
    ],
)
def test_a_program_that_fails(machine: Path, name: str, said: str, line: str) -> None:
    done = call("run", machine, *program(name), "--trace", "run.trace")
    assert done.exit_code == ExitCode.FAILED, done.output
    (error,) = done.stderr.splitlines()
    assert error.startswith(f"Error: program {name}: ")
    assert said in error
    assert error.endswith(f"({PROGRAMS}:{line_of(line)} in {name})")
    trace = recorded(Path("run.trace"), ticks(done.stdout))
    assert done.stdout.splitlines()[-1] == f"trace hash: {trace.hash}"
    assert f"programs    {name} failed" in done.stdout
    last = [event for event in trace.events if event.source == f"program {name}"][-1]
    assert last.level is Level.ERROR
    assert call("verify", "run.trace").exit_code == ExitCode.OK, call("verify", "run.trace").stdout


def test_a_command_of_the_layer_that_fails(machine: Path) -> None:
    machine.write_text(machine.read_text(encoding="utf-8") + "[layer]\n", encoding="utf-8")
    done = call("run", machine, *program("by_layer"))
    assert done.exit_code == ExitCode.FAILED, done.output
    (error,) = done.stderr.splitlines()
    assert error.startswith("Error: program by_layer: X: MOVE_POS: the state is 9012, PROGRESS_ERROR; error 0x4222")
    assert error.endswith(f"({PROGRAMS}:{line_of('done(AxisCommand.MOVE_POS)')} in by_layer)")


def test_the_page_of_a_failed_run_is_drawn(machine: Path) -> None:
    done = call("run", machine, *program("raising"), "--plot", "run.html")
    assert done.exit_code == ExitCode.FAILED
    assert done.stdout.splitlines()[-1] == "plot        run.html"
    assert "X" in Path("run.html").read_text(encoding="utf-8")


def test_of_many_failures_the_first_are_named(machine: Path) -> None:
    done = call("run", machine, *program("workers_failing"))
    assert done.exit_code == ExitCode.FAILED
    errors = done.stderr.splitlines()
    assert [line.split("(")[0] for line in errors[:5]] == [
        f"Error: program worker_{n}: ValueError: worker {n} " for n in range(5)
    ]
    assert errors[5:] == ["Error: and 2 more programs failed"]


@pytest.mark.parametrize("name", ["stuck", "blocking"])
def test_a_program_that_does_not_yield(machine: Path, name: str) -> None:
    done = call("run", machine, *program(name), "--patience", 0.2, "--trace", "run.trace")
    assert done.exit_code == ExitCode.STUCK
    assert f"Error: program {name} has not yielded for 0.2 s in tick 10;" in done.stderr
    assert f'File "{PROGRAMS}", line ' in done.stderr
    assert "Traceback" not in done.stderr
    assert "motionlayer/runtime" not in done.stderr, "the way to the program says nothing about it"
    trace = recorded(Path("run.trace"), 10)
    assert done.stdout.splitlines()[-1] == f"trace hash: {trace.hash}"


@pytest.mark.slow
def test_a_program_that_swallows_interrupts(machine: Path) -> None:
    done = command("run", machine, *program("stubborn"), "--patience", 0.2, "--trace", "run.trace")
    assert done.returncode == ExitCode.STUCK
    assert done.stderr.splitlines()[-1].startswith("Error: a program does not yield and swallows interrupts")
    recorded(Path("run.trace"), 10)


@pytest.mark.parametrize(
    ("source", "text", "said"),
    [
        ("gone.py", None, "gone.py cannot be read: No such file or directory"),
        (".", None, "cannot be read: Is a directory"),
        ("notes.txt", "", "its name must end in .py"),
        ("p.py:nothing", "async def other(run): ...", "p.py has no function 'nothing'; it has other"),
        ("p.py", "def main(a, b, c): ...", "'main' in p.py must be `async def main(run)`, `def main(run)` or"),
        ("p.py", "def main(run): yield", "'main' in p.py must be `async def main(run)`, `def main(run)` or"),
        ("p.py", "async def main(): ...", "'main' in p.py must be `async def main(run)`"),
        ("p.py", "async def main(run:", "SyntaxError: '(' was never closed (p.py, line 1)"),
        ("p.py", "x = 1\ny = x / 0", "ZeroDivisionError: division by zero"),
        ("p.py", "import no_such_module", "ModuleNotFoundError: No module named 'no_such_module'"),
        ("p.py", "import sys\nsys.exit(4)", "SystemExit: 4"),
    ],
)
def test_a_program_that_cannot_be_loaded(machine: Path, source: str, text: str | None, said: str) -> None:
    if text is not None:
        Path(source.partition(":")[0]).write_text(text, encoding="utf-8")
    done = call("run", machine, "--program", source, "--trace", "run.trace")
    assert done.exit_code == ExitCode.FAILED, done.output
    (error,) = done.stderr.splitlines()
    assert error.startswith("Error: program ")
    assert said in error
    assert not Path("run.trace").exists()


def test_an_error_in_an_import_is_placed(machine: Path) -> None:
    Path("p.py").write_text("x = 1\ny = x / 0\n", encoding="utf-8")
    done = call("run", machine, "--program", "p.py")
    assert done.stderr.endswith("p.py:2 in <module>)\n")
