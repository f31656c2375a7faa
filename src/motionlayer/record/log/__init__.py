"""The message files: one line of text for each message (motion-layer 8).

The cycle thread decides by the level whether a message is written and appends it to a queue; that is all it does.
A thread of its own takes what has come ten times a second, makes lines of it and appends them to the files::

    <folder>/2025_10_24/851_MSG_PLC_2025_10_24.txt        what moves, programs and the run itself
    <folder>/2025_10_24/851_MSG_PLC_2025_10_24_1.txt      the next part, when that one has its size
    <folder>/2025_10_24/851_MSG_Metrics_2025_10_24.txt    counters; only where there are any

*Time.* A line bears the local time `epoch + tick * cycle`: time of the run, so the order of lines is the order of
messages, and a wall clock that is set changes nothing. The time zone is looked up at the start and at each local
midnight (8.3). *Losses.* In simulation the run waits for a writer that is far behind. In real time it never waits,
and a line in the file says how many messages are missing. A disk that is full is one message; lines are kept up to a
bound and tried again, and what exceeds it is counted and marked the same way.

The files are opened for each write and closed after it, as in the original: they may be moved or deleted at any time.
"""

from motionlayer.record.log._errors import LogError
from motionlayer.record.log._log import MessageLog
from motionlayer.record.log._writer import LogFolder
from motionlayer.record.log._zone import LocalTime, local_offset

__all__ = ["LocalTime", "LogError", "LogFolder", "MessageLog", "local_offset"]
