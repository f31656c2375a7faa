"""What happens, as records: levels, the record itself and the ring that keeps the last ones. No files.

Every part that has something to say appends an `Event`; `record` writes them to a trace. The records are part of
the hash of a run: they hold ticks, never wall-clock time.
"""

from motionlayer.event._device import BLOCK, Device, device_of
from motionlayer.event._digest import Digest, Entry, told
from motionlayer.event._event import Event, EventLog, Kind, Level
from motionlayer.event._input import Input
from motionlayer.event._levels import Levels
from motionlayer.event._message import Lists, MessageList, list_of, text_of
from motionlayer.event._subdevice import Subdevice

__all__ = [
    "BLOCK",
    "Device",
    "Digest",
    "Entry",
    "Event",
    "EventLog",
    "Input",
    "Kind",
    "Level",
    "Levels",
    "Lists",
    "MessageList",
    "Subdevice",
    "device_of",
    "list_of",
    "text_of",
    "told",
]
