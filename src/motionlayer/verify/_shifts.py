"""How far the coordinate of an axis has been shifted in motion, and when it was redefined at rest."""

from collections.abc import Sequence

import numpy as np

from motionlayer.verify._axis import Axis
from motionlayer.verify._curves import Floats
from motionlayer.verify._lives import Life
from motionlayer.verify._redefinitions import AT_THE_END
from motionlayer.verify._requests import MOTIONS, request


class Shifts:
    """The shifts of a coordinate.

    Args:
        axis: whose plans can be evaluated.
        own: commands of the axis that were not refused.

    Attributes:
        ways: how far the coordinate has been shifted in motion, by each plan and all before it, u; one 0 in front.
    """

    def __init__(self, axis: Axis, own: Sequence[Life]) -> None:
        self._own = own
        self.ways = self._measured(axis)

    def _measured(self, axis: Axis) -> Floats:
        curves, plan = axis.curves, np.arange(len(axis.curves), dtype=np.int64)
        before = np.maximum(plan - 1, 0)
        jump = curves.pieces[curves.first[:-1], 1] - curves.at(before, curves.time(before, curves.tick)).p
        for one in np.flatnonzero(curves.kind == "shift").tolist():
            jump[one] = self._told(int(curves.tick[one]), float(jump[one]))
        return np.concatenate([[0.0], np.cumsum(np.where(curves.kind == "shift", jump, 0.0))])

    def _told(self, tick: int, jump: float) -> float:
        """Return how far a tick shifted a coordinate in motion; a redefinition at rest before it is in `jump` too."""
        last = max((one.number for one in self._own if self.at_rest(one, tick)), default=None)
        if last is None:
            return jump
        later = [request(one.text) for one in self._own if one.accepted == tick and one.number > last]
        shifts = [one for one in later if one.name == "define_position"]
        if not shifts or any(one.flag("clear_offset") for one in shifts):
            return jump
        return sum(one.number("position") for one in shifts)

    def at_rest(self, life: Life, tick: int) -> bool:
        """Tell whether a command redefined the coordinate in a tick, and certainly at rest."""
        name = request(life.text).name
        if name != "define_position":  # one that ends at once redefines nothing, but for a homing
            return name in AT_THE_END and life.ended == tick and (name == "home" or life.accepted < tick)
        before = (one for one in self._own if one.number < life.number and one.accepted <= tick <= one.ended)
        return life.accepted == tick and not any(request(one.text).name in MOTIONS for one in before)
