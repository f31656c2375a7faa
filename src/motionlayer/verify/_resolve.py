"""What cannot be judged, and why: said instead of a verdict."""

from typing import TYPE_CHECKING, Final

import numpy as np

from motionlayer.verify._axis import OTHER_SIGNALS, SET_SIGNALS
from motionlayer.verify._wellformed import malformed

if TYPE_CHECKING:
    from motionlayer.record import Trace

FORMAT: Final = 1
COARSEST: Final = 0.1
"""Largest share of what a limit allows in one cycle that a resolution may hide."""

NO_AXES: Final = (
    "the machine is a control side, whose axes are in another machine: judge the trace of that one; "
    "whether the control side does the same again, `motionlayer replay` tells"
)


def broken_off(trace: "Trace", *, partial: bool) -> list[str]:
    """Return a note if only a part of the trace is judged: why, and up to where."""
    if trace.complete or not len(trace.ticks) or (trace.damage and not partial):
        return []
    why = f"file is damaged: {trace.damage}" if trace.damage else "trace is incomplete, its writer was cut short"
    return [f"the {why}; judged up to tick {int(trace.ticks[-1])} ({float(trace.time[-1]):.6f} s)"]


def missing_rows(trace: "Trace") -> list[str]:
    """Return a note for each gap that the recorder has left because its writer did not keep up."""
    return [
        f"{gap.ticks} rows from tick {gap.first} on are missing, because the writer of the trace did not keep up; "
        "judged before and after them, each part on its own"
        for gap in trace.gaps
        if gap.ticks
    ]


def unresolved_trace(trace: "Trace", *, partial: bool) -> list[str]:
    """Return why the trace as a whole cannot be judged; with `partial` damage is no reason."""
    header, reasons = trace.header, []
    if trace.damage and not partial:
        reasons.append(f"the file is damaged: {trace.damage}")
    if header.get("format") != FORMAT:
        reasons.append(f"format {header.get('format')!r} of the trace; format {FORMAT} is understood")
    machine = header.get("machine", {})
    if not machine.get("axis"):
        reasons.append(NO_AXES if machine.get("control") else "the header describes no axis")
    if not float(trace.base_cycle) > 0.0:
        reasons.append(f"the base cycle is {trace.base_cycle} s")
    if not len(trace.ticks):
        return [*reasons, "the trace has no rows"]
    told = {(gap.first, gap.first + gap.ticks) for gap in trace.gaps}
    jumps = [(int(trace.ticks[row]) + 1, int(trace.ticks[row + 1])) for row in trace.jumps]
    untold = [jump for jump in jumps if jump not in told]
    if untold:
        first = untold[0][0] - 1
        reasons.append(f"the ticks have {len(untold)} gaps that nothing explains, the first one after tick {first}")
    lost = sum(gap.records for gap in trace.gaps)
    if lost:
        reasons.append(f"{lost} plans, events or inputs are missing, because the writer of the trace did not keep up")
    return reasons


def unresolved_axis(trace: "Trace", name: str) -> list[str]:
    """Return why an axis of the machine cannot be judged."""
    missing = [signal for signal in SET_SIGNALS if f"{name}.{signal}" not in trace]
    if missing:
        return [f"{name}: not recorded: {', '.join(missing)}; add them to the signals of the trace"]
    plans = [plan for plan in trace.plans if plan.axis == name]
    if not plans:
        return [f"{name}: the trace holds no plan of the axis"]
    if min(plan.tick for plan in plans) > trace.ticks[0]:
        return [f"{name}: no plan covers tick {int(trace.ticks[0])}, the first row"]
    if any(malformed(plan) for plan in plans):
        return []  # a finding, not a question of resolution
    return _too_coarse(trace, name)


def _too_coarse(trace: "Trace", name: str) -> list[str]:
    plans = [plan for plan in trace.plans if plan.axis == name]
    dt = float(trace.base_cycle)
    v = min((plan.velocity for plan in plans if plan.velocity > 0.0), default=np.inf)
    a = min(min(plan.acceleration, plan.deceleration) for plan in plans)
    j = min(plan.jerk for plan in plans)
    steps = {"set_position": v * dt, "set_velocity": min(v, a * dt), "set_acceleration": min(a, j * dt)}
    reasons = []
    for signal in trace.signals:
        axis, _, short = signal.name.rpartition(".")
        most = COARSEST * steps.get(short, np.inf)
        if axis == name and signal.resolution > most:
            reasons.append(
                f"{signal.name}: a resolution of {signal.resolution:g} {signal.unit} hides what the limits "
                f"in force allow in a cycle; at most {most:g} {signal.unit} can be judged"
            )
    return reasons


def not_judged(trace: "Trace", name: str) -> list[str]:
    """Return a note if signals are missing that rules would have looked at."""
    missing = [signal for signal in OTHER_SIGNALS if f"{name}.{signal}" not in trace]
    notes = [f"{name}: not recorded, hence not judged: {', '.join(missing)}"] if missing else []
    axis = trace.header["machine"]["axis"][name]
    kind, limit = axis.get("drive", {}).get("kind"), axis.get("monitor", {}).get("lag")
    if kind == "servo" and limit is None:
        notes.append(f"{name}: the lag of the servo drive is not judged, its monitor has no limit for it")
    elif kind not in {"ideal", "servo"}:
        notes.append(f"{name}: the actual position of a drive of kind {kind!r} is not judged")
    return notes
