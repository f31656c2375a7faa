"""Servo drives: what `verify` says about their lag and their encoder."""

import copy

import numpy as np
import pytest

from motionlayer import Fault, Trace
from motionlayer.verify import assert_valid, verify
from tests.machines import finish
from tests.nc.servos import ready_servos

from .bench import Bench, changed

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


def displaced(trace: Trace, where: slice, by: float) -> Trace:
    """Move the actual position, and the lag with it."""
    actual, lag = trace["X.actual_position"].copy(), trace["X.lag"].copy()
    actual[where] += by
    lag[where] -= by
    return trace.replace({"X.actual_position": actual, "X.lag": lag})


@pytest.mark.parametrize("rows", [5, 10, 11, 60])
def test_a_lag_above_the_limit_for_longer_than_the_filter_time_is_found(trace: Trace, rows: int) -> None:
    """The filter time is 10 rows; the error shows in the next one."""
    damaged = displaced(trace, slice(300, 300 + rows), -1000 * STEP)
    assert rules(damaged) == ({"lag"} if rows > 10 else set())


@pytest.mark.parametrize("row", [50, 300, 700])
def test_a_lag_that_is_not_set_minus_actual_is_found(trace: Trace, row: int) -> None:
    lag = trace["X.lag"].copy()
    lag[row] += 1e-9
    found = verify(trace.replace({"X.lag": lag})).findings
    assert [(finding.rule, finding.tick) for finding in found] == [("lag", row)]


def test_a_position_between_the_steps_of_the_encoder_is_found(trace: Trace) -> None:
    for row in (50, 300, len(trace.ticks) - 1):
        assert rules(displaced(trace, slice(row, row + 1), 0.3 * STEP)) == {"encoder"}


def test_an_axis_in_error_may_be_anywhere(trace: Trace) -> None:
    error = trace["X.state"] == 3.0
    assert error.sum() > 100
    assert rules(displaced(trace, slice(int(np.flatnonzero(error)[50]), None), 5000 * STEP)) == set()


@pytest.mark.parametrize(("window", "late"), [(0.5, 0), (0.05, 0), (0.05, 4), (0.05, 20)])
def test_a_positioning_is_done_in_its_window_only(window: float, late: int) -> None:
    """A window that is narrower than the recorded one, and an arrival before its time, are found."""
    monitor = {"target_window": 0.5, "target_time": 0.01}
    run, (x,) = ready_servos(monitor=monitor)
    finish(run, x.move_absolute(50.0))
    trace = run.trace
    assert_valid(trace)
    header = copy.deepcopy(trace.header)
    header["machine"]["axis"]["X"]["monitor"]["target_window"] = window
    header["machine"]["axis"]["X"]["monitor"]["target_time"] += late * trace.base_cycle
    found = {finding.rule for finding in verify(changed(trace, header=header)).findings}
    assert found == (set() if (window, late) == (0.5, 0) else {"done"})


def test_an_ideal_drive_without_power_stays_where_it_is() -> None:
    bench = Bench()
    bench.run(5)
    trace = bench.trace()
    actual = trace["X.actual_position"].copy()
    actual[3:] += 1.0
    assert rules(trace.replace({"X.actual_position": actual})) == {"actual position"}
