"""What reaches a run of a machine from outside, as inputs: a trace holds them, and a replay does the same.

The owner of the run may let a drive fail or stop all axes between two ticks. Trouble with files comes from the threads
that write them, when they notice it.
"""

import json
from typing import Final

from motionlayer.command import Ledger
from motionlayer.drive import Fault
from motionlayer.event import Device, Event, EventLog, Kind, Level, Subdevice

INJECT: Final = "inject"
"""The channel of faults."""

EMERGENCY_STOP: Final = "emergency_stop"
"""The channel of emergency stops; its payload is empty."""

REFUSED: Final = "ads.refused"
"""The channel by which the ADS server tells whom it has refused."""

LINK: Final = "link"
"""The channel by which the link of a control side tells that its connection is broken."""


def pack_fault(axis: str, fault: Fault, tick: int) -> bytes:
    """Return the payload of `INJECT`."""
    return json.dumps([axis, str(fault.kind), fault.value, fault.duration, tick]).encode()


def unpack_fault(payload: bytes) -> tuple[str, Fault, int]:
    """Return axis, fault and tick of a payload of `INJECT`.

    Raises:
        ValueError: it is none.
    """
    axis, kind, value, duration, tick = json.loads(payload)
    return axis, Fault(kind, value, duration), tick


class Told:
    """The handler of a channel by which a thread tells of trouble: its text becomes a warning.

    Args:
        events: where it is told.
        ledger: tells the tick.
        source: who has the trouble.
    """

    def __init__(self, events: EventLog, ledger: Ledger, source: str) -> None:
        self._events = events
        self._ledger = ledger
        self._source = source

    def __call__(self, payload: bytes) -> None:
        """Take in a text."""
        text = payload.decode(errors="replace")
        device, part = Device.Device_Main, Subdevice.General
        self._events.add(Event(self._ledger.tick, Level.WARNING, Kind.MESSAGE, self._source, text, 0, 0, device, part))
