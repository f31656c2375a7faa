"""What follows when ticks begin late: a message, and above a limit the brakes.

Being late is measured, and no decision of a run may depend on what was measured. So lateness enters as other things
from outside do: as an input, recorded with the tick that took it. A replay is given the same input and does the same.
"""

import struct
from collections.abc import Callable
from typing import Final

from motionlayer.command import Ledger
from motionlayer.event import Device, Event, EventLog, Input, Kind, Level
from motionlayer.runtime._pace import BRAKE, CATCH_UP

LATE: Final = "late"
"""The channel of the mailbox."""

_TICKS: Final = struct.Struct("<q")


def late_input(tick: int, late: int, slowest: str) -> Input:
    """Return the input that says so.

    Args:
        tick: takes it.
        late: ticks.
        slowest: who took the longest, for the message.
    """
    return Input(tick, LATE, _TICKS.pack(late) + slowest.encode())


class Lateness:
    """The handler of the channel.

    Args:
        ledger: tells the tick.
        events: where it is told.
        brake: called when an incident is more than `BRAKE` ticks late.
    """

    def __init__(self, ledger: Ledger, events: EventLog, brake: Callable[[], object]) -> None:
        self._ledger = ledger
        self._events = events
        self._brake = brake

    def __call__(self, payload: bytes) -> None:
        """Take an input: ticks late (little-endian, 8 bytes), then who was slow.

        Raises:
            struct.error: it is too short.
        """
        (late,) = _TICKS.unpack_from(payload)
        slowest = payload[_TICKS.size :].decode(errors="replace")
        ticks = f"{late} tick{'s' if late > 1 else ''} late"
        if late > BRAKE:
            self._tell(Level.ERROR, f"{ticks}, more than {BRAKE}: all axes brake; {slowest}")
            self._brake()
        elif late > CATCH_UP:
            self._tell(Level.WARNING, f"{ticks}, more than {CATCH_UP}: time slipped; {slowest}")
        else:
            self._tell(Level.WARNING, f"{ticks}, to be caught up; {slowest}")

    def _tell(self, level: Level, text: str) -> None:
        self._events.add(Event(self._ledger.tick, level, Kind.MESSAGE, "runtime", text, device=Device.Device_Main))
