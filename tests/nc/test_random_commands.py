"""Random commands at random times on three axes, from programs that end, fail or are cancelled.

Whatever is commanded: no jump, no limit exceeded, every accepted command ends exactly once or runs to the end. The acts
are those of the campaign `life`, which draws its machines too; here hypothesis draws, and makes a failure small.
"""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from motionlayer import Machine, Trace
from motionlayer.bench.campaign._acts import CALLS, CHOICES, Act, Part
from motionlayer.bench.campaign._life import Life, live, perform, violations
from tests.effort import examples

AXES: dict[str, dict[str, Any]] = {
    "X": {
        "max_velocity": 500.0,
        "max_acceleration": 5000.0,
        "max_deceleration": 6000.0,
        "max_jerk": 1e5,
        "software_limit_min": -100.0,
        "software_limit_max": 400.0,
        "home": {"mode": "switch", "switch": -20.0, "velocity": 100.0},
    },
    "Y": {
        "unit": "degree",
        "max_velocity": 3600.0,
        "max_acceleration": 40_000.0,
        "max_deceleration": 15_000.0,
        "max_jerk": 2e6,
        "velocity": 720.0,
    },
    "Z": {
        "unit": "µm",
        "max_velocity": 2e4,
        "max_acceleration": 1e5,
        "max_jerk": 4e6,
        "software_limit_min": -500.0,
        "start_position": 1000.0,
    },
}
MACHINE = {"format": 1, "name": "random", "axis": AXES}
DESCRIPTION = Machine.from_dict(MACHINE).description
DISABLED, STANDSTILL, HOMING = 1, 2, 5


FRACTION = st.one_of(st.just(1.0), st.floats(0.02, 1.0), st.sampled_from([0.0, 1.5]))
ACT = st.builds(
    Act,
    ticks=st.one_of(st.just(0), st.integers(0, 150)),
    axis=st.sampled_from("XYZ"),
    call=st.sampled_from([call for call, often in CALLS.items() for _ in range(often)]),
    place=st.one_of(st.floats(-0.1, 1.0), st.sampled_from([0.0, 1.0])),
    fractions=st.tuples(FRACTION, FRACTION, FRACTION, FRACTION),
    awaits=st.booleans(),
    choice=st.integers(0, CHOICES),
)
PART = st.builds(
    Part,
    acts=st.lists(ACT, max_size=12),
    end=st.sampled_from(["ends", "ends", "raises", "cancelled"]),
    cancel_at=st.integers(0, 800),
    stops=st.booleans(),
)


def check_motion(trace: Trace, name: str) -> None:
    """Check p, v, a from tick to tick against the machine's maxima, from the samples alone."""
    axis, dt = DESCRIPTION.axis[name], 0.001
    p, v, a, state = (
        trace[f"{name}.{signal}"] for signal in ("set_position", "set_velocity", "set_acceleration", "state")
    )
    wide = 1.0 + 1e-9
    assert np.all(np.abs(v) <= axis.max_velocity * wide)
    assert np.all(np.abs(a)[v * a > 0.0] <= axis.max_acceleration * wide)
    assert np.all(np.abs(a)[v * a < 0.0] <= axis.max_deceleration * wide)
    jerk = axis.max_jerk * wide
    assert np.all(np.abs(np.diff(a)) <= jerk * dt + 1e-9 * axis.max_acceleration)
    assert np.all(np.abs(np.diff(v) - a[:-1] * dt) <= jerk * dt**2 / 2.0 + 1e-11 * axis.max_velocity)
    off = np.abs(np.diff(p) - (v[:-1] + a[:-1] * dt / 2.0) * dt) > jerk * dt**3 / 6.0 + 1e-12 * (1.0 + np.abs(p[1:]))
    redefined = {plan.tick - 1 for plan in trace.plans if plan.axis == name and plan.kind in ("set", "shift")}
    assert set((np.flatnonzero(off)).tolist()) <= redefined
    assert np.all(v[np.isin(state, (DISABLED, STANDSTILL))] == 0.0)
    assert np.array_equal(p, trace[f"{name}.actual_position"])


def check_software_limits(trace: Trace, name: str) -> None:
    """No tick is outside, unless the axis was homed: then it may have been given a place outside."""
    axis = DESCRIPTION.axis[name]
    p = trace[f"{name}.set_position"]
    homing = trace[f"{name}.state"] == HOMING
    redefined = any(plan.axis == name and plan.kind in ("set", "shift") and plan.target != p[0] for plan in trace.plans)
    if not homing.any() and not redefined:
        low = -math.inf if axis.software_limit_min is None else axis.software_limit_min
        high = math.inf if axis.software_limit_max is None else axis.software_limit_max
        assert np.all((p >= low - 1e-9) & (p <= high + 1e-9))


def check_order(trace: Trace) -> None:
    """No event is older than the one before it."""
    assert all(first.tick <= second.tick for first, second in pairwise(trace.events))


def check_rest_at_redefinitions(trace: Trace, name: str) -> None:
    """A coordinate is redefined at rest only; it may be shifted in motion."""
    for plan in trace.plans:
        if plan.axis == name and plan.kind == "set" and plan.tick < len(trace.ticks):
            assert trace[f"{name}.set_velocity"][plan.tick] == 0.0
            assert trace[f"{name}.set_acceleration"][plan.tick] == 0.0


def check(parts: list[Part]) -> None:
    trace, commands = live(Life(MACHINE, parts))
    for name in AXES:
        check_motion(trace, name)
        check_software_limits(trace, name)
        check_rest_at_redefinitions(trace, name)
    check_order(trace)
    assert violations(trace, commands) == []


@settings(max_examples=examples(60), deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.lists(PART, min_size=1, max_size=4))
def test_random_commands(parts: list[Part]) -> None:
    check(parts)


@pytest.mark.slow
@settings(max_examples=300, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.lists(PART, min_size=1, max_size=4))
def test_many_random_commands(parts: list[Part]) -> None:
    check(parts)


@settings(max_examples=examples(10), deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.lists(PART, min_size=2, max_size=3))
def test_the_same_commands_give_the_same_hash_with_and_without_a_trace(parts: list[Part]) -> None:
    hashes = [perform(Life(MACHINE, parts), trace=trace)[0].close() for trace in (True, True, False)]
    assert hashes[0]
    assert len(set(hashes)) == 1
