"""What happens, as records: levels, the record itself and the ring that keeps the last ones. No files.

Every part that has something to say appends an `Event`; `record` writes them to a trace. The records are part of
the hash of a run: they hold ticks, never wall-clock time.
"""

from motionlayer.event._event import Event, EventLog, Kind, Level

__all__ = ["Event", "EventLog", "Kind", "Level"]
