"""The summary of a run, one fact per line."""

from collections.abc import Iterator, Sequence
from typing import Final

from motionlayer.cli._distribution import histogram, overruns, slowest, spread, task
from motionlayer.cli._options import Options
from motionlayer.cli._tally import KEPT, Tally
from motionlayer.machine import MachineRun, RealTime
from motionlayer.nc import Axis

MOST: Final = 8
"""Axes and programs that are listed one by one."""


def summary(run: MachineRun, tally: Tally, wall: float, options: Options) -> Iterator[str]:
    """Yield the lines of the summary, without the hash; `wall` in seconds."""
    cycle = run.base_cycle_ns * 1e-9
    factor = f", {run.time / wall:.3g} x real time" if wall > 0.0 else ""
    facts = [
        ("machine", [run.machine.name]),
        (
            "real time" if options.realtime else "simulated",
            [f"{run.time:.9g} s in {run.tick} ticks of {cycle * 1e3:.9g} ms"],
        ),
        ("wall time", [f"{wall:.3g} s{factor}"]),
        *_measured(run, options),
        ("axes", _shortened(_axes(run))),
        ("programs", _shortened(_programs(tally))),
        ("messages", list(_messages(tally, cycle))),
        ("trace", [str(options.trace)] if options.trace else []),
        ("log", [str(run.log.folder)] if run.log.folder else []),
    ]
    for name, lines in facts:
        yield from lines_of(name, lines)


def _measured(run: MachineRun, options: Options) -> Iterator[tuple[str, list[str]]]:
    """Yield what the ticks have cost and how late they were, where it was measured."""
    if not options.realtime and not options.statistics:
        return
    found = run.statistics
    columns = {"compute": found.compute, "lateness": found.lateness}
    if not options.realtime:
        del columns["lateness"]
    for name, one in columns.items():
        yield name, [spread(one.spread)]
    yield "histogram", list(histogram(columns))
    yield "slowest", [slowest(found)]
    yield "tasks", [task(one) for one in run.tasks.values() if one.compute.count]
    if isinstance(run, RealTime):
        yield "overruns", [overruns(found)]
        yield "refused", run.refused


def lines_of(name: str, lines: Sequence[str]) -> Iterator[str]:
    """Yield lines below one another, the first one beside their name."""
    for index, line in enumerate(lines):
        yield f"{name if index == 0 else '':<11} {line}"


def _axes(run: MachineRun) -> list[str]:
    return [_axis(axis, run.machine.description.axis[name].unit) for name, axis in run.axes.items()]


def _axis(axis: Axis, unit: str) -> str:
    """Return where an axis is, and how fast it goes on if it does."""
    moves = f", still moves at {axis.set_velocity:.9g} {unit}/s" if axis.set_velocity else ""
    return f"{axis.name} at {axis.set_position:.9g} {unit}, {axis.state.name.lower().replace('_', ' ')}{moves}"


def _programs(tally: Tally) -> list[str]:
    return [f"{name} {end}" + (f" {n} times" if n > 1 else "") for (name, end), n in tally.ends.items()]


def _messages(tally: Tally, cycle: float) -> Iterator[str]:
    """Yield how many there were, and the last ones: a flood of warnings never hides an error."""
    counts, entries = tally.said.counts, tally.said.entries()[:KEPT]
    if not entries:
        return
    listed = sum(entry.times + entry.others for entry in entries)
    shown = f"; the last {len(entries)}:" if sum(counts.values()) > listed else ":"
    yield ", ".join(_counted(number, level.name.lower()) for level, number in counts.items()) + shown
    for entry in entries:
        event = entry.event
        yield f"  {event.tick * cycle:.6f} s  {event.level.name.lower()}  {entry.line(cycle)}"


def _counted(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def _shortened(lines: list[str]) -> list[str]:
    return lines if len(lines) <= MOST else [*lines[:MOST], f"and {len(lines) - MOST} more"]
