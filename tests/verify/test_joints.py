"""The speed at which motions hand over: that of the buffer mode, or the nearest that can be had."""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from motionlayer import Machine, Simulation, Trace
from motionlayer.event import Kind
from motionlayer.nc import BufferMode
from motionlayer.verify import assert_valid, verify

from .bench import changed

AXIS: dict[str, Any] = {"max_velocity": 500.0, "max_acceleration": 5000.0, "max_jerk": 1e5, "velocity": 200.0}
RULE = "takes over at another speed than it asked for"


@cache
def blended(mode: BufferMode, first: float = 60.0, target: float = 400.0) -> Trace:
    """A move with 150 mm/s, and one behind it with 100 mm/s."""
    run = Simulation(Machine.from_dict({"format": 1, "name": "m", "axis": {"X": AXIS}}))
    x = run.axes["X"]
    x.enable()
    run.step(3)
    x.set_override(0.8)
    x.move_absolute(first, velocity=150.0)
    run.step(30)
    x.move_absolute(target, velocity=100.0, buffer_mode=mode)
    run.step(1500)
    assert_valid(run.trace)
    return run.trace


def _messages(trace: Trace) -> str:
    return "; ".join(f"{finding.rule}: {finding.message}" for finding in verify(trace).findings)


def _told(trace: Trace, old: str, new: str) -> Trace:
    hits = [event for event in trace.events if event.kind == Kind.ACCEPTED and old in event.text]
    assert len(hits) == 1
    told = hits[0]._replace(text=hits[0].text.replace(old, new))
    return changed(trace, events=tuple(told if one is hits[0] else one for one in trace.events))


def joint(trace: Trace) -> float:
    """Return the speed at which the plan that passes its target does so."""
    return next(float(plan.pieces[-1, 2]) for plan in trace.plans if plan.kind == "passing")


@pytest.mark.parametrize(
    ("mode", "speed", "others"),
    [
        (BufferMode.BLENDING_LOW, 80.0, ("PREVIOUS", "HIGH")),
        (BufferMode.BLENDING_NEXT, 80.0, ("PREVIOUS", "HIGH")),
        (BufferMode.BLENDING_PREVIOUS, 120.0, ("LOW", "NEXT")),
        (BufferMode.BLENDING_HIGH, 120.0, ("LOW", "NEXT")),
    ],
)
def test_a_joint_with_the_speed_of_another_mode_is_found(
    mode: BufferMode, speed: float, others: tuple[str, str]
) -> None:
    trace = blended(mode)
    assert joint(trace) == pytest.approx(speed, rel=1e-9)
    for other in others:
        assert RULE in _messages(_told(trace, f"buffer_mode={mode.name}", f"buffer_mode=BLENDING_{other}"))


def test_a_joint_where_the_next_one_ends_soon_is_as_fast_as_it_can_brake() -> None:
    """It is slower than the mode says, and that is right: the next one brakes from the joint on."""
    trace = blended(BufferMode.BLENDING_LOW, target=60.5)
    assert 5.0 < joint(trace) < 79.0
    lazy = _next(trace, [(0.0, 0.0), (0.01, -1.0)])  # cruises for a while: it could have come faster
    assert RULE in _messages(lazy)


def test_a_joint_that_is_near_is_as_fast_as_the_axis_can_become() -> None:
    """It is slower than the mode says, and that is right: the one before it gains speed up to the joint."""
    trace = blended(BufferMode.BLENDING_HIGH, first=3.0)
    assert 5.0 < joint(trace) < 119.0


def _next(trace: Trace, shape: list[tuple[float, float]]) -> Trace:
    """Return the trace with other pieces of the plan behind the joint: times in s, and shares of the jerk limit."""
    index = next(k for k, plan in enumerate(trace.plans) if plan.kind == "passing") + 1
    plan = trace.plans[index]
    _, p, v, a, _ = plan.pieces[0].tolist()
    rows: list[list[float]] = []
    last = 0.0
    for begin, share in shape:
        jerk, t = rows[-1][4] if rows else 0.0, begin - last
        p, v, a = p + t * (v + t * (a / 2 + t * jerk / 6)), v + t * (a + t * jerk / 2), a + t * jerk
        rows.append([begin, p, v, a, share * plan.jerk])
        last = begin
    plans = (*trace.plans[:index], replace(plan, pieces=np.array(rows)), *trace.plans[index + 1 :])
    return changed(trace, plans=plans)
