from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from tests.cli.support import MACHINE, PROGRAMS, call, command, line_of, program, recorded


def test_run_verify_and_plot(machine: Path) -> None:
    done = call("run", machine, *program("main"), "--trace", "one.trace", "--plot", "run.html", "--seed", 5)
    assert done.exit_code == ExitCode.OK, done.output
    lines = done.stdout.splitlines()
    assert lines[:2] == ["there 300.0", "machine     one"]
    assert "axes        X at 300 mm, standstill" in lines
    assert "programs    programs ended" in lines
    assert lines[-3:-1] == ["trace       one.trace", "plot        run.html"]
    trace = recorded(Path("one.trace"), 508)
    assert "simulated   0.508 s in 508 ticks of 1 ms" in lines
    assert lines[-1] == f"trace hash: {trace.hash}"
    assert trace.header["seed"] == 5
    judged = call("verify", "one.trace")
    assert (judged.exit_code, judged.stdout.split(":")[0]) == (ExitCode.OK, "valid")
    drawn = call("plot", "one.trace")
    assert (drawn.exit_code, drawn.stdout) == (ExitCode.OK, "plot        one.html\n")
    assert Path("one.html").read_bytes() == Path("run.html").read_bytes()


def test_the_programs_of_the_machine(machine: Path) -> None:
    entry = f'[program.first]\nfile = "{PROGRAMS}"\n[program.second]\nfile = "{PROGRAMS}"\nfunction = "noisy"\n'
    machine.write_text(MACHINE + entry, encoding="utf-8")
    done = call("run", machine)
    assert done.exit_code == ExitCode.OK
    assert "programs    second ended\n            first ended\n" in done.stdout
    assert "hash" not in done.stdout
    alone = call("run", machine, *program("noisy"))
    assert "programs    noisy ended\nmessages" in alone.stdout


def test_messages_are_counted_and_the_last_ones_shown(machine: Path) -> None:
    lines = call("run", machine, *program("noisy")).stdout.splitlines()
    start = lines.index("messages    0 errors, 7 warnings; the last 5:")
    assert lines[start + 1 :] == [f"              0.00{n}000 s  warning  X: message {n}" for n in range(2, 7)]
    assert "messages    0 errors, 1 warning:" in call("run", machine, *program("refused")).stdout.splitlines()


def test_a_flood_of_warnings_hides_no_error_and_one_fault_is_one_line(machine: Path) -> None:
    lines = call("run", machine, *program("flooding")).stdout.splitlines()
    start = lines.index("messages    2 errors, 29 warnings:")
    assert [line.split("  ")[-1] for line in lines[start + 1 :]] == [
        "X: the drive is not ready (and 1 more of the same)",
        "runtime: 1 ticks late, to be caught up; programs, 1.5 ms (29 times, the last at 0.029000 s)",
    ]


def test_a_message_of_the_motion_layer_is_told_with_its_subdevice_and_number(machine: Path) -> None:
    machine.write_text(MACHINE + "[layer]\n", encoding="utf-8")
    source = """
async def main(run):
    await run.layer.started()
    run.layer.axis[1].data.velocity = 10.0
    run.layer.axis[1].ctrl.cmd = 12
    await run.sleep(0.005)
"""
    machine.with_name("moves.py").write_text(source, encoding="utf-8")
    lines = call("run", machine, "--program", machine.with_name("moves.py")).stdout.splitlines()
    assert any(line.endswith("error  GVL_AXIS.Ctrl[1]: fbMovePtP PROGRESS_ERROR [0x4260]") for line in lines), lines


def test_a_time_ends_a_run_with_and_without_programs(machine: Path) -> None:
    done = call("run", machine, "--time", 0.25, "--trace", "a.trace")
    assert done.exit_code == ExitCode.OK
    recorded(Path("a.trace"), 250)
    done = call("run", machine, *program("shuttle"), "--time", 0.25, "--trace", "b.trace")
    assert done.exit_code == ExitCode.OK
    assert "programs    shuttle cancelled" in done.stdout
    recorded(Path("b.trace"), 250)


def test_more_axes_than_fit_are_counted(machine: Path) -> None:
    axis = MACHINE[MACHINE.index("[axis") :]
    machine.write_text(MACHINE + "".join(axis.replace("X", f"A{n}") for n in range(9)), encoding="utf-8")
    lines = call("run", machine, "--time", 0.01).stdout.splitlines()
    assert lines[-2:] == ["            A6 at 0 mm, disabled", "            and 2 more"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "names no program, and the run would never end: give --program FILE[:NAME], or --time S"),
        (["--time", "0"], "'--time': 0 must be finite and greater than 0 (s)"),
        (["--time", "-1"], "'--time': -1 must be finite and greater than 0 (s)"),
        (["--time", "inf"], "'--time': inf must be finite and greater than 0 (s)"),
        (["--time", "nan"], "'--time': nan must be finite and greater than 0 (s)"),
        (["--time", "soon"], "'--time': 'soon' is not a valid float"),
        (["--time", "1", "--patience", "0"], "'--patience': 0 must be finite and greater than 0 (s)"),
        (["--time", "1", "--seed", "-1"], "'--seed': -1 is not in the range"),
        (["--time", "1", "--plot", "run.png"], "'--plot': run.png: a page is written as .html"),
        (["--time", "1", "--trace", "machine.toml"], "machine.toml would be overwritten"),
        (["--time", "1", "--trace", "a.html", "--plot", "./a.html"], "a.html would be overwritten"),
        ([*program("main"), "--trace", str(PROGRAMS)], "would be overwritten"),
    ],
)
def test_wrong_options(machine: Path, arguments: list[str], said: str) -> None:
    before = PROGRAMS.read_bytes()
    done = call("run", machine, *arguments)
    assert done.exit_code == ExitCode.USAGE
    assert said in done.stderr
    assert machine.read_text(encoding="utf-8") == MACHINE
    assert PROGRAMS.read_bytes() == before


@pytest.mark.slow
def test_the_hash_depends_on_nothing_but_the_run(machine: Path) -> None:
    """Neither on hash seeds, nor on the mode of the kernels, nor on what is recorded."""
    run = ("run", machine, *program("main"), "--time", 0.2)
    ways = [
        command(*run, "--hash", PYTHONHASHSEED="1"),
        command(*run, "--hash", PYTHONHASHSEED="2", MOTIONLAYER_KERNELS="plain"),
        command(*run, "--trace", "a.trace", "--plot", "a.html", PYTHONHASHSEED="3"),
    ]
    assert [done.returncode for done in ways] == [0, 0, 0], ways
    (digest,) = {done.stdout.splitlines()[-1] for done in ways}
    assert digest.startswith("trace hash: ")
    other = call("run", machine, *program("shuttle"), "--time", 0.1, "--hash")
    assert other.stdout.splitlines()[-1].startswith("trace hash: ")
    assert other.stdout.splitlines()[-1] != digest


@pytest.mark.slow
def test_the_first_run_says_that_it_compiles_and_the_next_does_not(machine: Path, tmp_path: Path) -> None:
    cache = str(tmp_path / "cache")
    first, second = (command("run", machine, "--time", 0.01, MOTIONLAYER_CACHE=cache) for _ in range(2))
    assert (first.returncode, second.returncode) == (0, 0)
    assert first.stderr == "compiling the kernels, once for this version; the next run starts at once\n"
    assert second.stderr == ""


def test_an_axis_that_goes_on_and_a_wait_without_await_are_in_the_summary(machine: Path) -> None:
    done = call("run", machine, *program("careless"))
    assert done.exit_code == ExitCode.OK
    (axes,) = [line for line in done.stdout.splitlines() if line.startswith("axes")]
    assert axes.endswith("mm, continuous motion, still moves at 20 mm/s")
    line = line_of("run.sleep(1.0)  # nobody awaits it")
    place = f"programs.py:{line} in careless"
    assert f"program careless: sleep(1) at {place} is not awaited, so it does nothing" in done.stdout
    assert "X: still moves: X.move_velocity goes on, and the last program has ended" in done.stdout
    assert "0 errors, 2 warnings:" in done.stdout
