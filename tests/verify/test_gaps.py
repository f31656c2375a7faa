"""A trace with gaps, as a recorder in real time leaves them, is judged before and after each of them."""

from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from motionlayer import Machine, Simulation
from motionlayer.record import Gap, Plan, Trace, TraceWriter
from motionlayer.verify import assert_valid, verify

LIMITS = {"max_velocity": 1000.0, "max_acceleration": 8000.0, "max_jerk": 1e5}
GAPS = (Gap(120, 30, 0), Gap(151, 200, 0), Gap(700, 1, 0))
"""One in a motion, one right behind it, one of a single row."""


@cache
def pendulum() -> Trace:
    machine = Machine.from_dict({"format": 1, "name": "two", "axis": {"X": LIMITS, "Y": LIMITS}})
    with Simulation(machine) as run:

        async def program(name: str, way: float) -> None:
            await run.axes[name].enable()
            for target in (way, -way, 0.0):
                await run.axes[name].move_absolute(target)

        run.start(program("X", 100.0))
        run.run(program("Y", 33.0))
    return run.trace


def without(trace: Trace, gaps: tuple[Gap, ...], plans: tuple[Plan, ...] | None = None) -> Trace:
    """Return a trace without the rows of the gaps, and with other plans."""
    writer = TraceWriter(None, trace.header)
    for plan in trace.plans if plans is None else plans:
        writer.plan(plan)
    for event in trace.events:
        writer.event(event)
    edges = [0, *(edge for gap in gaps for edge in (gap.first, gap.first + gap.ticks)), len(trace.ticks)]
    for start, end in list(pairwise(edges))[::2]:
        writer.rows(start, np.array([trace[name][start:end] for name in trace]).T)
    for gap in gaps:
        writer.gap(gap)
    writer.close(len(trace.ticks) - sum(gap.ticks for gap in gaps), "")
    return Trace.from_chunks(writer.chunks)


@pytest.mark.parametrize("gaps", [GAPS[:1], GAPS[1:2], GAPS])
def test_a_good_trace_with_gaps_is_valid_in_part(gaps: tuple[Gap, ...]) -> None:
    trace = without(pendulum(), gaps)
    report = verify(trace)
    assert report.ok, str(report)
    assert not report.complete
    assert [note.split(" are missing")[0] for note in report.notes if "missing" in note] == [
        f"{gap.ticks} rows from tick {gap.first} on" for gap in gaps
    ]
    assert_valid(trace, partial=True)
    with pytest.raises(AssertionError, match="INCOMPLETE"):
        assert_valid(trace)


@pytest.mark.parametrize("row", [100, 119, 120, 400])
def test_what_is_wrong_on_either_side_of_a_gap_is_found(row: int) -> None:
    trace = without(pendulum(), GAPS)
    values = trace["X.set_position"].copy()
    values[row] += 1e-3
    report = verify(trace.replace({"X.set_position": values}))
    assert int(trace.ticks[row]) in {finding.tick for finding in report.findings}


def test_what_is_wrong_with_a_plan_is_found_once() -> None:
    whole = pendulum()
    wrong = tuple(replace(plan, velocity=2000.0) if plan.kind == "position" else plan for plan in whole.plans)
    found = verify(without(whole, GAPS, wrong)).findings
    assert found
    assert len(set(found)) == len(found)


def test_missing_records_are_no_basis_for_a_judgement() -> None:
    report = verify(without(pendulum(), (Gap(120, 30, 2),)))
    assert report.refused == ("2 plans, events or inputs are missing, because the writer of the trace did not keep up",)


def test_a_gap_of_another_size_than_the_jump_explains_nothing() -> None:
    trace = without(pendulum(), GAPS[:1])
    trace.gaps = (Gap(120, 29, 0),)
    assert verify(trace).refused == ("the ticks have 1 gaps that nothing explains, the first one after tick 119",)
