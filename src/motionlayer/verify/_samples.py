"""Rules over the samples: equal to the plans, and plausible without them."""

from typing import Final

import numpy as np

from motionlayer.verify._axis import LIMITS, Axis
from motionlayer.verify._curves import Flags, Floats, Integers
from motionlayer.verify._report import Finding
from motionlayer.verify._tolerance import TOLERANCES, Slack, differs, sample_tolerance

SET: Final = (("set_position", "p", 0), ("set_velocity", "v", 1), ("set_acceleration", "a", 2))


def _against(axis: Axis, rule: str, signal: str, expected: Floats, *, order: int, text: str) -> list[Finding]:
    if signal not in axis.signals:
        return []
    value = axis.signals[signal]
    bad = differs(value, expected, sample_tolerance(axis, signal))
    return axis.findings(rule, bad, axis.ticks, f"{signal} {text}", value=value, limit=expected, order=order)


def set_values(axis: Axis) -> list[Finding]:
    """Set position, velocity and acceleration are what the plans say, tick by tick."""
    found = []
    for signal, quantity, order in SET:
        expected: Floats = getattr(axis.reference, quantity)
        found += _against(axis, "set value", signal, expected, order=order, text="is not what the plan says")
    return found


def set_jerk(axis: Axis) -> list[Finding]:
    """Set jerk is the difference of the accelerations over the cycle that ends at the tick."""
    mean = (axis.reference.a - axis.reference_before.a) / axis.dt
    return _against(axis, "set jerk", "set_jerk", mean, order=3, text="is not the difference of the accelerations")


def limit_signals(axis: Axis) -> list[Finding]:
    """Limit signals are those of the plan in force; software limits are the machine's, or written ones inside them."""
    found = []
    for signal, order in zip(LIMITS, (1, 2, 2, 3), strict=True):
        text = "is not the limit of the plan in force"
        found += _against(axis, "limit signal", signal, axis.limit(signal), order=order, text=text)
    for side in ("min", "max"):
        signal, text = f"software_limit_{side}", "is not the machine's"
        found += _against(axis, "limit signal", signal, _settled(axis, side), order=0, text=text)
    return found


def _settled(axis: Axis, side: str) -> Floats:
    """Return what a software limit is expected to be in each row: it changes only where a parameter is written."""
    limit = axis.software_limit(side)
    rows = np.searchsorted(axis.ticks, axis.written)
    limit[: rows[0] if len(rows) else len(limit)] = axis.machine_limit(side)
    changes = np.zeros(len(limit), np.int64)
    inside = rows[rows < len(limit)]
    changes[inside] = inside
    last = np.maximum.accumulate(changes)
    return limit[last]


def differences(axis: Axis) -> list[Finding]:
    """From the samples alone: over each cycle they fit one another within the jerk limit of the plan they belong to.

    Where one plan takes over from another inside the cycle, that is the larger limit of both.
    With |jerk| <= J and both ends known, v differs from the trapezoid of a by at most J dt²/4, and p from the
    trapezoid of v by at most J dt³/12.
    """
    if len(axis.ticks) < 2:
        return []
    p, v, a = (axis.signals[signal] for signal, _, _ in SET)
    wide_p, wide_v, wide_a = (sample_tolerance(axis, signal) for signal, _, _ in SET)
    joint, slack = _joints(axis), Slack.of(axis.curves)
    driving = _driving(axis)
    before = driving - joint
    wide_p, wide_v, wide_a = (
        wide[1:] + wide[:-1] + np.where(joint, step[before], 0.0)
        for wide, step in ((wide_p, slack.p), (wide_v, slack.v), (wide_a, slack.a))
    )
    dt, limit = axis.dt, np.maximum(axis.curves.jerk[driving], axis.curves.jerk[before])
    jerk = limit * (1.0 + TOLERANCES["plan limits"].relative)
    cases = (
        ("jerk", np.diff(a) / dt, jerk, wide_a / dt, 3),
        ("velocity", np.diff(v) - dt * (a[1:] + a[:-1]) / 2, jerk * dt**2 / 4, wide_v + dt * wide_a, 1),
        ("position", np.diff(p) - dt * (v[1:] + v[:-1]) / 2, jerk * dt**3 / 12, wide_p + dt * wide_v, 0),
    )
    found = []
    for name, step, most, widening, order in cases:
        bad = ~(np.abs(step) <= most + widening)
        if name == "position":
            bad &= ~axis.redefined[1:]
        text = f"the {name} of the samples changes by more than the jerk limit allows over the cycle"
        found += axis.findings("sample step", bad, axis.ticks[1:], text, value=np.abs(step), limit=most, order=order)
    return found


def _driving(axis: Axis) -> Integers:
    """Return for each cycle the plan it ends in: not one that only shows a coordinate that was redefined."""
    plan = np.arange(len(axis.curves), dtype=np.int64)
    moves = np.maximum.accumulate(np.where(axis.curves.redefines, 0, plan))
    return np.asarray(moves[axis.serving[1:]], np.int64)


def _joints(axis: Axis) -> Flags:
    """Tell for each cycle whether a plan begins inside: there the one before it may end beside its target."""
    plan = _driving(axis)
    return np.asarray(axis.curves.inside[plan] & (axis.curves.tick[plan] == axis.ticks[:-1]))


def sampled_limits(axis: Axis) -> list[Finding]:
    """From the samples alone: |v| and |a| are inside the limits in force, or no further out than they must.

    What must be follows from the sample at which the plan took over: |a| may stay as high as it was, and |v| come
    to what it costs to bring that acceleration to zero.
    """
    curves, plan = axis.curves, axis.serving
    v, a = axis.signals["set_velocity"], axis.signals["set_acceleration"]
    wide_v, wide_a = sample_tolerance(axis, "set_velocity"), sample_tolerance(axis, "set_acceleration")
    start = np.maximum(curves.tick[plan] - axis.ticks[0], 0)
    inside, piece = curves.inside[plan], curves.first[plan]  # no sample shows where a plan took over inside a cycle
    begin_v, begin_a = (np.where(inside, curves.pieces[piece, 2 + k], one[start]) for k, one in enumerate((v, a)))
    speed, strength = np.abs(begin_v), np.abs(begin_a)
    gain = strength * strength / (2.0 * curves.jerk[plan])
    peak = np.where(begin_v * begin_a < 0.0, np.maximum(speed, gain - speed), speed + gain)
    share = 1.0 + TOLERANCES["plan limits"].relative
    most_v = np.maximum(curves.velocity[plan], peak) * share
    most_a = np.maximum(np.maximum(curves.acceleration, curves.deceleration)[plan], strength) * share
    widening_v = wide_v + wide_v[start] + strength * wide_a[start] / curves.jerk[plan]
    cases = (("velocity", v, most_v, widening_v, 1), ("acceleration", a, most_a, wide_a + wide_a[start], 2))
    found = []
    for name, value, most, widening, order in cases:
        bad = ~(np.abs(value) <= most + widening)
        text = f"{name} above the limit in force"
        found += axis.findings("sampled limit", bad, axis.ticks, text, value=np.abs(value), limit=most, order=order)
    return found
