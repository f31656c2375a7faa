"""The runtime: cycle, programs and their waits, clock and watchdog. It knows levels 0 and 1 only.

A `Run` calls a list of stages in the order of the steps of a tick; what they do is the business of whoever hands
them over. Programs are coroutines, or functions that tasks call; they run in their own step, in the run's own time.
What comes from other threads is posted to the mailbox; what they may see lies in areas. A `Pace` holds back each tick
in real time, and a `Meter` measures it; what they find reaches a run as a recorded input or not at all. A `SteppedRun`
can be held up, stopped at events, copied and taken back.
"""

from motionlayer.runtime._areas import Area, Areas
from motionlayer.runtime._breakpoints import Breakpoint
from motionlayer.runtime._clock import SYSTEM, Clock, SystemClock
from motionlayer.runtime._conditions import Conditions, collect_young
from motionlayer.runtime._cycle import Stage, Step
from motionlayer.runtime._cyclic import CyclicProgram, takes_memory
from motionlayer.runtime._failure import describe, said
from motionlayer.runtime._guest import Guest
from motionlayer.runtime._history import GRAIN, History
from motionlayer.runtime._lateness import LATE, Lateness, late_input
from motionlayer.runtime._mailbox import Mailbox, MailboxFull
from motionlayer.runtime._meter import Meter
from motionlayer.runtime._pace import BRAKE, CATCH_UP, FASTEST, SLOWEST, Pace
from motionlayer.runtime._program import Cancelled, Issuer, Program
from motionlayer.runtime._published import Published
from motionlayer.runtime._receipt import Receipt
from motionlayer.runtime._run import Run
from motionlayer.runtime._snapshot import Snapshot
from motionlayer.runtime._source import Source
from motionlayer.runtime._statistics import Histogram, Spread, Statistics
from motionlayer.runtime._stepping import SteppedRun
from motionlayer.runtime._tasks import BUDGET, MAIN, Task, TaskConfig, Tasks, heaviest
from motionlayer.runtime._ticking import CycleFault
from motionlayer.runtime._watchdog import PATIENCE, ProgramStuck
from motionlayer.runtime.copying import NotCopyable

__all__ = [
    "BRAKE",
    "BUDGET",
    "CATCH_UP",
    "FASTEST",
    "GRAIN",
    "LATE",
    "MAIN",
    "PATIENCE",
    "SLOWEST",
    "SYSTEM",
    "Area",
    "Areas",
    "Breakpoint",
    "Cancelled",
    "Clock",
    "Conditions",
    "CycleFault",
    "CyclicProgram",
    "Guest",
    "Histogram",
    "History",
    "Issuer",
    "Lateness",
    "Mailbox",
    "MailboxFull",
    "Meter",
    "NotCopyable",
    "Pace",
    "Program",
    "ProgramStuck",
    "Published",
    "Receipt",
    "Run",
    "Snapshot",
    "Source",
    "Spread",
    "Stage",
    "Statistics",
    "Step",
    "SteppedRun",
    "SystemClock",
    "Task",
    "TaskConfig",
    "Tasks",
    "collect_young",
    "describe",
    "heaviest",
    "late_input",
    "said",
    "takes_memory",
]
