"""Rules over the actual position: that of an ideal drive, and that of a simulated servo.

A servo is not simulated again. What the trace allows to judge: its lag stays within the limit of the monitor, or an
error follows as soon as the filter time is over; and its encoder shows whole steps.
"""

import math

import numpy as np

from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Flags
from motionlayer.verify._report import Finding
from motionlayer.verify._states import State
from motionlayer.verify._tolerance import EPS, TOLERANCES, differs, quantisation, sample_tolerance


def actual_position(axis: Axis) -> list[Finding]:
    """The actual position of an ideal drive is its set position; that of a servo keeps to what its section says."""
    kind = axis.machine.get("drive", {}).get("kind")
    if "actual_position" not in axis.signals:
        return []
    if kind == "servo":
        return [*_lag(axis), *_steps(axis)]
    if kind != "ideal":
        return []
    value, expected = axis.signals["actual_position"], axis.reference.p
    bad = differs(value, expected, sample_tolerance(axis, "actual_position"))
    text = "actual_position of an ideal drive is not the set position"
    return axis.findings("actual position", bad, axis.ticks, text, value=value, limit=expected, order=0)


def _lag(axis: Axis) -> list[Finding]:
    """Under power |set(n - dead time) - actual(n)| is above its limit only for the filter time.

    Without communication the actual position is stale, and nobody judges it for as long as the drive bears that.
    """
    monitor, drive = axis.machine.get("monitor", {}), axis.machine["drive"]
    limit = monitor.get("lag")
    if limit is None or "state" not in axis.signals:
        return []
    dead = round(drive["dead_time"] / axis.dt)
    actual, planned = axis.signals["actual_position"], axis.signals["set_position"]
    known = ~_recently(axis.redefined, dead)
    powered = ~np.isin(axis.signals["state"], (State.DISABLED, State.ERRORSTOP))
    lag = np.abs(np.concatenate([planned[:1].repeat(dead), planned])[: len(planned)] - actual)
    most = limit * (1.0 + TOLERANCES["plan limits"].relative) + 2.0 * sample_tolerance(axis, "actual_position")
    over = known & powered & (lag > most)
    rows = math.ceil(monitor["lag_time"] / axis.dt - 1e-6) + 1 + drive["patience"] + 1
    text = "the lag is above its limit for longer than the filter time, and no error follows"
    bad = _for_longer(over, rows)
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
    """The actual position changes by whole steps of the encoder, where the coordinate stays the same."""
    step = axis.machine["drive"].get("encoder_resolution", 0.0)
    if step == 0.0 or quantisation(axis, "actual_position") > 0.0 or len(axis.ticks) < 2:
        return []
    actual = axis.signals["actual_position"]
    change = np.diff(actual)
    off = np.abs(change - np.round(change / step) * step)
    allowed = 16.0 * EPS * (np.abs(actual[1:]) + np.abs(actual[:-1]) + np.abs(actual).max())
    bad = (off > allowed) & ~axis.redefined[1:]
    text = "the actual position changes by no whole step of the encoder"
    return axis.findings("encoder", bad, axis.ticks[1:], text, value=change, limit=np.full(len(off), step), order=0)
