"""What things cost: measured on this computer, side by side with peers, in one run.

A *group* is a tuple of rows; `GROUPS` lists them. A *row* names what is measured, its unit, its goal and, where
there is one, the peer. How numbers come about:

- Inside the process: warm up, switch the garbage collector off, take the median of many single calls in
  microseconds. One call is timed as it is, with everything it does.
- The command: `python -m motionlayer ...` in a process of its own, from its start until it has ended; nothing is
  subtracted. The median of several.
- Recording runs in two threads. What counts for the cycle is the processor time of its thread; the wall time, which
  in a simulation includes waiting for the writer, is told in a note. The share of a core counts both threads.
- Numbers that must hold rather than be quick (`numerics`) are the worst of many random cases, made from a seed.
- What clients see (`ads`) is measured by clients in processes of their own, beside a run in real time.
- Peers are packages from PyPI in pinned versions. They live in an environment of their own in the user's cache
  folder, set up on first use. A peer that cannot be had leaves its cell empty.

A peer does not do the same as we do, only the nearest it offers: `ruckig` plans alone, without a command, a state
machine or a check; `pyplcopen` runs an axis with its state machine per call, which is more than sampling a row and
about what a complete cycle is.

Every run is appended to a history file with date, commit and computer.

This part and the edge of `runtime` are the only ones that look at the wall clock.
"""

from motionlayer.bench._environment import Environment
from motionlayer.bench._row import Effort, Failed, Figure, Goal, Peer, Row, Skipped
from motionlayer.bench._run import GROUPS, run, show_history

__all__ = [
    "GROUPS",
    "Effort",
    "Environment",
    "Failed",
    "Figure",
    "Goal",
    "Peer",
    "Row",
    "Skipped",
    "run",
    "show_history",
]
