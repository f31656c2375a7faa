"""Where motions hand over that override 0 has carried past their joint: what is allowed there, and nothing else."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from motionlayer import Trace
from motionlayer.event import Kind
from motionlayer.nc import BufferMode
from motionlayer.record import Plan
from motionlayer.verify import assert_valid, verify
from tests.machines import finish, ready

from .bench import changed

RULE = "command 2 leads to another place than it asked for"


@cache
def carried(ticks: int) -> Trace:
    """Two blended moves with a joint at 200; a hold that begins 1 mm before it lasts for some ticks."""
    run, x = ready()
    x.move_absolute(200.0, velocity=400.0)
    x.move_absolute(350.0, velocity=300.0, buffer_mode=BufferMode.BLENDING_PREVIOUS)
    finish(run, x.passes(199.0))
    x.set_override(0.0)
    run.step(ticks)
    x.set_override(1.0)
    run.step(1500)
    assert_valid(run.trace)
    return run.trace


def _accuses(trace: Trace, plan: Plan) -> bool:
    """Tell whether a plan is said to lead to a wrong place."""
    return any(RULE in finding.message and finding.tick == plan.tick for finding in verify(trace).findings)


def _told(trace: Trace, old: str, new: str) -> Trace:
    texts = tuple(one._replace(text=one.text.replace(old, new)) for one in trace.events)
    assert texts != tuple(trace.events)
    return changed(trace, events=texts)


def _released(trace: Trace) -> Plan:
    """Return the plan with which the held motion went on."""
    held = next(plan for plan in trace.plans if plan.kind == "stop")
    return next(plan for plan in trace.plans if plan.tick > held.tick)


@pytest.mark.parametrize("ticks", [20, 60, 119])
def test_a_joint_ahead_is_not_left_out(ticks: int) -> None:
    """Had the joint been behind the place where the follower took over, it could have been met."""
    trace = carried(ticks)
    end = _released(trace).target
    assert _accuses(_told(trace, "position=200.0", f"position={end + 0.01}"), _released(trace))
    assert not _accuses(_told(trace, "position=200.0", f"position={end - 0.01}"), _released(trace))


@pytest.mark.parametrize("ticks", [20, 60, 119])
@pytest.mark.parametrize("off", [-1e-6, 1e-6])
def test_it_hands_over_where_the_acceleration_is_taken_back_and_nowhere_else(ticks: int, off: float) -> None:
    trace = carried(ticks)
    released = _released(trace)
    pieces = np.array(released.pieces)
    pieces[-1, 1] += off
    other = replace(released, pieces=pieces, target=released.target + off)
    plans = tuple(other if plan is released else plan for plan in trace.plans)
    assert _accuses(changed(trace, plans=plans), released)


def test_what_no_override_has_held_leads_to_its_joint() -> None:
    trace = carried(60)
    held = next(plan for plan in trace.plans if plan.kind == "stop")
    free = changed(trace, plans=tuple(plan for plan in trace.plans if plan is not held))
    assert _accuses(free, _released(trace))


def test_a_motion_that_nobody_waits_for_leads_to_its_target() -> None:
    trace = carried(60)
    alone = tuple(one for one in trace.events if one.command != 3 or one.kind != Kind.ACCEPTED)
    assert _accuses(changed(trace, events=alone), _released(trace))
