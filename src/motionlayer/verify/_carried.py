"""Where a motion hands over that override 0 has carried past its joint.

A hold brakes without regard to a joint that is to be passed in motion (record 25). It may carry the axis past it, or so
near that its acceleration cannot be taken back before. The motion does not come back then: it hands over where its
acceleration has been taken back, or at rest.

Take v >= 0 at the place p, and a < 0. With the full jerk J the acceleration is zero after t = -a/J, at the velocity
u = v - a²/2J and the place q = p + v t + a t²/3. If u > 0, no way to a velocity >= 0 without acceleration ends before
q; if not, none to rest ends before the shortest stop. So a joint before that place is as good as passed.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from motionlayer.verify._axis import Axis
from motionlayer.verify._stops import stops
from motionlayer.verify._tolerance import Slack


class Place(NamedTuple):
    """A position, and its tolerance, u."""

    position: float
    allowed: float


class Carried:
    """Which plans hand over behind a joint.

    Args:
        axis: whose plans can be evaluated.
        held: whether each plan is a brake under override 0.
    """

    def __init__(self, axis: Axis, held: Sequence[bool]) -> None:
        self._curves, self._held = axis.curves, held
        self._slack = Slack.of(axis.curves)
        self._rest = stops(axis.curves, axis.curves.deceleration, axis.curves.jerk).rest

    def hands_over(self, plan: int, joints: Sequence[Place]) -> bool:
        """Tell whether a plan ends where a motion that was carried past one of the joints may hand over."""
        curves = self._curves
        own = np.flatnonzero(curves.command[:plan] == curves.command[plan])
        speeds = [float(curves.pieces[curves.first[one], 2]) for one in own.tolist() if self._held[one]]
        heading = next((float(np.sign(speed)) for speed in reversed(speeds) if speed != 0.0), 0.0)
        return heading != 0.0 and self._ends_beyond(plan, heading, joints)

    def _ends_beyond(self, plan: int, heading: float, joints: Sequence[Place]) -> bool:
        """Tell whether a plan takes its acceleration back, or stops, and no joint could be met without turning."""
        curves, slack = self._curves, self._slack
        _, p, v, a, _ = curves.pieces[curves.first[plan]].tolist()
        time, jerk = abs(a) / float(curves.jerk[plan]), float(curves.jerk[plan])
        settled, remains, rest = p + time * (v + time * a / 3.0), v + a * abs(a) / (2.0 * jerk), float(self._rest[plan])
        duration, end, speed, _, _ = curves.last_piece()[plan].tolist()
        off = settled if speed != 0.0 else rest
        blur = slack.p[plan] + duration * (slack.v[plan] + duration * slack.a[plan])
        if abs(end - off) > blur or (speed != 0.0 and abs(speed - remains) > slack.v[plan]):
            return False
        nearest = settled if remains * heading > 0.0 else rest
        return any((nearest - joint.position) * heading >= -(joint.allowed + blur) for joint in joints)
