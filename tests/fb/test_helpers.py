"""Blocks that only compute."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.fb import MC_CalcDynamicsByRampTime, MC_OverrideFilter


class Clock:
    """A clock that the test moves on."""

    time = 0.0


def test_a_step_holds_for_its_time_and_the_ends_pass_at_once() -> None:
    clock = Clock()
    knob = MC_OverrideFilter(clock)
    shown = []
    for raw in (16384, 20000, 20000, 32767, 20000, 0):
        knob(OverrideValueRaw=raw, OverrideRecoveryTime=0.02)
        shown.append(knob.OverridePercentFiltered)
        clock.time += 0.01
    assert shown == [50.0, 50.0, 61.0, 100.0, 100.0, 0.0]
    assert knob.OverrideValueFiltered == 0


@given(st.integers(-(2**31), 2**31 - 1), st.integers(2, 1000))
def test_the_filtered_value_is_a_step_near_the_raw_one(raw: int, steps: int) -> None:
    knob = MC_OverrideFilter(Clock())
    knob(OverrideValueRaw=raw, OverrideSteps=steps)
    share = min(max(raw / 32767, 0.0), 1.0)
    assert abs(knob.OverridePercentFiltered / 100.0 - share) <= 0.5 / steps + 1e-6


@pytest.mark.parametrize("inputs", [{"OverrideSteps": 1}, {"LowerOverrideThreshold": 5, "UpperOverrideThreshold": 5}])
def test_thresholds_and_steps_that_make_no_sense(inputs: dict[str, int]) -> None:
    knob = MC_OverrideFilter(Clock())
    knob(OverrideValueRaw=100, **inputs)
    assert (knob.Error, knob.ErrorID) == (True, 0x4B06)
    knob(OverrideValueRaw=32767, OverrideSteps=10, LowerOverrideThreshold=0, UpperOverrideThreshold=32767)
    assert (knob.Error, knob.OverridePercentFiltered) == (False, 100.0)


@given(st.floats(1e-3, 1e6), st.floats(1e-3, 1e3), st.floats(0.0, 0.99))
def test_the_ramp_takes_its_time_and_reaches_its_velocity(v: float, t: float, c: float) -> None:
    block = MC_CalcDynamicsByRampTime()
    block(Velocity=v, RampTime=t, Stiffness=c)
    a, j = block.Acceleration, block.Jerk
    jerking = a / j
    constant = t - 2.0 * jerking
    assert constant == pytest.approx(t * c / (2.0 - c), abs=1e-9 * t)
    assert a * jerking + a * constant == pytest.approx(v), "the area of the trapezoid of accelerations"
    assert block.Deceleration == a


@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, math.inf])
@pytest.mark.parametrize("name", ["Velocity", "RampTime", "Stiffness"])
def test_bad_ramps_give_an_error_and_no_dynamics(name: str, bad: float) -> None:
    block = MC_CalcDynamicsByRampTime()
    good = {"Velocity": 100.0, "RampTime": 0.1, "Stiffness": 0.5}
    block(**good)
    block(**(good | {name: bad}))
    assert (block.Error, block.ErrorID) == ((False, 0) if name == "Stiffness" and bad == 0.0 else (True, 0x4B06))
    assert (block.Acceleration == 0.0) is block.Error
