"""What was measured in a run, for the summary: four numbers each, and a histogram in text."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from motionlayer.runtime import Histogram, Spread, Statistics, Task

EDGES: Final = tuple(digit * 10**power for power in range(3, 11) for digit in (1, 2, 5))
"""Between the lines of a histogram: 1 µs to 50 s in ns, three in a decade."""

BAR: Final = 24
"""Characters of all values together."""

_UNITS: Final = ((1e9, "s"), (1e6, "ms"), (1e3, "µs"), (1.0, "ns"))


def duration(ns: float) -> str:
    """Return a duration with three digits and the unit that suits it."""
    size, unit = next((one for one in _UNITS if ns >= one[0]), _UNITS[-1])
    return f"{ns / size:.3g} {unit}"


def spread(found: Spread) -> str:
    """Return a distribution in one line."""
    values = (found.min, found.median, found.p99, found.max)
    return ", ".join(f"{name} {duration(ns)}" for name, ns in zip(("min", "median", "p99", "max"), values, strict=True))


def histogram(columns: Mapping[str, Histogram]) -> Iterator[str]:
    """Yield the lines of a table: how many values of each column lie from one edge up to the next."""
    counts = {name: one.coarse(EDGES) for name, one in columns.items()}
    used = [row for row in range(len(EDGES) + 1) if any(column[row] for column in counts.values())]
    if not used:
        return
    yield f"{'from':>7}  " + "".join(f"{name:>9} {'':<{BAR}}" for name in counts).rstrip()
    for row in range(used[0], used[-1] + 1):
        low = duration(EDGES[row - 1]) if row else "0 ns"
        yield (f"{low:>7}  " + "".join(_bar(column, row) for column in counts.values())).rstrip()


def _bar(counts: Sequence[int], row: int) -> str:
    length = math.ceil(BAR * counts[row] / max(1, sum(counts)))
    return f"{counts[row] or '':>9} {'#' * length:<{BAR}}"


def overruns(found: Statistics) -> str:
    """Return how often ticks were late, how time slipped, and how often the axes braked for it."""
    slips = {0: "time never slipped", 1: "time slipped once"}.get(found.slips, f"time slipped {found.slips} times")
    by = f", by {duration(found.slipped * 1e9)}" if found.slips else ""
    times = {0: "", 1: "; all axes braked once"}.get(found.brakes, f"; all axes braked {found.brakes} times")
    return f"{found.overruns} of {found.lateness.count} ticks; {slips}{by}{times}"


def slowest(found: Statistics) -> str:
    """Return the stage with the longest call."""
    name = max(found.stages, key=lambda one: found.stages[one])
    return f"{name}, {duration(found.stages[name])}"


def task(one: Task) -> str:
    """Return what the cycles of a task cost."""
    over = f"; over its budget of {duration(one.budget_ns)} {one.over_budget} times" if one.over_budget else ""
    return f"{one.name}: {spread(one.compute.spread)}{over}"
