"""The rule over the speed at which one motion hands over to the next.

The buffer mode names it (function-blocks 2.8): 0 for BUFFERED, and out of the velocities of both motions the lower,
the higher, that before or that behind the joint. What can be had may be another one:

- faster, where the axis is too near to be slowed down: then it brakes all the way to the joint;
- slower, where it cannot gain the speed any more, or where it could not brake from it behind: then it does not brake at
  the joint, or it brakes from the joint on. It may be slower as well where it brakes all the way to the joint: a stop
  can be shorter than the way to a lower speed.
"""

from collections.abc import Callable, Mapping
from dataclasses import fields
from typing import Final

import numpy as np

from motionlayer.verify._asked import Lives, override_of, served
from motionlayer.verify._axis import Axis
from motionlayer.verify._bounds import Stretches, comes_inside, stretches
from motionlayer.verify._dynamics import asked_for
from motionlayer.verify._report import Finding
from motionlayer.verify._requests import request

MODES: Final[Mapping[str, Callable[[float, float], float]]] = {
    "BLENDING_LOW": min,
    "BLENDING_PREVIOUS": lambda first, _second: first,
    "BLENDING_NEXT": lambda _first, second: second,
    "BLENDING_HIGH": max,
}

BLUR: Final = 1e-8
"""Share of the machine's maximum velocity by which a speed may be beside the one of the mode."""

SLIVER: Final = 1e-9
"""Cycles that a piece lasts which is nothing but rounding."""


def blend_rules(axis: Axis, lives: Lives) -> list[Finding]:
    """All rules over joints that are passed in motion."""
    own, curves, found = served(axis, lives), axis.curves, []
    joints = np.flatnonzero((curves.kind[:-1] == "passing") & curves.inside[1:])
    cut = _lasting(stretches(curves), SLIVER * axis.dt) if len(joints) else None
    for plan in joints.tolist():
        first, second = own.get(int(curves.command[plan])), own.get(int(curves.command[plan + 1]))
        if cut is None or first is None or second is None or not request(second.text).blends:
            continue
        factor, behind = override_of(axis, plan), request(second.text)
        own_speed = asked_for(axis, first, "velocity")
        next_speed = 0.0 if behind.name == "halt" else asked_for(axis, second, "velocity")
        asked = factor * MODES[behind.mode](own_speed, next_speed)
        speed, slack = abs(float(curves.last_piece()[plan, 2])), BLUR * axis.maximum("velocity")
        slow = speed < asked - slack and not _cannot_be_faster(cut, plan)
        if slow or (speed > asked + slack and not comes_inside(cut, _rows(cut, plan))):
            text = f"command {second.number} takes over at another speed than it asked for, {second.text}"
            tick = int(curves.tick[plan])
            found.append(axis.finding("joint speed", tick, text, value=speed, limit=asked, unit=axis.unit(1)))
    return found


def _lasting(cut: Stretches, least: float) -> Stretches:
    """Leave out the stretches shorter than `least` seconds: they are the rounding of others."""
    keep = cut.length > least
    return Stretches(**{field.name: getattr(cut, field.name)[keep] for field in fields(cut)})


def _rows(cut: Stretches, plan: int) -> slice:
    """Return the stretches of a plan."""
    first, end = np.searchsorted(cut.plan, [plan, plan + 1]).tolist()
    return slice(first, end)


def _cannot_be_faster(cut: Stretches, plan: int) -> bool:
    """Tell whether a plan gains speed up to its joint, brakes all the way to it, or the next one brakes from there."""
    before, behind = _rows(cut, plan), _rows(cut, plan + 1)
    gains = not cut.falls[before][-1:].any()
    return gains or bool(cut.falls[behind][:1].any()) or comes_inside(cut, before)
