"""`Simulation`: a machine that runs faster than real time, without hardware."""

import time
from typing import Unpack

from motionlayer.machine._machine import Machine
from motionlayer.machine._machine_run import MachineRun
from motionlayer.machine._run_keywords import SimulationKeywords, require_call


class Simulation(MachineRun):
    """A run of a machine with simulated drives, deterministic and as fast as the computer allows.

    Args:
        machine: what runs.
        **keywords: see `SimulationKeywords`.

    Raises:
        LogError: the message files cannot be written.
        MachineError: the file of persistent parameters means nothing.
        ProgramError: a program of the machine description cannot be loaded.
        ServerFailed: the ADS server cannot begin.
        TraceError: the trace file cannot be written.
        TypeError: it is no machine, or there is no such keyword.
    """

    def __init__(self, machine: Machine, **keywords: Unpack[SimulationKeywords]) -> None:
        require_call("Simulation", machine, SimulationKeywords, keywords)
        super().__init__(machine, keywords, lossless=True)
        if keywords.get("statistics", False):
            self._measure(time.perf_counter_ns)
