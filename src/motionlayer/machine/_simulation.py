"""`Simulation`: a machine that runs faster than real time, without hardware."""

import os
import time
from collections.abc import Sequence

from motionlayer.machine._log_description import LogDescription
from motionlayer.machine._machine import Machine
from motionlayer.machine._machine_run import MachineRun
from motionlayer.machine._programs import Loaded
from motionlayer.runtime import PATIENCE


class Simulation(MachineRun):
    """A run of a machine with simulated drives, deterministic and as fast as the computer allows.

    Args:
        machine: what runs.
        seed: of everything random; that of the machine description where left out.
        trace: True keeps the trace in memory, a path writes it to that file, False records nothing but the
            hash, None not even that.
        programs: started in tick 0, in order; those of the machine description where left out.
        patience: wall time in seconds after which a program that does not yield ends the run.
        log: the message files; True: as the machine description says, False: none.
        statistics: measure what the ticks cost, for `run.statistics`; nothing in the run depends on it.

    Raises:
        LogError: the message files cannot be written.
        ProgramError: a program of the machine description cannot be loaded.
        TraceError: the trace file cannot be written.
    """

    def __init__(
        self,
        machine: Machine,
        *,
        seed: int | None = None,
        trace: bool | str | os.PathLike[str] | None = True,
        programs: Sequence[Loaded] | None = None,
        patience: float = PATIENCE,
        log: LogDescription | bool = True,
        statistics: bool = False,
    ) -> None:
        super().__init__(machine, seed=seed, trace=trace, programs=programs, patience=patience, log=log)
        if statistics:
            self._measure(time.perf_counter_ns)
