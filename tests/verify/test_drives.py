"""Servo drives: what `verify` says about their lag and their encoder."""

import numpy as np
import pytest

from motionlayer import Fault, Trace
from motionlayer.verify import verify
from tests.machines import finish
from tests.nc.servos import ready_servos

STEP = 0.01


@pytest.fixture(scope="module")
def trace() -> Trace:
    """A run in which the lag of about 10 mm is allowed, and a lost communication in which it is not known."""
    monitor = {"lag": 11.0, "lag_time": 0.01}
    run, (x,) = ready_servos(monitor=monitor, drive={"encoder_resolution": STEP}, home={"position": 5.0})
    finish(run, x.home())
    finish(run, x.move_absolute(200.0))
    run.inject("X", Fault("lost_communication", duration=0.05), tick=900)
    x.move_absolute(0.0)
    run.step(1500)
    assert x.error is not None
    return run.trace


def rules(trace: Trace) -> set[str]:
    return {finding.rule for finding in verify(trace).findings}


def test_the_trace_is_valid(trace: Trace) -> None:
    report = verify(trace)
    assert report.ok
    assert report.notes == ()


@pytest.mark.parametrize("rows", [5, 14, 16, 60])
def test_a_lag_above_the_limit_for_longer_than_the_filter_time_is_found(trace: Trace, rows: int) -> None:
    """The filter time is 10 rows, the tick of the error one more, and 4 are forgiven for lost communication."""
    actual = trace["X.actual_position"].copy()
    actual[300 : 300 + rows] -= 1000 * STEP
    assert rules(trace.replace({"X.actual_position": actual})) == ({"lag"} if rows > 15 else set())


def test_a_position_between_the_steps_of_the_encoder_is_found(trace: Trace) -> None:
    for row in (50, 300, len(trace.ticks) - 1):
        actual = trace["X.actual_position"].copy()
        actual[row] += 0.3 * STEP
        assert rules(trace.replace({"X.actual_position": actual})) == {"encoder"}


def test_an_axis_in_error_may_be_anywhere(trace: Trace) -> None:
    error = trace["X.state"] == 3.0
    assert error.sum() > 100
    actual = trace["X.actual_position"].copy()
    actual[np.flatnonzero(error)[50] :] += 5000 * STEP
    assert rules(trace.replace({"X.actual_position": actual})) == set()
