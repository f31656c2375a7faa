"""Rules over how hard a brake brakes that no message tells of.

One that serves no command has the maxima of the machine. No halt and no stop is weaker than the motion that it ends
(function-blocks 2.7).
"""

import math
from typing import Final

import numpy as np

from motionlayer.verify._asked import Lives, served
from motionlayer.verify._axis import Axis
from motionlayer.verify._dynamics import differs
from motionlayer.verify._report import Finding
from motionlayer.verify._requests import BRAKES, request
from motionlayer.verify._tolerance import TOLERANCES

LIMITS: Final = (("deceleration", 2), ("jerk", 3))


def brake_rules(axis: Axis, lives: Lives) -> list[Finding]:
    """All rules over brakes but those over what their messages tell."""
    own, curves, found = served(axis, lives), axis.curves, []
    for plan in np.flatnonzero(curves.kind == "stop").tolist():
        life = own.get(int(curves.command[plan]))
        if life is None:
            found += _alone(axis, plan)
        if life is None or request(life.text).name in BRAKES:
            found += _no_weaker(axis, plan)
    return found


def _alone(axis: Axis, plan: int) -> list[Finding]:
    """A brake that serves no command has the maxima; one that was written since is not known, and not judged."""
    found, tick = [], int(axis.curves.tick[plan])
    for name, order in LIMITS:
        limit = float(getattr(axis.curves, name)[plan])
        most = math.nan if (axis.written <= tick).any() else axis.maximum(name)
        if differs(limit, most):
            text = f"the {name} of a brake that serves no command is not the maximum"
            found.append(axis.finding("command limits", tick, text, value=limit, limit=most, unit=axis.unit(order)))
    return found


def _no_weaker(axis: Axis, plan: int) -> list[Finding]:
    """A brake that takes over in motion has at least the limits of the plan before it."""
    curves, found = axis.curves, []
    if plan == 0 or not curves.pieces[curves.first[plan], 2:4].any():
        return []
    for name, order in LIMITS:
        before, limit = getattr(curves, name)[plan - 1 : plan + 1].tolist()
        if limit < before * (1.0 - TOLERANCES["limits"].relative):
            text, tick = f"the {name} of a brake is weaker than in the motion that it ends", int(curves.tick[plan])
            found.append(axis.finding("command limits", tick, text, value=limit, limit=before, unit=axis.unit(order)))
    return found
