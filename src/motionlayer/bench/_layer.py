"""The group `layer`: what the motion layer and its images cost the cycle, and whether it keeps its contract.

What the layer costs is the complete cycle of a machine that has one, less the complete cycle of the same machine that
has none and whose axes do the same. Both take turns of some cycles, so that whatever slows the computer down meets
both, and each finds the caches as it has left them, as in the other groups.
"""

import statistics
from collections.abc import Callable, Mapping
from time import perf_counter_ns
from types import MappingProxyType
from typing import Any, Final

from motionlayer.bench._layer_load import AXES, differences, endless, layer_of, layered_run, pair, require_jobs, set_off
from motionlayer.bench._row import MICRO, Effort, Figure, Goal, Row
from motionlayer.bench._timing import quiet
from motionlayer.bench.campaign import CAMPAIGNS
from motionlayer.bench.campaign._contract import contract
from motionlayer.bench.campaign._contract_oracle import answers
from motionlayer.bench.campaign._contract_play import play
from motionlayer.layer import AxisCommand

BATCH: Final = 1000
"""Calls that are timed together where one is too short for the clock."""

SPREAD: Final[Mapping[str, Any]] = MappingProxyType(
    {
        "divisor": {"functions": 4, "nci": 4, "cam": 4, "saw": 4},
        "phase": {"functions": 0, "nci": 1, "cam": 2, "saw": 3},
    }
)
"""Axes in every tick, so that they answer in the same cycle; the others take turns."""

PHASES: Final = 4

SEED: Final = 1
PER_SEQUENCE: Final = 2
"""Samples of the effort for each sequence of the campaign: 1000 sequences of 2000 samples."""


def idle(effort: Effort) -> Figure:
    """Compare cycles in which no axis has anything to do."""
    with pair({}) as (layered, bare):
        return Figure(statistics.median(differences(layered, bare, effort.samples)))


def busy(effort: Effort) -> Figure:
    """Compare cycles in which every axis moves, by a job of the layer or without one."""
    with pair({}) as (layered, bare):
        set_off(layered, bare)
        figure = Figure(statistics.median(differences(layered, bare, effort.samples)))
        require_jobs(layered)
        return figure


def off(effort: Effort) -> Figure:
    """Time the call of a namespace that is off, of the dearest one; nobody writes its commands."""
    run = layered_run({})
    calls = [stage.run for stage in layer_of(run).stages() if stage.name != "MAIN"]
    with quiet():
        return Figure(max(_per_call(call, effort.samples) for call in calls))


def spread(effort: Effort) -> Figure:
    """Compare the phases of the cycle: what the layer costs in the dearest one over the mean of all."""
    with pair(dict(SPREAD)) as (layered, bare):
        set_off(layered, bare)
        first = layered.tick % PHASES
        costs = differences(layered, bare, PHASES * effort.samples)
        require_jobs(layered)
    phases = [statistics.median(costs[phase::PHASES]) for phase in range(PHASES)]
    dearest = (phases.index(max(phases)) + first) % PHASES
    listed = ", ".join(f"{phase:.3g}" for phase in phases)
    return Figure(max(phases) / statistics.mean(phases), f"the dearest phase is {dearest}; µs by phase: {listed}")


def mapping(effort: Effort) -> Figure:
    """Compare cycles with and without images of all axes; a bus changes the move data of one axis in every cycle.

    All axes move, so that Info of every one changes too.
    """
    changes: dict[str, Any] = {"map": {"M": {"group": "axis"}}}
    mapped, plain = layered_run(changes), layered_run({})
    images = {name: bytearray(mapped.areas[name].size) for name in mapped.areas if name.startswith("MAPPING_AXIS_in.")}
    for run in (mapped, plain):
        for axis in run.axes.values():
            endless(axis, AxisCommand.MOVE_BUFFER_VELO)
    for name, image in images.items():
        image[:] = mapped.areas[name].read()
        mapped.mapping.attach(name, image, written=True)
    data = images["MAPPING_AXIS_in.AxisMoveData"]
    size = len(data) // AXES

    def write() -> None:
        data[mapped.tick % AXES * size] ^= 1  # a bit of rSetPos

    with mapped, plain:
        costs = differences(mapped, plain, effort.samples, write)
    return Figure(statistics.median(costs))


def same_cycle(effort: Effort) -> Figure:
    """Count command changes of the campaign `contract` that State shows in the same cycle."""
    campaign = CAMPAIGNS["contract"]
    cases = max(1, effort.samples // PER_SEQUENCE // campaign.size)
    found = [answers(play(contract(SEED, case))) for case in range(cases)]
    right, count = (sum(column) for column in zip(*found, strict=True))
    return Figure(right / count, f"of {count} changes")


def violations(effort: Effort) -> Figure:
    """Count the cases of the campaign `contract` in which anything is found."""
    campaign = CAMPAIGNS["contract"]
    cases = max(1, effort.samples // PER_SEQUENCE // campaign.size)
    failures = campaign.run(SEED, range(cases))
    first = f"; the first: make campaign NAME=contract SEED={SEED} CASE={failures[0].case}" if failures else ""
    return Figure(float(len(failures)), f"cases of {campaign.size} sequences, {cases * campaign.size} in all{first}")


def _per_call(call: Callable[[int], None], samples: int) -> float:
    """Return the median time of a call, µs, loop included."""
    times = []
    for _ in range(max(3, samples // 20)):
        start = perf_counter_ns()
        for tick in range(BATCH):
            call(tick)
        times.append((perf_counter_ns() - start) / BATCH)
    return statistics.median(times) / 1e3


ROWS: Final = (
    Row("layer.idle_64", MICRO, Goal(5), idle),
    Row("layer.busy_64", MICRO, Goal(150), busy),
    Row("layer.off", MICRO, Goal(0.1), off),
    Row("layer.spread", "ratio", Goal(1.5), spread),
    Row("mapping.axes_64", MICRO, Goal(100), mapping),
    Row("layer.same_cycle", "share", Goal(1, at_least=True), same_cycle),
    Row("layer.contract", "violations", Goal(0), violations),
)
