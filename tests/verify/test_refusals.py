"""What cannot be resolved is refused, with the reason; the report says what was judged."""

import copy
from dataclasses import replace

import numpy as np
import pytest

from motionlayer import Machine, Simulation
from motionlayer.record import Trace, TraceWriter
from motionlayer.verify import TOLERANCES, assert_valid, verify

from .bench import Bench, changed, join
from .scenarios import axis, recorded


def _without(trace: Trace, *names: str) -> Trace:
    signals = tuple(signal for signal in trace.signals if signal.name not in names)
    columns = {signal.name: signal for signal in signals}
    return changed(trace, signals=signals, _columns=columns)


@pytest.mark.parametrize("signal", ["set_position", "set_velocity", "set_acceleration"])
def test_an_axis_without_its_set_values_is_refused(signal: str) -> None:
    report = verify(_without(recorded("mm"), f"X.{signal}"))
    assert not report.ok
    assert not report.findings
    assert report.refused == (f"X: not recorded: {signal}; add them to the signals of the trace",)


def test_other_signals_may_be_missing_and_are_named() -> None:
    report = verify(_without(recorded("mm"), "X.state", "X.override", "X.max_jerk", "X.actual_position"))
    assert report.ok
    assert report.notes == ("X: not recorded, hence not judged: actual_position, max_jerk, state, override",)


def test_only_the_axis_concerned_is_refused() -> None:
    x, y = axis("mm"), axis("mm", name="Y")
    x.run(5)
    y.run(5)
    report = verify(_without(join([x, y]), "Y.set_position"))
    assert report.axes == ("X",)
    assert len(report.refused) == 1


@pytest.mark.parametrize("steps", [{"set_position": 0.2}, {"set_velocity": 2.0}, {"set_acceleration": 30.0}], ids=str)
def test_a_resolution_that_hides_the_limits_is_refused(steps: dict[str, float]) -> None:
    bench = axis("mm")
    bench.enable()
    bench.move(5.0)
    bench.run()
    report = verify(bench.trace(**steps))
    assert not report.findings
    assert "hides what the limits in force allow" in report.refused[0]


def test_a_gap_is_refused() -> None:
    bench = Bench()
    bench.run(10)
    trace = bench.trace()
    ticks = trace.ticks.copy()
    ticks[4:] += 3
    report = verify(changed(trace, ticks=ticks))
    assert report.refused == ("the ticks have 1 gaps that nothing explains, the first one after tick 3",)


def test_missing_plans_are_refused() -> None:
    trace = recorded("mm")
    assert verify(changed(trace, plans=())).refused == ("X: the trace holds no plan of the axis",)
    assert verify(changed(trace, plans=trace.plans[1:])).refused == ("X: no plan covers tick 0, the first row",)


@pytest.mark.parametrize(
    ("field", "value", "reason"),
    [("format", 2, "format 2 of the trace"), ("machine", {}, "the header describes no axis")],
)
def test_a_foreign_header_is_refused(field: str, value: object, reason: str) -> None:
    trace = recorded("mm")
    report = verify(changed(trace, header={**trace.header, field: value}))
    assert reason in report.refused[0]


def test_an_empty_trace_is_refused() -> None:
    bench = Bench()
    header = {"base_cycle_ns": 1_000_000, "machine": {"axis": {"X": bench.description()}}, "signals": []}
    writer = TraceWriter(None, header)
    assert verify(Trace.from_chunks(writer.chunks)).refused == ("the trace has no rows",)


def test_a_drive_with_dynamics_is_left_to_others() -> None:
    trace = recorded("mm")
    header = copy.deepcopy(trace.header)
    header["machine"]["axis"]["X"]["drive"] = {"kind": "servo", "dead_time": 0.0}
    # Once it has power, which it gets in row 1 where it stands.
    behind = np.where(trace.ticks > 1, 0.1, 0.0)
    lagging = trace.replace({"X.actual_position": trace["X.actual_position"] - behind, "X.lag": behind})
    assert verify(lagging).findings
    report = verify(changed(lagging, header=header))
    assert report.ok
    assert report.notes == ("X: the lag of the servo drive is not judged, its monitor has no limit for it",)


def test_the_report_reads_well() -> None:
    trace = recorded("mm")
    values = trace["X.set_position"].copy()
    values[100] += 0.5
    bad = trace.replace({"X.set_position": values})
    lines = str(verify(bad)).splitlines()
    assert lines[0].startswith("NOT VALID: 1 axes (X), 1073 ticks, 12 plans, 11 commands; ")
    assert lines[1].startswith("  X at tick 100 (0.100000 s): set value: set_position is not what the plan says: ")
    assert lines[1].endswith(" mm")
    assert str(verify(trace)) == "valid: 1 axes (X), 1073 ticks, 12 plans, 11 commands; 0 findings, 0 refusals"
    with pytest.raises(AssertionError, match="X at tick 100"):
        assert_valid(bad)


def test_findings_of_one_rule_are_not_endless() -> None:
    trace = recorded("mm")
    values = trace["X.max_velocity"].copy()
    values[::2] += 1.0
    findings = verify(trace.replace({"X.max_velocity": values})).findings
    assert len(findings) == 11
    assert findings[-1].message == f"and {(len(values) + 1) // 2 - 10} times more"


def test_every_tolerance_is_documented() -> None:
    assert all(line.doc and line.of and line.relative > 0.0 for line in TOLERANCES.values())


def test_the_stored_hash_is_not_looked_at() -> None:
    assert_valid(changed(recorded("mm"), hash="something else"))


def test_a_plan_of_another_axis_changes_nothing() -> None:
    trace = recorded("mm")
    other = replace(trace.plans[1], axis="Z", pieces=np.ones((1, 5)))
    assert_valid(changed(trace, plans=(*trace.plans, other)))


def test_the_trace_of_a_control_side_names_the_one_to_be_judged() -> None:
    described = Machine.from_dict({"format": 1, "name": "c", "control": {"axes": ["X"]}})
    with Simulation(described) as run:
        run.step(3)
        trace = run.trace
    (reason,) = verify(trace).refused
    assert reason.startswith(
        "the machine is a control side, whose axes are in another machine: judge the trace of that"
    )
