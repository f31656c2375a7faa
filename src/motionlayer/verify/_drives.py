"""Rules over the actual position: that of an ideal drive, and that of a simulated servo.

A servo is not simulated again. What the trace allows to judge: its lag is what set and actual position make it, and
stays within the limit of the monitor, or an error follows as soon as the filter time is over; and its encoder shows
whole steps.
"""

import math

import numpy as np

from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Flags
from motionlayer.verify._report import Finding
from motionlayer.verify._states import State
from motionlayer.verify._tolerance import EPS, differs, quantisation, sample_tolerance


def actual_position(axis: Axis) -> list[Finding]:
    """The actual position of an ideal drive is its set position; that of a servo keeps to what its section says."""
    kind = axis.machine.get("drive", {}).get("kind")
    if "actual_position" not in axis.signals:
        return []
    if kind == "servo":
        return [*_lag(axis), *_lag_monitor(axis), *_steps(axis)]
    return _ideal(axis) if kind == "ideal" else []


def _ideal(axis: Axis) -> list[Finding]:
    """With power the actual position is the set position, without it stays where it is; the lag is 0 with power."""
    value, allowed = axis.signals["actual_position"], sample_tolerance(axis, "actual_position")
    powered = axis.signals.get("ready", np.ones(len(value))) == 1.0
    follows = np.concatenate([[True], powered[:-1]])
    before = np.concatenate([value[:1], value[:-1]])
    expected = np.where(follows, axis.reference.p, before)
    bad = differs(value, expected, allowed) & (follows | ~axis.redefined)
    text = "actual_position of an ideal drive is not the set position, or moves without power"
    found = axis.findings("actual position", bad, axis.ticks, text, value=value, limit=expected, order=0)
    if "lag" not in axis.signals:
        return found
    lag, nothing = axis.signals["lag"], np.zeros(len(value))
    return found + axis.findings(
        "lag", differs(lag, nothing, 0.0), axis.ticks, "an ideal drive has none", value=lag, limit=nothing, order=0
    )


def _lag(axis: Axis) -> list[Finding]:
    """The lag is set(n - dead time) - actual(n), or without communication both are those of the row before.

    A drive that hears nothing goes on by itself: what comes out of its dead time then is not the set position.
    """
    if "lag" not in axis.signals:
        return []
    lag, actual, planned = (axis.signals[name] for name in ("lag", "actual_position", "set_position"))
    dead = _dead(axis)
    expected = np.concatenate([planned[:1].repeat(dead), planned])[: len(planned)] - actual
    wide = sample_tolerance(axis, "actual_position") + sample_tolerance(axis, "set_position")
    apart = differs(lag, expected, wide + quantisation(axis, "lag") + 8.0 * EPS * _extent(axis))
    stale = np.concatenate([[True], (np.diff(lag) == 0.0) & (np.diff(actual) == 0.0)])
    early = (axis.ticks[0] > 0) & (np.arange(len(lag)) < dead)  # of what was before the first row
    bad = apart & ~early & ~_recently(stale, dead) & ~_recently(axis.redefined, dead)
    text = "is not set(n - dead time) - actual(n)"
    return axis.findings("lag", bad, axis.ticks, text, value=lag, limit=expected, order=0)


def _extent(axis: Axis) -> float:
    """Return how large the positions of the drive can be: its coordinate stays when that of the axis is redefined."""
    planned = axis.signals["set_position"]
    leaps = np.abs(np.diff(planned))[axis.redefined[1:]].sum()
    return float(np.abs(planned).max() + np.abs(axis.signals["actual_position"]).max() + leaps)


def _dead(axis: Axis) -> int:
    """Return the dead time of the drive in rows."""
    return round(float(axis.machine["drive"]["dead_time"]) / axis.dt)


def _lag_monitor(axis: Axis) -> list[Finding]:
    """Under power the lag is above its limit for the filter time at most; else ErrorStop follows in the next row."""
    monitor = axis.machine.get("monitor", {})
    limit = monitor.get("lag")
    if limit is None or any(name not in axis.signals for name in ("lag", "ready", "state")):
        return []
    lag, error = np.abs(axis.signals["lag"]), axis.signals["state"] == State.ERRORSTOP
    most = limit + quantisation(axis, "lag")
    over = (axis.signals["ready"] == 1.0) & ~error & (lag > most) & ~_recently(axis.redefined, _dead(axis))
    filtered = math.ceil(monitor["lag_time"] / axis.dt - 1e-6)
    bad = _for_longer(over, filtered) & ~np.concatenate([error[1:], [True]])
    text = "above its limit for longer than the filter time, and no error follows"
    return axis.findings("lag", bad, axis.ticks, text, value=lag, limit=np.full(len(lag), float(limit)), order=0)


def _recently(flags: Flags, rows: int) -> Flags:
    """Tell where a flag was up in this row or one of the `rows` before."""
    count = np.concatenate([[0], np.cumsum(flags)])
    start = np.maximum(np.arange(len(flags)) - rows, 0)
    return np.asarray(count[1:] > count[start])


def _for_longer(flags: Flags, rows: int) -> Flags:
    """Tell where a flag has been up in more than the `rows` rows before and this one."""
    index = np.arange(len(flags))
    last_down = np.maximum.accumulate(np.where(flags, -1, index))
    return np.asarray(flags & (index - last_down > rows))


def _steps(axis: Axis) -> list[Finding]:
    """The actual position changes by whole steps of the encoder, where the coordinate stays the same.

    Before the drive is heard for the first time it is that of the machine description, which may be between two steps.
    """
    step = axis.machine["drive"].get("encoder_resolution", 0.0)
    if step == 0.0 or quantisation(axis, "actual_position") > 0.0 or len(axis.ticks) < 2:
        return []
    actual = axis.signals["actual_position"]
    change = np.diff(actual)
    off = np.abs(change - np.round(change / step) * step)
    allowed = 16.0 * EPS * (np.abs(actual[1:]) + np.abs(actual[:-1]) + np.abs(actual).max())
    heard = np.logical_or.accumulate(actual[:-1] != axis.machine.get("start_position", 0.0))
    bad = (off > allowed) & ~axis.redefined[1:] & heard
    text = "the actual position changes by no whole step of the encoder"
    return axis.findings("encoder", bad, axis.ticks[1:], text, value=change, limit=np.full(len(off), step), order=0)
