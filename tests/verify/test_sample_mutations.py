"""One sample changed by more than ten times its tolerance is noticed, at any tick."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.record import Trace
from motionlayer.verify import assert_valid, tolerance, verify
from tests.effort import examples

from .bench import SIGNALS
from .scenarios import SIZES, axis, quantised, recorded

EXACT = {"lag", "state", "override", "enable", "ready"}  # of an ideal drive
NUMBERS = [signal for signal in SIGNALS if signal not in {*EXACT, "software_limit_max"}]
FACTORS = st.floats(1.001, 6.0).map(lambda power: 10.0**power)


def _is_found(trace: Trace, signal: str, where: float, factor: float) -> bool:
    """Whether a sample, changed by `factor` times its tolerance, is found at its tick."""
    name = f"X.{signal}"
    row = round(where * (len(trace.ticks) - 1))
    values = trace[name].copy()
    values[row] += factor * tolerance(trace, name)[row]
    return row in {finding.tick for finding in verify(trace.replace({name: values})).findings}


@settings(max_examples=examples(400), deadline=None)
@given(
    st.sampled_from(sorted(SIZES)),
    st.sampled_from(NUMBERS),
    st.one_of(st.sampled_from([0.0, 1.0]), st.floats(0.0, 1.0)),
    FACTORS,
    st.sampled_from([1.0, -1.0]),
)
def test_a_changed_sample_is_found(size: str, signal: str, where: float, factor: float, sign: float) -> None:
    assert _is_found(recorded(size), signal, where, sign * factor)


@settings(max_examples=examples(100), deadline=None)
@given(st.sampled_from(NUMBERS), st.floats(0.0, 1.0), FACTORS, st.sampled_from([1.0, -1.0]))
def test_a_changed_sample_is_found_in_quantised_signals(signal: str, where: float, factor: float, sign: float) -> None:
    assert _is_found(quantised(), signal, where, sign * factor)


@pytest.mark.parametrize("signal", SIGNALS)
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_sample_that_is_no_number_is_found(signal: str, value: float) -> None:
    trace = recorded("mm")
    values = trace[f"X.{signal}"].copy()
    if values[7] == value:
        value = 0.0
    values[7] = value
    findings = verify(trace.replace({f"X.{signal}": values})).findings
    assert findings
    assert 7 in {finding.tick for finding in findings}


@pytest.mark.parametrize("override", [-0.01, 1.01])
def test_an_override_beyond_its_range_is_found(override: float) -> None:
    trace = recorded("mm")
    values = trace["X.override"].copy()
    values[50] = override
    report = verify(trace.replace({"X.override": values}))
    assert {(finding.rule, finding.tick) for finding in report.findings} >= {("override", 50)}
    assert {finding.rule for finding in report.findings} == {"override"}


@pytest.mark.parametrize("size", SIZES)
def test_tolerances_are_tight_and_scale_with_the_axis(size: str) -> None:
    trace, maximum = recorded(size), recorded(size).header["machine"]["axis"]["X"]
    largest = np.abs(trace["X.set_position"]).max() + maximum["max_velocity"]
    assert tolerance(trace, "X.set_position").max() < 1e-14 * largest
    assert tolerance(trace, "X.set_velocity").max() < 1e-13 * maximum["max_velocity"]
    assert tolerance(trace, "X.set_acceleration").max() < 1e-13 * maximum["max_deceleration"]
    assert tolerance(trace, "X.set_jerk").max() < 1e-10 * maximum["max_jerk"]
    assert all(tolerance(trace, f"X.{signal}").min() > 0.0 for signal in NUMBERS)


def test_a_trace_of_other_units_has_the_same_relative_tolerance() -> None:
    mm, micro = recorded("mm"), recorded("µm")
    for signal in NUMBERS:
        ratio = tolerance(micro, f"X.{signal}") / tolerance(mm, f"X.{signal}")
        np.testing.assert_allclose(ratio, 1e3, rtol=1e-6)


def test_tolerance_of_an_unknown_signal() -> None:
    with pytest.raises(KeyError, match=r"X\.colour"):
        tolerance(recorded("mm"), "X.colour")


@pytest.mark.slow
@pytest.mark.parametrize("signal", NUMBERS)
def test_every_tick_of_a_short_run(signal: str) -> None:
    bench = axis("mm")
    bench.enable()
    bench.move(2.0)
    bench.run()
    bench.run(2)
    trace = bench.trace()
    assert_valid(trace)
    name = f"X.{signal}"
    allowed = tolerance(trace, name)
    for row in range(len(trace.ticks)):
        for factor in (-10.1, 10.1):
            values = trace[name].copy()
            values[row] += factor * allowed[row]
            assert not verify(trace.replace({name: values})).ok, (row, factor)
