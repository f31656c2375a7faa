"""`Levels`: which messages are of interest, by the levels of the objects they speak of (motion-layer 8.8).

A message is written when the level of its object is at least the level of its gate. The gates of 8.7, by what a
record holds:

======================================= ==== =========================================
messages                                gate written at the level
======================================= ==== =========================================
errors, counters (batch)                E    always
information of a start-up, of a gearing E    always
warnings, information                   I    WARNING and finer
the same of touch probe and trigger box X    INFO and finer
verbose                                 V    VERBOSE and finer (D43: "at least", not "equal")
sentient                                     SENTIENT
======================================= ==== =========================================
"""

from typing import Final

from motionlayer.event._device import BLOCK, Device
from motionlayer.event._event import Event, Level
from motionlayer.event._subdevice import Subdevice

_LEAST: Final = (0, 0, 0, 3, 3, 5, 6)
"""By the level of a message: the least level of its object at which it is written."""

_XFC: Final = (Device.XfcTriggerBox, Device.XfcTouchProbe)
"""Blocks whose gate is X."""

_UNGATED: Final = frozenset(
    int(one)
    for one in (
        Subdevice.MainInit,
        Subdevice.NciStartUp,
        Subdevice.CamStartUp,
        Subdevice.FlyingSawStartUp,
        Subdevice.AxisIdle,
        Subdevice.fbGearIn,
        Subdevice.fbGearOut,
        Subdevice.fbGearInMultiMaster,
    )
)
"""Parts whose information is always written."""


class Levels:
    """One level for all, and one for each object that was given its own.

    Args:
        level: of every object without a level of its own; errors are written at any.
    """

    def __init__(self, level: Level = Level.INFO) -> None:
        self.level = level
        self._own: dict[int, Level] = {}

    def level_of(self, device: int) -> Level:
        """Return the level in force for a device."""
        return self._own.get(device, self.level)

    def set_level(self, device: int, level: Level | None) -> None:
        """Give a device a level of its own; None takes it back."""
        if level is None:
            self._own.pop(device, None)
        else:
            self._own[device] = level

    def passes(self, event: Event) -> bool:
        """Tell whether a message is to be written. Called for every record, in the cycle."""
        level = self._own.get(event.device, self.level) if self._own else self.level
        said = event.level
        if level < _LEAST[said]:
            return said == Level.INFO and event.subdevice in _UNGATED
        # Only the gate X asks for more than the level of the message says.
        return level >= Level.INFO or said <= Level.ERROR or event.device // BLOCK * BLOCK not in _XFC
