"""The first tick of a machine, in which its programs may declare symbols."""

import contextlib
import sys
from collections.abc import Iterator
from pathlib import Path

from motionlayer.cli._exit import ExitCode, Stop
from motionlayer.cli._failure import program_failure
from motionlayer.cli._files import load_machine
from motionlayer.cli._programs import chosen, load
from motionlayer.machine import Simulation


@contextlib.contextmanager
def first_tick(machine: Path) -> Iterator[Simulation]:
    """Run the programs of a machine for one tick, without traces, logs and servers, and yield the run.

    What programs print goes to stderr: stdout is for what the command tells.

    Raises:
        Stop: machine or program cannot be loaded, or a program has failed and may not have declared everything.
    """
    found = load_machine(machine)
    with Simulation(found, programs=load(chosen(found, None)), trace=None, log=False, ads=False) as run:
        with contextlib.redirect_stdout(sys.stderr):
            run.step()
        if run.failures:
            raise Stop(ExitCode.FAILED, program_failure(run.failures[0]))
        yield run
