"""Rules over power: `enable` is what the axis asks its drive for, `ready` what the drive says.

A drive answers in the inputs of a tick what was asked until then: in the tick before, or between both. It may lose its
power at any time; it gets it only where it is asked for. Losing it although it is asked for is an error, and with that
the request is withdrawn: set and actual position part (decision 0013), and no drive runs after a set position that it
has not stood at. An `enable()` that waits asks again once the setpoint rests.
"""

from typing import Final

import numpy as np

from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Flags, Integers
from motionlayer.verify._moments import Moments, changes, just_before
from motionlayer.verify._report import Finding
from motionlayer.verify._states import State
from motionlayer.verify._tolerance import sample_tolerance

SIGNALS: Final = ("state", "enable", "ready")


def power_rules(axis: Axis, moments: Moments) -> list[Finding]:
    """All rules over power; none where the trace does not hold all that they are about."""
    if any(signal not in axis.signals for signal in SIGNALS):
        return []
    state, enable, ready = (axis.signals[signal] for signal in SIGNALS)
    found = []
    for name, value in (("enable", enable), ("ready", ready)):
        neither = ~np.isin(value, (0.0, 1.0))
        found += axis.findings(
            "power", neither, axis.ticks, f"{name} is neither 0 nor 1", value=value, limit=np.ones(len(value))
        )
    if found or not np.isin(state, [float(one) for one in State]).all():
        return found
    found = _requests(axis, state == State.ERRORSTOP, enable.astype(np.int64), moments)
    found += _answers(axis, enable == 1.0, ready.astype(np.int64), moments)
    return found + _states(axis, state.astype(np.int64), enable == 1.0, ready == 1.0, moments)


def _named(axis: Axis, bad: Flags, value: Integers, message: str) -> list[Finding]:
    before = np.concatenate([value[:1], value[:-1]]).astype(np.float64)
    return axis.findings("power", bad, axis.ticks, message, value=value.astype(np.float64), limit=before)


def _requests(axis: Axis, error: Flags, enable: Integers, moments: Moments) -> list[Finding]:
    """Power is asked for because of an `enable()`, and no longer because of a `disable()` or an error."""
    change = changes(enable)
    change[0] = enable[0] == 1 and axis.ticks[0] == 0
    on = change & (enable == 1) & ~moments.enabled
    off = change & (enable == 0) & ~moments.disabled & ~error
    found = _named(axis, on, enable, "power is asked for without a command")
    return found + _named(axis, off, enable, "power is taken away without a disable() or an error")


def _answers(axis: Axis, enable: Flags, ready: Integers, moments: Moments) -> list[Finding]:
    """A drive gets power if it was asked to, and the set position is then where it stands."""
    up = changes(ready) & (ready == 1)
    asked = just_before(enable) | (enable & moments.enabled)
    found = _named(axis, up & ~asked, ready, "the drive got power that nobody asked for")
    if "actual_position" not in axis.signals:
        return found
    actual, planned = axis.signals["actual_position"], axis.signals["set_position"]
    wide = sample_tolerance(axis, "set_position") + sample_tolerance(axis, "actual_position")
    apart = up & ~(np.abs(actual - planned) <= wide)
    text = "the drive gets power where its set position is not the actual one"
    return found + axis.findings("power", apart, axis.ticks, text, value=planned, limit=actual, order=0)


def _states(axis: Axis, state: Integers, enable: Flags, ready: Flags, moments: Moments) -> list[Finding]:
    """With power an axis is not Disabled, without it Disabled or in ErrorStop; lost though asked for it is an error."""
    off = state == State.DISABLED
    lost = changes(state) & off & enable & ~moments.accepted
    lost &= ~just_before(state == State.ERRORSTOP)
    return [
        *_named(axis, off & ready, state, "the axis is Disabled and its drive has power"),
        *_named(axis, ~ready & ~off & (state != State.ERRORSTOP), state, "a drive without power in this state"),
        *_named(axis, lost, state, "power that is asked for is lost, and no error follows"),
    ]
