"""The runtime: cycle, programs and their waits, clock and watchdog. It knows levels 0 and 1 only.

A `Cycle` runs a list of stages in the order of the steps of a tick; what they do is the business of whoever hands
them over. Programs are coroutines that run in their own step, in the run's own time.
"""

from motionlayer.runtime._clock import PATIENCE, ProgramStuck
from motionlayer.runtime._cycle import Stage, Step
from motionlayer.runtime._program import Cancelled, Program
from motionlayer.runtime._run import CycleFault, Run

__all__ = ["PATIENCE", "Cancelled", "CycleFault", "Program", "ProgramStuck", "Run", "Stage", "Step"]
