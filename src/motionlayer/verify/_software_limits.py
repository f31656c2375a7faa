"""The rule over software limits, and how far out a legal motion can come.

Software limits do not hold while an axis is Disabled or Homing, and a coordinate may be redefined so that the axis
stands outside. Else

- no move leads out. From outside it leads back, and does not go out again but where the axis cannot help turning
  (its acceleration takes it through rest): then at most to where that turn comes to rest, and never beyond the
  place where the move began;
- a halt or a stop is never refused. From a motion that would just have turned round before the limit it has to take the
  acceleration back first, and may come as far out as the shortest stop does. It brakes no weaker than the
  motion before it, so that this is the shortest stop under the stronger of both limits.

A motion that the override holds at 0 is stopped under its own limits, which were checked when it was accepted.
"""

import numpy as np

from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Flags, Floats, Integers
from motionlayer.verify._report import Finding
from motionlayer.verify._states import MAY_BE_OUTSIDE
from motionlayer.verify._stops import Stops, stops
from motionlayer.verify._tolerance import Slack, sample_tolerance


def software_limits(axis: Axis) -> list[Finding]:
    """The set position is inside the software limits, or no further out than a legal motion must be."""
    position, widening = axis.signals["set_position"], sample_tolerance(axis, "set_position")
    free, stop = _free(axis), _strongest(axis)
    slack = Slack.of(axis.curves).p
    found = []
    for side, sign in (("min", -1.0), ("max", 1.0)):
        limit = axis.software_limit(side)
        if np.isinf(limit).all():
            continue
        beyond = sign * (position - limit)
        before = np.concatenate([[0.0], sign * (position[:-1] - limit[1:])])
        back = np.where(before > np.concatenate([[0.0], widening[:-1]]), before, 0.0)
        forced = (_forced(axis, stop, sign) + slack)[axis.serving] - sign * limit
        bad = ~(beyond <= np.maximum(back, forced) + widening) & ~free
        text = f"set position beyond the software limit {side}"
        found += axis.findings("software limit", bad, axis.ticks, text, value=position, limit=limit, order=0)
    return found


def _free(axis: Axis) -> Flags:
    """Tell where no limit holds: the position of a row is the work of the state one row before."""
    state = axis.signals.get("state")
    first = axis.ticks == axis.ticks[0]
    if state is None:
        return np.asarray(axis.redefined | first)
    exempt = np.isin(state, MAY_BE_OUTSIDE)
    return np.asarray(axis.redefined | first | np.concatenate([[True], exempt[:-1]]))


def _forced(axis: Axis, stop: Stops, sign: float) -> Floats:
    """Return how far out each plan may come: sign times position, -inf where it need not go outwards."""
    curves = axis.curves
    plan: Integers = np.arange(len(curves), dtype=np.int64)
    began = sign * curves.at(plan, np.maximum(curves.offset, 0.0)).p
    reach = stop.furthest(sign)
    return np.where(curves.kind == "stop", reach, np.minimum(reach, began))


def _strongest(axis: Axis) -> Stops:
    """Compute the shortest stop under the limits of each plan, and of the one before it where that is what brakes."""
    curves = axis.curves
    before = np.maximum(np.arange(len(curves)) - 1, 0)
    alone = held(axis) | (curves.kind != "stop") | (curves.kind[before] == "set")
    most, jerk = curves.deceleration, curves.jerk
    most = np.where(alone, most, np.maximum(most, most[before]))
    return stops(curves, most, np.where(alone, jerk, np.maximum(jerk, jerk[before])))


def held(axis: Axis) -> Flags:
    """Tell for each plan whether it may be a motion that the override holds at 0; so it is where nobody knows."""
    if "override" not in axis.signals:
        return np.ones(len(axis.curves), np.bool_)
    return np.asarray((axis.signals["override"][axis.row_taken] == 0.0) | ~axis.recorded)
