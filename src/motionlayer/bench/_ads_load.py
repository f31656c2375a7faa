"""What the group `ads` measures: a run with a server, and what is done from outside meanwhile."""

import contextlib
import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, Final, TypeVar

from motionlayer.bench import _load
from motionlayer.bench._environment import PeersMissing
from motionlayer.bench._row import Effort, Failed, Skipped
from motionlayer.iec import DINT, LREAL, Field, InputArray, Struct, SymbolTable
from motionlayer.machine import Machine, RealTime
from motionlayer.nc import Axis
from motionlayer.runtime import Program

T = TypeVar("T")

AXES: Final = 64
LOOK: Final = 0.1
"""Seconds between two looks whether a run lets clients in, and whether its axes move."""

STARTING: Final = 120.0
"""Seconds within which they must; what is needed may have to be compiled, on a computer that has more to do."""

CLIENT: Final = Path(__file__).with_name("_ads_client.py")
READER: Final = Path(__file__).with_name("_ads_reader.py")

PATIENCE: Final = 300.0
"""Seconds of wall time in which a client must have ended."""


class Sample(Struct, iec="ST_SAMPLE"):
    """A structure of 32 bytes."""

    one = Field("rValue1", LREAL)
    two = Field("rValue2", LREAL)
    three = Field("rValue3", LREAL)
    four = Field("rValue4", LREAL)


def declare(symbols: SymbolTable) -> None:
    """Add the variables that the peer has too."""
    symbols.add("GVL.Count", InputArray(DINT, None, None, "GVL.Count"))
    symbols.add("GVL.Sample", InputArray(Sample, None, None, "GVL.Sample"))
    symbols.add("GVL.Values", InputArray(LREAL, 1, 50, "GVL.Values"))


@contextlib.contextmanager
def served(axes: int, add: Callable[[SymbolTable], None] = declare) -> Iterator[RealTime]:
    """Yield a run in real time, with so many axes and a server in a process of its own; it has not begun."""
    description: dict[str, Any] = {
        "format": 1,
        "name": "bench",
        "axis": {f"A{number}": dict(_load.LIMITS) for number in range(axes)},
        "layer": {},
        "ads": {"port": 0},
    }
    with RealTime(Machine.from_dict(description), trace=None, log=False) as run:
        add(run.symbols)
        yield run


def moving(run: RealTime, act: Callable[[], T]) -> T:
    """Return what `act` does in another thread while all axes of a run move; it begins when they do.

    The first of the values is the number of the tick meanwhile.
    """
    programs = [
        run.start(_endless(run, axis, 100.0 + number % 7), axis.name) for number, axis in enumerate(run.axes.values())
    ]
    programs.append(run.start(_show_ticks(run), "clock"))

    def settled() -> T:
        _wait_until(lambda: all(axis.set_velocity > 0.0 for axis in run.axes.values()), "the axes do not move")
        return act()

    return _beside(run, settled, programs)


def paused(run: RealTime, act: Callable[[], T]) -> T:
    """Return what `act` does in another thread while a run is held up."""

    def hold_up() -> T:
        _wait_until(lambda: run.ads.begun, "the server lets nobody in")
        run.pause()
        try:
            return act()
        finally:
            run.resume()

    return _beside(run, hold_up, ())


def _wait_until(holds: Callable[[], bool], else_: str) -> None:
    """Wait for a condition, or raise `Failed` with what is the case else."""
    end = time.monotonic() + STARTING
    while not holds():
        if time.monotonic() > end:
            raise Failed(f"{else_} within {STARTING:g} s")
        time.sleep(LOOK)


def _beside(run: RealTime, act: Callable[[], T], programs: Iterable[Program]) -> T:
    """Let a run go on until another thread has done something; then end its programs, and return what that gave."""
    over = threading.Event()
    found: list[T] = []
    problems: list[Exception] = []

    def work() -> None:
        try:
            found.append(act())
        except Exception as error:  # noqa: BLE001 - raised again by who waits
            problems.append(error)
        finally:
            over.set()

    async def until_over() -> None:
        await run.until(over.is_set)
        for program in programs:
            program.cancel()

    thread = threading.Thread(target=work, name="bench ads")
    thread.start()
    try:
        run.run(until_over())
    finally:
        thread.join()
    if problems:
        raise problems[0]
    return found[0]


async def _show_ticks(run: RealTime) -> None:
    while True:
        run.symbols.write("GVL.Values[1]", float(run.tick), by="bench")
        await run.sleep(0)


async def _endless(run: RealTime, axis: Axis, velocity: float) -> None:
    await run.until(lambda: run.layer.ready)
    await axis.enable()
    await axis.move_velocity(velocity)


def ask(effort: Effort, job: str, run: RealTime, **work: Any) -> Any:  # noqa: ANN401 - JSON
    """Return the answer of `_ads_client` to a job.

    Raises:
        Failed: a server refuses what it asks, or does not answer.
        Skipped: there is no pyads.
    """
    try:
        return effort.peers.run(CLIENT, {"job": job, "port": run.ads.port, **work})
    except PeersMissing as missing:
        if "ADSError" in str(missing):
            raise Failed(str(missing)) from None
        raise Skipped(f"no pyads: {missing}") from None


def count(run: RealTime, **work: Any) -> dict[str, int]:  # noqa: ANN401 - JSON
    """Return what `_ads_reader` has counted.

    Raises:
        Failed: it did not come to an end.
    """
    given = json.dumps({"port": run.ads.port, **work})
    ended = subprocess.run(  # noqa: S603 - this interpreter, constant arguments
        [sys.executable, "-I", str(READER)], input=given, capture_output=True, text=True, timeout=PATIENCE, check=False
    )
    if ended.returncode:
        raise Failed(f"the reader of notifications: {(ended.stderr.strip() or 'no message').splitlines()[-1]}")
    found: dict[str, int] = json.loads(ended.stdout)
    return found


def processor_time(pid: int) -> float:
    """Return the processor time of a process so far, in seconds."""
    fields = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
