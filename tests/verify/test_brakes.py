"""How hard a brake brakes: what its message tells, never weaker than the motion before it, else the maxima."""

from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

import pytest

from motionlayer import Machine, Simulation, Trace
from motionlayer.command import ErrorId
from motionlayer.event import Kind
from motionlayer.verify import assert_valid, verify

from .bench import changed

if TYPE_CHECKING:
    from collections.abc import Callable

AXIS: dict[str, Any] = {
    "max_velocity": 500.0, "max_acceleration": 5000.0, "max_deceleration": 8000.0, "max_jerk": 4e5, "velocity": 200.0,
    "acceleration": 2000.0, "deceleration": 3000.0, "jerk": 1e5,
}  # fmt: skip


@cache
def braked(how: str) -> Trace:
    """A motion that is braked in one of several ways."""
    run = Simulation(Machine.from_dict({"format": 1, "name": "m", "axis": {"X": AXIS}}))
    x = run.axes["X"]
    x.enable()
    run.step(3)
    x.move_velocity(200.0, deceleration=2500.0)
    run.step(200)
    ways: dict[str, Callable[[], object]] = {
        "halt": lambda: x.halt(deceleration=6000.0, jerk=2e5),
        "weak": lambda: x.halt(deceleration=1000.0, jerk=1e4),
        "stop": lambda: x.stop(jerk=3e5),
        "emergency": x.emergency_stop,
        "disable": x.disable,
        "error": lambda: x.fault(ErrorId.PARAMETER, "on purpose"),
    }
    ways[how]()
    run.step(300)
    assert run.trace["X.set_velocity"][-1] == 0.0
    assert_valid(run.trace)
    return run.trace


def _messages(trace: Trace) -> str:
    return "; ".join(f"{finding.rule}: {finding.message}" for finding in verify(trace).findings)


@pytest.mark.parametrize(
    ("how", "old", "new", "text"),
    [
        ("halt", "deceleration=6000.0", "deceleration=6001.0", "the deceleration is not what command"),
        ("halt", "jerk=200000.0", "jerk=200001.0", "the jerk is not what command"),
        ("weak", "halt(deceleration=2500.0", "halt(deceleration=1000.0", "the deceleration is not what command"),
        ("stop", "stop(deceleration=2500.0, jerk=300000.0", "stop(", "the jerk is not what command"),
        ("halt", "halt(", "emergency_stop(", "the deceleration is not what command"),
        ("stop", "stop(", "emergency_stop(", "the jerk is not what command"),
    ],
)
def test_a_brake_that_is_not_the_one_asked_for_is_found(how: str, old: str, new: str, text: str) -> None:
    trace = braked(how)
    hits = [event for event in trace.events if event.kind == Kind.ACCEPTED and old in event.text]
    assert len(hits) == 1
    told = hits[0]._replace(text=hits[0].text.replace(old, new))
    assert text in _messages(changed(trace, events=tuple(told if one is hits[0] else one for one in trace.events)))


@pytest.mark.parametrize("limit", ["deceleration", "jerk"])
@pytest.mark.parametrize("how", ["disable", "error"])
def test_a_brake_that_serves_no_command_has_the_maxima(how: str, limit: str) -> None:
    trace = braked(how)
    plans = tuple(
        replace(plan, **{limit: 0.9 * getattr(plan, limit)}) if plan.kind == "stop" else plan for plan in trace.plans
    )
    assert f"the {limit} of a brake that serves no command is not the maximum" in _messages(changed(trace, plans=plans))


@pytest.mark.parametrize("limit", ["deceleration", "jerk"])
def test_no_brake_is_weaker_than_the_motion_it_ends(limit: str) -> None:
    """The motion before it was braked harder than it lets one."""
    trace = braked("weak")
    stop = next(plan for plan in trace.plans if plan.kind == "stop")
    plans = tuple(
        replace(plan, **{limit: 1.01 * getattr(stop, limit)}) if plan.kind == "velocity" else plan
        for plan in trace.plans
    )
    assert f"the {limit} of a brake is weaker" in _messages(changed(trace, plans=plans))
