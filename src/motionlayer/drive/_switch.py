"""The simulated reference switch, or cam: where it is on, and at which of its edges it changed.

d is the distance of the drive position from the edge that a homing looks for, counted into the switch; it is on where
0 <= d <= width. A limit switch has no other edge: its width is infinite.
"""

import math
from typing import NamedTuple

from motionlayer._kernel import kernel


class ReferenceSwitch(NamedTuple):
    """A simulated reference switch.

    Attributes:
        position: drive position of its edge, u.
        side: the switch is on from the edge in this direction (+1, -1).
        width: how far, u, > 0; infinite up to the end of the way.
    """

    position: float
    side: float
    width: float = math.inf


@kernel
def is_on(d: float, width: float) -> float:
    """Return 1 where the switch is on, 0 elsewhere."""
    return 1.0 if 0.0 <= d <= width else 0.0


@kernel
def changed_at(d: float, width: float, inwards: float) -> float:
    """Return the d of the edge at which the switch has just changed.

    Where it went off tells that itself; where it went on does the direction of the motion.

    Args:
        d: where the drive is now.
        width: of the switch.
        inwards: velocity in the direction of growing d; its sign matters.
    """
    far = inwards < 0.0 if is_on(d, width) != 0.0 else d > 0.0
    return width if far and width < math.inf else 0.0
