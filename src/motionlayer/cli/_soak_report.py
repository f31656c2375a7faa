"""The report of `motionlayer soak`: on the screen, and as JSON for who compares."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from motionlayer.cli._distribution import histogram, overruns, slowest, spread, task
from motionlayer.cli._exit import ExitCode, Stop
from motionlayer.cli._memory import Growth
from motionlayer.cli._soak_options import SoakOptions
from motionlayer.cli._summary import lines_of
from motionlayer.cli._tally import Tally
from motionlayer.event import Event, Level
from motionlayer.machine import MachineRun, RealTime

MIB = 2**20


class SoakTally(Tally):
    """A listener of events that counts all of them.

    Attributes:
        counts: by level, from the gravest on.
    """

    def __init__(self) -> None:
        super().__init__()
        self.counts = dict.fromkeys(Level, 0)

    def __call__(self, event: Event) -> None:
        """Take in an event."""
        self.counts[event.level] += 1
        super().__call__(event)


class Soaked(NamedTuple):
    """What came of it.

    Attributes:
        run: has ended.
        options: what was asked for.
        tally: what the run said.
        wall: s.
        growth: of memory, None if the run ended before its warm-up.
        judged: what was found in the end of the trace, "" without one.
        problem: why it ended early, "" if it did not.
    """

    run: MachineRun
    options: SoakOptions
    tally: "SoakTally"
    wall: float
    growth: Growth | None
    judged: str
    problem: str

    @property
    def drift(self) -> float:
        """By how much the run is behind its clock in the end, s: without slips, and with the last tick's lateness."""
        return self.wall - self.run.time / (self.options.speed or 1.0) - self.run.statistics.slipped


def lines(report: Soaked) -> Iterator[str]:
    """Yield the lines of the report."""
    run, found = report.run, report.run.statistics
    cycles = f"{run.tick} of {report.options.cycles} cycles of {run.base_cycle_ns * 1e-6:.9g} ms"
    per_cycle = f", {report.wall / run.tick * 1e6:.3g} µs a cycle" if run.tick else ""
    columns = {"compute": found.compute, "lateness": found.lateness}
    if not report.options.realtime:
        del columns["lateness"]
    facts = [
        ("machine", [run.machine.name]),
        ("real time" if report.options.realtime else "simulated", [f"{run.time:.9g} s, {cycles}"]),
        ("wall time", [f"{report.wall:.6g} s{per_cycle}"]),
        ("memory", list(_memory(report.growth))),
        *((name, [spread(one.spread)]) for name, one in columns.items()),
        ("histogram", list(histogram(columns))),
        ("slowest", [slowest(found)]),
        ("tasks", [task(one) for one in run.tasks.values() if one.compute.count]),
        *_clock(report),
        ("programs", [f"{name} {end} {count} times" for (name, end), count in _ends(report.tally)]),
        ("messages", [", ".join(f"{count} {name}" for name, count in _levels(report.tally).items())]),
        ("trace", [f"{report.options.trace}: {report.judged}"] if report.judged else []),
    ]
    for name, texts in facts:
        yield from lines_of(name, texts)


def _memory(growth: Growth | None) -> Iterator[str]:
    if growth is None:
        yield "the run ended before its warm-up"
        return
    yield f"{growth.start / MIB:.2f} MiB at cycle {growth.first}, {growth.end / MIB:.2f} MiB at the end"
    grown = (growth.end - growth.start) / MIB
    rate = growth.per_million / MIB
    yield f"grown by {grown:.3f} MiB, {rate:.3f} MiB in 10^6 cycles; most {growth.most / MIB:.2f} MiB"


def _clock(report: Soaked) -> Iterator[tuple[str, list[str]]]:
    if isinstance(report.run, RealTime):
        yield "drift", [f"{report.drift * 1e6:.1f} µs behind the clock, slips left out"]
        yield "overruns", [overruns(report.run.statistics)]
        yield "refused", report.run.refused


def _ends(tally: Tally) -> Iterator[tuple[tuple[str, str], int]]:
    """Yield the ends of the programs, without those of who starts them again."""
    yield from ((key, count) for key, count in tally.ends.items() if not key[0].startswith("soak "))


def _levels(tally: SoakTally) -> dict[str, int]:
    return {level.name.lower(): count for level, count in tally.counts.items() if count or level <= Level.WARNING}


def as_json(report: Soaked) -> dict[str, Any]:
    """Return the report as JSON values: times in seconds, memory in bytes, what was measured in nanoseconds."""
    run, found, growth = report.run, report.run.statistics, report.growth
    values: dict[str, Any] = {
        "machine": run.machine.name,
        "seed": run.seed,
        "realtime": report.options.realtime,
        "cycles": run.tick,
        "wanted": report.options.cycles,
        "time": run.time,
        "wall": report.wall,
        "problem": report.problem,
        "judged": report.judged,
        "memory": None if growth is None else {**growth._asdict(), "per_million": growth.per_million},
        "compute": found.compute.spread._asdict(),
        "messages": _levels(report.tally),
        "programs": [{"name": name, "end": end, "times": count} for (name, end), count in _ends(report.tally)],
    }
    if report.options.realtime:
        values["lateness"] = found.lateness.spread._asdict()
        values |= {"drift": report.drift, "overruns": found.overruns, "slips": found.slips, "slipped": found.slipped}
        values["brakes"] = found.brakes
    return values


def write(report: Soaked, path: Path) -> None:
    """Write the report as JSON."""
    try:
        path.write_text(json.dumps(as_json(report), indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    except OSError as error:
        raise Stop(ExitCode.OUTPUT, f"{path} cannot be written: {error.strerror}") from error
