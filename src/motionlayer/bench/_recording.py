"""The row `trace.signals_1000`: what recording costs the cycle."""

import tempfile
from pathlib import Path
from time import perf_counter_ns, thread_time_ns
from typing import Final

from motionlayer.bench import _load
from motionlayer.bench._row import Effort, Figure
from motionlayer.bench._timing import quiet
from motionlayer.machine import Machine
from motionlayer.machine._build import build
from motionlayer.machine._tracing import Tracing
from motionlayer.runtime import Run, Stage, Step

SIGNALS: Final = ("*.set_position", "*.set_velocity", "*.set_acceleration", "*.actual_position")
AXES: Final = 250
"""Times the four signals: 1000."""

LONG: Final = 5
"""Ticks per sample: many blocks are handed over in a round."""


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
