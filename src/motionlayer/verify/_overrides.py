"""Rules over the override: a factor from 0 to 1 on the velocity limit of every motion, in force from its tick on."""

from collections.abc import Mapping

import numpy as np

from motionlayer.event import Kind
from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Flags, Floats
from motionlayer.verify._lives import Life
from motionlayer.verify._report import Finding
from motionlayer.verify._states import State
from motionlayer.verify._tolerance import TOLERANCES, quantisation


def override_rules(axis: Axis, lives: Mapping[int, Life]) -> list[Finding]:
    """All rules over the override; what plans have to do with it is judged where it is recorded lossless."""
    value = axis.signals.get("override")
    if value is None:
        return []
    widening = quantisation(axis, "override")
    bad = ~((value >= -widening) & (value <= 1.0 + widening))
    text = "is not between 0 and 1"
    found = axis.findings("override", bad, axis.ticks, text, value=value, limit=np.clip(value, 0.0, 1.0))
    if widening > 0.0:
        return found
    scaled = np.isin(axis.curves.kind, ("position", "velocity", "passing"))
    return [*found, *_followed(axis, value, scaled, lives), *_shares(axis, value, scaled)]


def _last_tick(life: Life | None) -> float:
    """Return the last tick in which a command is moved by the override; -1 for no command."""
    if life is None:
        return -1.0
    return life.ended - 1.0 if life.kind == Kind.ERROR else life.ended


def _followed(axis: Axis, value: Floats, scaled: Flags, lives: Mapping[int, Life]) -> list[Finding]:
    """A motion is planned anew in the tick in which the override changes; not one that an error ends in that tick.

    Such an axis brakes, which is judged elsewhere; or it rests already, and then there is nothing to plan.
    """
    ends = np.array([_last_tick(lives.get(number)) for number in axis.curves.command.tolist()])
    plan = axis.in_force
    before = np.concatenate([plan[:1], plan[:-1]])
    running = scaled[before] & (ends[before] >= axis.ticks) & (axis.curves.command[before] != 0)
    changed = np.concatenate([[False], np.diff(value) != 0.0])
    bad = changed & running & (axis.curves.tick[plan] != axis.ticks)
    last = np.concatenate([value[:1], value[:-1]])
    text = "the override changes, and the motion is not planned anew"
    return axis.findings("override", bad, axis.ticks, text, value=value, limit=last)


def _shares(axis: Axis, value: Floats, scaled: Flags) -> list[Finding]:
    """The velocity limits of all plans of a command are the override's share of one number, and that of the maximum.

    A plan that passes its target faster than the command asked, for the sake of a blended successor, has that velocity
    as its limit. It is above the share of the maximum only where the override fell too late to brake: at most what is
    left when the acceleration at its start is brought to zero.
    """
    curves, maximum = axis.curves, axis.maximum("velocity")
    share = np.where(scaled & axis.recorded, value[axis.row_taken], 0.0)
    slack = 1.0 + TOLERANCES["limits"].relative
    raised = (curves.kind == "passing") & (curves.velocity == np.abs(curves.last_piece()[:, 2]))
    _, _, v, a, _ = curves.pieces[curves.first[:-1]].T
    late = raised & (curves.velocity <= np.abs(v + 0.5 * a * np.abs(a) / curves.jerk) * slack)
    high = (share > 0.0) & ~late & (curves.velocity > share * maximum * slack)
    text = "the velocity limit is above the override's share of the maximum"
    found = axis.findings("override", high, curves.tick, text, value=curves.velocity, limit=share * maximum, order=1)
    asked = curves.velocity / np.where(share > 0.0, share, 1.0)
    first: dict[int, float] = {}
    state = axis.signals.get("state", np.zeros(len(value)))[axis.row_taken]
    raised |= state == State.HOMING  # its searches have velocities of their own
    for plan in np.flatnonzero((share > 0.0) & (curves.command != 0) & ~raised).tolist():
        usual = first.setdefault(int(curves.command[plan]), float(asked[plan]))
        if abs(asked[plan] - usual) > TOLERANCES["limits"].relative * usual:
            text = f"the velocity limit of command {curves.command[plan]} is not the override's share of what it was"
            limit = usual * float(share[plan])
            tick, now = int(curves.tick[plan]), float(curves.velocity[plan])
            found.append(axis.finding("override", tick, text, value=now, limit=limit, unit=axis.unit(1)))
    return found
