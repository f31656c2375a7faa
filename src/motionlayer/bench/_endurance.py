"""The rows of runs that go on for hours: lateness in real time, growth of memory."""

import json
import tempfile
from pathlib import Path
from typing import Final

from motionlayer.bench import _command, _load
from motionlayer.bench._row import Effort, Failed, Figure
from motionlayer.machine import RealTime
from motionlayer.nc import Axis

AXES: Final = 100
"""All of them move."""

TICKS: Final = 10
"""Times the samples: 20 s of a cycle of 1 ms."""

CYCLES: Final = 5000
"""Times the samples: 10^7."""

WARM_UP: Final = 0.1
"""Share of the cycles after which memory counts: the ring of messages and the allocator have filled up."""

HOUR: Final = 3600.0
"""Seconds after which a soak is taken to hang."""

MIB: Final = 2**20

MACHINE: Final = """\
format = 1
name = "soak"
[axis.X]
max_velocity = 1000.0
max_acceleration = 8000.0
max_jerk = 100000.0
[axis.Y]
max_velocity = 1000.0
max_acceleration = 8000.0
max_jerk = 100000.0
drive = { kind = "servo", position_gain = 80.0, time_constant = 0.002, noise = 0.001 }
[program.moves]
file = "program.py"
[program.polls]
file = "program.py"
function = "poll"
"""

PROGRAM: Final = '''\
async def main(run):
    """Move there and back; it ends and is started again."""
    x, y = run.axes["X"], run.axes["Y"]
    await x.enable()
    await y.enable()
    there = x.move_absolute(100.0)
    await y.move_absolute(40.0)
    await there
    x.move_absolute(0.0)
    await y.move_absolute(0.0)


def poll(run, memory):
    """Change the override now and then."""
    if run.tick % 500 == 250:
        run.axes["X"].set_override(0.5 + 0.001 * (run.tick % 400))
'''


def late_p99(effort: Effort) -> Figure:
    """Return the 99th percentile of the lateness of a 1 ms cycle in which 100 axes move; the machine should be idle."""
    machine = _load.machine(AXES, settings={}, signals=())
    ticks = TICKS * effort.samples
    with RealTime(machine, trace=None, log=False) as run:
        for number, axis in enumerate(run.axes.values()):
            run.start(_endless(axis, 100.0 + number % 7), axis.name)
        run.run(time=ticks * _load.BASE_CYCLE)
        found = run.statistics
    if found.lateness.count != ticks:
        raise Failed(f"{found.lateness.count} of {ticks} ticks were counted")
    late, compute = found.lateness.spread, found.compute.spread
    refused = f"; refused: {', '.join(run.refused)}" if run.refused else ""
    return Figure(
        late.p99 / 1e3,
        f"{ticks} ticks: lateness median {late.median / 1e3:.3g}, max {late.max / 1e3:.3g} µs; compute p99 "
        f"{compute.p99 / 1e3:.3g}, max {compute.max / 1e3:.3g} µs; {found.overruns} overruns{refused}",
    )


async def _endless(axis: Axis, velocity: float) -> None:
    await axis.enable()
    await axis.move_velocity(velocity)


def growth(effort: Effort) -> Figure:
    """Return by how much the resident memory of `motionlayer soak` grows after its warm-up."""
    cycles = CYCLES * effort.samples
    with tempfile.TemporaryDirectory() as folder:
        machine, report = Path(folder) / "machine.toml", Path(folder) / "report.json"
        machine.write_text(MACHINE, encoding="utf-8")
        machine.with_name("program.py").write_text(PROGRAM, encoding="utf-8")
        warm_up = round(WARM_UP * cycles)
        options = ("--cycles", str(cycles), "--warm-up", str(warm_up), "--report", report)
        taken = _command.seconds("soak", machine, *options, patience=HOUR)
        found = json.loads(report.read_text(encoding="utf-8"))
    memory = found["memory"]
    grown = (memory["end"] - memory["start"]) / MIB
    return Figure(grown, f"{found['cycles']} cycles in {taken:.3g} s, from {memory['start'] / MIB:.1f} MiB on")
