"""The rows `trace.*`: what recording costs the cycle, and what it costs in all."""

import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import perf_counter_ns, process_time_ns, thread_time_ns
from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer.bench import _load
from motionlayer.bench._row import Effort, Figure
from motionlayer.bench._timing import quiet
from motionlayer.machine import Machine
from motionlayer.machine._build import build
from motionlayer.machine._tracing import Tracing
from motionlayer.record import Recorder, Signal
from motionlayer.runtime import Run, Stage, Step

SIGNALS: Final = ("*.set_position", "*.set_velocity", "*.set_acceleration", "*.actual_position")
AXES: Final = 250
"""Times the four signals: 1000."""

LONG: Final = 5
"""Ticks per sample: many blocks are handed over in a round."""

TABLE: Final = (10, 100)
"""Quantities by axes of the share of a core; all of them are signals, four are hashed."""

FEW: Final = 20
"""Axes that move in a machine where most of them rest."""

BANK: Final = 64
"""Tables with values that repeat."""


def trace(effort: Effort) -> Figure:
    """Compare ticks with the capture stage, recording to a file, and without any: mean, hand-over included.

    The note tells the wall time: back to back the cycle is quicker than the thread that writes, and waits for it.
    """
    machine = _load.machine(AXES, SIGNALS)
    ticks, pairs = LONG * effort.samples, []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(effort.runs):
            # In turns, so that a change of the processor's clock meets both; the recorder is closed in between,
            # or its thread would still be writing while the run without it is timed.
            bare = measured(machine, ticks, None)
            pairs.append((measured(machine, ticks, Path(folder) / "bench.trace"), bare))
    processor, wall = (
        sum(one[clock] - other[clock] for one, other in pairs) / (len(pairs) * ticks * 1e3) for clock in (0, 1)
    )
    return Figure(
        processor,
        "processor time of the cycle thread; in wall time, back to back, a tick takes "
        f"{wall:.3g} µs longer, because the run waits for the writer",
    )


def measured(machine: Machine, ticks: int, file: Path | None) -> tuple[int, int]:
    """Return processor time of this thread and wall time of some ticks, in nanoseconds; all axes move.

    `Simulation` has a stage in place of the trace, so the run is put together here.
    """
    parts = build(machine.description)
    stages = list(parts.stages)
    tracing = None if file is None else Tracing(machine, parts, 0, (), file, keep=True)
    if tracing is not None:
        stages.append(Stage(Step.CAPTURE, "trace", tracing.capture))
    run = Run(
        stages,
        base_cycle_ns=machine.description.base_cycle_ns,
        ledger=parts.ledger,
        events=parts.events,
        on_failure=lambda _program: None,
    )
    _load.set_off(run, parts.axes)
    with quiet():
        processor, wall = thread_time_ns(), perf_counter_ns()
        run.step(ticks)
        taken = thread_time_ns() - processor, perf_counter_ns() - wall
    if tracing is not None:
        tracing.close()
    return taken


def core_share(effort: Effort) -> Figure:
    """Return which share of a core a trace file of 1000 signals at 1 kHz takes: cycle, encoding, hash and writing.

    In the worst case every bit of every signal is random. The note tells a machine of which most axes rest.
    """
    ticks = LONG * effort.samples
    worst, few = (median(_share(moving, ticks) for _ in range(effort.runs)) for moving in (TABLE[1], FEW))
    return Figure(worst, f"all signals are random numbers, hash included; {few:.2g} if {FEW} of {TABLE[1]} axes move")


def _share(moving: int, ticks: int) -> float:
    """Record a table of which so many columns change in every tick; return seconds of processor time per second."""
    table = np.zeros(TABLE)
    bank = np.random.default_rng(1).normal(size=(BANK, TABLE[0], moving))
    signals = [Signal(f"signal {index}", "mm", index) for index in range(table.size)]
    bare = _processor_time(table, bank, ticks, lambda _tick: None)
    with tempfile.TemporaryDirectory() as folder:
        recorder = Recorder(table, signals, {"base_cycle_ns": 1_000_000}, Path(folder) / "bench.trace")
        recorded = _processor_time(table, bank, ticks, recorder.capture, recorder.close)
    return (recorded - bare) / (ticks * 1e6)


def _processor_time(
    table: NDArray[np.float64],
    bank: NDArray[np.float64],
    ticks: int,
    capture: Callable[[int], None],
    close: Callable[[], object] = lambda: None,
) -> int:
    """Return what all threads together take for some ticks, in nanoseconds."""
    moving = bank.shape[2]
    with quiet():
        start = process_time_ns()
        for tick in range(ticks):
            table[:, :moving] = bank[tick % BANK]
            capture(tick)
        close()
        return process_time_ns() - start
