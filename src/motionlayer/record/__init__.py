"""What a run leaves behind: the trace, its hash and the way from one to the other.

A trace is a JSON header followed by chunks. All integers are little-endian, all floats are float64::

    file    magic (8)  header length u32  header crc32 u32  header (JSON)  chunk*
    chunk   tag (4)  payload length u64  crc32 of tag, length and payload u32  payload
    ROWS    first tick i64  ticks u32  signals u32  kind of each column u8, then the columns grouped by kind
    PLAN    one profile that a coordinate took over
    EVNT    one event record (JSON)
    INPT    one input from outside: tick i64, length of the channel's name u32, the name, the payload
    GAP     what is missing: first tick i64, ticks u64, records u64
    TAIL    JSON: ticks, hash, how the run ended; absent when the writer did not come to its end

A column of a block is stored as one value if all its bits agree, as differences of integers times the
resolution of its signal if that signal is quantised, and else as it is. Plans, events and inputs are written before
the rows that show them. The encoder is the same for files and memory.

A file is read up to its last whole chunk. If it ends there, or inside of the next chunk, its writer was killed: the
trace is incomplete. Anything else is damage, and `Trace.damage` names it: a checksum or a length that does not fit,
bytes that are no chunk, an end that counts other ticks than there are rows, bytes behind that end.

In the cycle a `Recorder` copies one row with one kernel call. Full blocks go to a thread that encodes, writes
and hashes them. In simulation three blocks exist, and when none is free the run waits, so nothing is lost. In real
time the cycle never waits: there are more blocks, each of a fifth of a second at most, and when none is free rows are
dropped, until one is. Their number is written as a gap; plans, events and inputs are kept, up to a bound, beyond which
they are counted in the gap as well. The thread shares the GIL with the cycle: its kernels work on some thousand values
at a time, some ten microseconds a call, and checksums, hash and file let go of it.

The hash of a run is a BLAKE2b of two others and the number of ticks: one over set position, velocity,
acceleration and actual position of all coordinates, tick by tick, one over the event records. It depends
neither on the block size, nor on the signals that were selected, nor on whether there is a file, nor on the inputs,
which are causes, not effects. A run of which something is missing has no hash.

A recording in memory, or a hash alone, can go back to a `Mark`: encoded chunks never change, and a hash can be copied.
What has been written to a file stays.

Plots are in `motionlayer.record.plot`, which is imported only by those who draw.
"""

from motionlayer.record._difference import Difference, difference
from motionlayer.record._errors import TraceError
from motionlayer.record._recorder import Recorder
from motionlayer.record._records import End, Gap, Plan, Signal
from motionlayer.record._sink import Mark
from motionlayer.record._trace import Trace
from motionlayer.record._writer import TraceWriter

__all__ = [
    "Difference",
    "End",
    "Gap",
    "Mark",
    "Plan",
    "Recorder",
    "Signal",
    "Trace",
    "TraceError",
    "TraceWriter",
    "difference",
]
