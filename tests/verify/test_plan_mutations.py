"""A plan that was tampered with is noticed."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.record import Plan, Trace
from motionlayer.verify import verify
from tests.effort import examples, thinned

from .bench import changed
from .scenarios import recorded

LIMITS = ("velocity", "acceleration", "deceleration", "jerk")


def _with_plan(trace: Trace, index: int, plan: Plan) -> Trace:
    return changed(trace, plans=(*trace.plans[:index], plan, *trace.plans[index + 1 :]))


def _rules(trace: Trace) -> set[str]:
    return {finding.rule for finding in verify(trace).findings}


@pytest.mark.parametrize("limit", LIMITS)
@pytest.mark.parametrize("factor", [0.5, 1.0 - 1e-12, 1.0 + 1e-12, 2.0])
@pytest.mark.parametrize("index", thinned(range(12), 3))
def test_a_changed_limit_is_found(limit: str, factor: float, index: int) -> None:
    trace = recorded("mm")
    plan = trace.plans[index]
    assert _rules(_with_plan(trace, index, replace(plan, **{limit: factor * getattr(plan, limit)})))


@pytest.mark.parametrize("index", range(1, 12))
def test_a_missing_plan_is_found(index: int) -> None:
    trace = recorded("mm")
    report = verify(changed(trace, plans=trace.plans[:index] + trace.plans[index + 1 :]))
    assert report.findings


def test_a_doubled_plan_is_found() -> None:
    trace = recorded("mm")
    assert _rules(changed(trace, plans=(*trace.plans[:3], *trace.plans[2:]))) == {"plan order"}


@given(st.data())
@settings(max_examples=examples(60), deadline=None)
def test_a_missing_piece_is_found(data: st.DataObject) -> None:
    trace = recorded("mm")
    index = data.draw(st.sampled_from([i for i, plan in enumerate(trace.plans) if len(plan.pieces) > 1]))
    plan = trace.plans[index]
    # Nobody misses a piece that goes on with the jerk of the one before it.
    differs = np.diff(plan.pieces[:, 4], prepend=np.nan) != 0.0
    piece = data.draw(st.sampled_from(np.flatnonzero(differs).tolist()))
    without = replace(plan, pieces=np.delete(plan.pieces, piece, axis=0))
    assert verify(_with_plan(trace, index, without)).findings


@given(st.data())
@settings(max_examples=examples(100), deadline=None)
def test_a_changed_number_of_a_piece_is_found(data: st.DataObject) -> None:
    trace = recorded("mm")
    index = data.draw(st.integers(0, len(trace.plans) - 1))
    plan = trace.plans[index]
    pieces = plan.pieces.copy()
    lasting = np.append(np.diff(pieces[:, 0]), 1.0) > 1e-6  # in less, no jerk does anything
    row = data.draw(st.sampled_from(np.flatnonzero(lasting).tolist()))
    column = data.draw(st.integers(0, 4))
    pieces[row, column] += data.draw(st.sampled_from([-1.0, 1.0])) * (1e-5, 1e-5, 1e-4, 1e-2, 10.0)[column]
    assert verify(_with_plan(trace, index, replace(plan, pieces=pieces))).findings


def _with_nan(plan: Plan) -> Plan:
    return replace(plan, pieces=np.where(plan.pieces == 0.0, math.nan, plan.pieces))


MALFORMED: list[tuple[Callable[[Plan], Plan], str]] = [
    (_with_nan, "a piece is not finite"),
    (lambda plan: replace(plan, jerk=math.inf), "not finite"),
    (lambda plan: replace(plan, target=math.nan), "target nan does not fit kind position"),
    (lambda plan: replace(plan, kind="stop"), "does not fit kind stop"),
    (lambda plan: replace(plan, pieces=plan.pieces[::-1]), "times of the pieces do not increase"),
]


@pytest.mark.parametrize(("mutate", "text"), MALFORMED)
def test_a_malformed_plan_is_found(mutate: Callable[[Plan], Plan], text: str) -> None:
    trace = recorded("mm")
    report = verify(_with_plan(trace, 1, mutate(trace.plans[1])))
    assert [finding.rule for finding in report.findings] == ["plan"]
    assert text in report.findings[0].message


MUTANTS: list[tuple[int, Callable[[Plan], Plan], str]] = [
    (0, lambda plan: replace(plan, kind="position"), "plan order"),
    (1, lambda plan: replace(plan, offset=-0.002), "plan order"),
    (1, lambda plan: replace(plan, target=plan.target + 1e-6), "plan end"),
    (1, lambda plan: replace(plan, tick=plan.tick + 1), "set value"),
    (1, lambda plan: replace(plan, offset=0.001), "plan continuity"),
    (2, lambda plan: replace(plan, command=plan.command + 1), "command plan"),
    (2, lambda plan: replace(plan, command=99), "command plan"),
    (4, lambda plan: replace(plan, target=plan.target + 1e-6), "plan end"),
    (4, lambda plan: replace(plan, kind="position"), "plan end"),
    (10, lambda plan: replace(plan, kind="position"), "plan end"),
    (4, lambda plan: replace(plan, kind="stop", target=math.nan), "planned stop"),
    (7, lambda plan: replace(plan, kind="position"), "plan continuity"),
]


@pytest.mark.parametrize(("index", "mutate", "rule"), MUTANTS)
def test_a_changed_plan_breaks_its_rule(index: int, mutate: Callable[[Plan], Plan], rule: str) -> None:
    trace = recorded("mm")
    assert rule in _rules(_with_plan(trace, index, mutate(trace.plans[index])))
