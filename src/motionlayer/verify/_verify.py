"""`verify`: all rules over all axes; `assert_valid` for tests."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Final

from motionlayer.verify import _bounds, _drives, _plans, _samples
from motionlayer.verify._asked import asked_rules
from motionlayer.verify._axis import Axis
from motionlayer.verify._blends import blend_rules
from motionlayer.verify._brakes import brake_rules
from motionlayer.verify._causes import cause_rules
from motionlayer.verify._commands import command_rules
from motionlayer.verify._dynamics import dynamics_rules
from motionlayer.verify._homings import homing_rules
from motionlayer.verify._lives import Life, life_findings, read_lives
from motionlayer.verify._moments import Moments
from motionlayer.verify._overrides import override_rules
from motionlayer.verify._power import power_rules
from motionlayer.verify._redefinitions import redefinition_rules
from motionlayer.verify._report import Finding, Report
from motionlayer.verify._resolve import broken_off, missing_rows, not_judged, unresolved_axis, unresolved_trace
from motionlayer.verify._software_limits import software_limits
from motionlayer.verify._states import state_rules
from motionlayer.verify._wellformed import malformed

if TYPE_CHECKING:
    from motionlayer.record import Trace

RULES: Final[tuple[Callable[[Axis], list[Finding]], ...]] = (
    _plans.machine_maxima,
    _plans.pieces_continuous,
    _plans.handovers,
    _plans.ends,
    _bounds.planned_limits,
    _bounds.shortest_stops,
    _samples.set_values,
    _samples.set_jerk,
    _drives.actual_position,
    _samples.limit_signals,
    _samples.differences,
    _samples.sampled_limits,
    software_limits,
)
"""Rules over one axis whose plans follow one another."""


def verify(trace: "Trace", *, partial: bool = False) -> Report:
    """Judge a trace from its samples, plans, events and header alone; its stored hash is not looked at.

    An incomplete trace is judged to where it ends, one with gaps before and after each of them; `complete` of the
    report is False then.

    Args:
        trace: any trace, also one from another installation.
        partial: judge a damaged trace as well, as far as it was read, instead of refusing it.

    Returns:
        The report; `ok` if everything was judged and nothing is wrong.
    """
    notes = [*missing_rows(trace), *broken_off(trace, partial=partial)]
    lives, wrong = read_lives(trace.events)
    findings = life_findings(trace, wrong)
    refused = unresolved_trace(trace, partial=partial)
    judged: list[str] = []
    stretches = trace.stretches()
    for name in [] if refused else trace.header["machine"]["axis"]:
        reasons = unresolved_axis(trace, name)
        refused += reasons
        if not reasons:
            judged.append(name)
            notes += not_judged(trace, name)
            # What is wrong with a plan is found in each of them.
            findings += dict.fromkeys(found for part in stretches for found in _judge(part, name, lives))
    return Report(
        findings=tuple(findings),
        refused=tuple(refused),
        notes=tuple(notes),
        axes=tuple(judged),
        ticks=len(trace.ticks),
        plans=sum(plan.axis in judged for plan in trace.plans),
        commands=len(lives),
        complete=trace.complete and not trace.gaps,
    )


def _judge(trace: "Trace", name: str, lives: Mapping[int, Life]) -> list[Finding]:
    """Judge one axis; rules that evaluate plans are left out where these make no sense."""
    broken = [
        Finding(name, plan.tick, plan.tick * trace.base_cycle, "plan", text)
        for plan in trace.plans
        if plan.axis == name and (text := malformed(plan))
    ]
    if broken:
        return broken
    axis = Axis.of(trace, name)
    disorder = _plans.succession(axis)
    if disorder:
        return disorder
    findings = [finding for rule in RULES for finding in rule(axis)]
    moments = Moments.of(axis, trace.events, lives)
    findings += [*state_rules(axis), *cause_rules(axis, moments, lives), *power_rules(axis, moments)]
    findings += [*override_rules(axis, lives), *command_rules(axis, lives)]
    findings += [*asked_rules(axis, lives), *dynamics_rules(axis, lives), *brake_rules(axis, lives)]
    findings += [*blend_rules(axis, lives), *homing_rules(axis, lives)]
    return [*findings, *redefinition_rules(axis, lives)]


def assert_valid(trace: "Trace", *, partial: bool = False) -> None:
    """Raise AssertionError with the text of the report unless `verify` finds the trace whole and valid.

    The helper for tests that move something.

    Args:
        trace: any trace.
        partial: be content with a part: with a trace that is incomplete, damaged or has gaps.

    Raises:
        AssertionError: something is wrong or could not be judged, or the trace is not whole.
    """
    report = verify(trace, partial=partial)
    if not report.ok or not (report.complete or partial):
        raise AssertionError(str(report))
