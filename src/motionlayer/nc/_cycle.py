"""What the cycle brings to an axis."""

from collections.abc import Callable
from typing import NamedTuple

from motionlayer.nc._monitors import Monitors, Seen
from motionlayer.store import Ended


class AxisCycle(NamedTuple):
    """What `AxisStage` calls of an axis; programs have no use for it.

    Attributes:
        attach: hands over the monitors of all axes, the list of columns in error (None without groups), and who is told
            the column when another configuration has come into force.
        drive_changed: take up a change of the drive's readiness, status or inputs.
        monitored: take up what the monitors found.
        profile_ended: take up that the profile came to its last piece.
        override_changed: plan anew what only the axis can plan.
    """

    attach: Callable[[Monitors, list[int] | None, Callable[[int], None]], None]
    drive_changed: Callable[[], None]
    monitored: Callable[[Seen], None]
    profile_ended: Callable[[Ended], None]
    override_changed: Callable[[], None]
