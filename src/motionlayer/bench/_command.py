"""Rows that run the real command in a process of its own."""

import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter
from typing import Final

import motionlayer
from motionlayer.bench._row import Effort, Failed, Figure, Skipped
from motionlayer.record import Trace

GANTRY: Final = Path(motionlayer.__file__).resolve().parents[2] / "examples" / "gantry" / "machine.toml"
"""In a checkout; an installation has no examples."""

PATIENCE: Final = 120.0
"""Seconds after which a process is taken to hang."""

MACHINE: Final = """\
format = 1
name = "start"
[axis.X]
max_velocity = 1000.0
max_acceleration = 8000.0
max_jerk = 100000.0
[program.main]
file = "program.py"
"""

PROGRAM: Final = '''\
async def main(run):
    """Plan and sample a move, so that every kernel is loaded."""
    await run.axes["X"].enable()
    await run.axes["X"].move_absolute(1.0)
'''


def seconds(*arguments: str | Path, cache: Path | None = None, patience: float = PATIENCE) -> float:
    """Return how long the command takes, from the start of the process until it has ended.

    Args:
        arguments: of `motionlayer`.
        cache: folder of compiled kernels; the user's where left out.
        patience: seconds after which it is taken to hang.

    Raises:
        Failed: its exit code is not 0, or it hangs.
    """
    environment = os.environ if cache is None else {**os.environ, "MOTIONLAYER_CACHE": str(cache)}
    command = [sys.executable, "-m", "motionlayer", *map(str, arguments)]
    start = perf_counter()
    try:
        ended = subprocess.run(  # noqa: S603 - our own command
            command, env=environment, capture_output=True, text=True, timeout=patience, check=False
        )
    except subprocess.TimeoutExpired:
        raise Failed(f"motionlayer {arguments[0]} has not ended after {patience:g} s") from None
    taken = perf_counter() - start
    if ended.returncode:
        last = (ended.stderr.strip() or ended.stdout.strip() or "no message").splitlines()[-1]
        raise Failed(f"motionlayer {arguments[0]} ended with exit code {ended.returncode}: {last}")
    return taken


def demo(effort: Effort, machine: Path = GANTRY) -> Figure:
    """Compare the simulated time of the gantry with the time its run takes, trace and start included."""
    if not machine.is_file():
        raise Skipped("the examples are not installed")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "demo.trace"
        times = [seconds("run", machine, "--trace", file) for _ in range(effort.runs)]
        recorded = Trace.load(file)
    return Figure(len(recorded.ticks) * recorded.base_cycle / statistics.median(times))


def start_warm(effort: Effort) -> Figure:
    """Time a run of a few ticks that uses every kernel; all of them are in the cache."""
    with tempfile.TemporaryDirectory() as folder:
        machine = _short(Path(folder))
        seconds("run", machine, "--hash")
        taken = statistics.median(seconds("run", machine, "--hash") for _ in range(effort.runs))
    compiles = "PYTHONDONTWRITEBYTECODE is set, so that every start compiles all sources"
    return Figure(taken, compiles if sys.dont_write_bytecode else "")


def start_cold(_effort: Effort) -> Figure:
    """Time the same run once with an empty cache."""
    with tempfile.TemporaryDirectory() as folder:
        return Figure(seconds("run", _short(Path(folder)), "--hash", cache=Path(folder) / "cache"))


def help_time(effort: Effort) -> Figure:
    """Time `--help`."""
    seconds("--help")
    return Figure(statistics.median(seconds("--help") for _ in range(effort.runs)))


def _short(folder: Path) -> Path:
    """Write the machine and its program; return the machine file."""
    (folder / "program.py").write_text(PROGRAM, encoding="utf-8")
    machine = folder / "machine.toml"
    machine.write_text(MACHINE, encoding="utf-8")
    return machine
