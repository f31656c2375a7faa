"""Recording a run: the capture of every tick, and the plans and events that go with it."""

import platform
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from motionlayer import __version__, _kernel
from motionlayer.machine._build import Parts
from motionlayer.machine._machine import Machine
from motionlayer.machine._plans import followed, redefinition
from motionlayer.machine._programs import Loaded
from motionlayer.machine._signals import signals_of
from motionlayer.record import Recorder, Trace


class Tracing:
    """The observer that records.

    Args:
        machine: goes into the header.
        parts: what is recorded.
        seed: goes into the header.
        programs: go into the header.
        path: the file, None for memory.
        keep: False takes the hash alone.
    """

    def __init__(
        self,
        machine: Machine,
        parts: Parts,
        seed: int,
        programs: Sequence[Loaded],
        path: Path | None,
        *,
        keep: bool,
    ) -> None:
        signals = signals_of(machine.description, parts.store) if keep else []
        self._store = parts.store
        self._axes = list(parts.axes.values())
        self._recorder = Recorder(parts.store.table, signals, header(machine, seed, programs), path)
        parts.events.listen(self._recorder.event)

    def capture(self, tick: int) -> None:
        """Record everything valid at this tick."""
        store = self._store
        # Of several redefinitions in one tick only the last counts, and likewise of profiles.
        for (column, since), position in {
            (column, since): position for column, since, position in store.placed
        }.items():
            self._recorder.plan(redefinition(self._axes[column], since, position))
        for column in store.taken_over:
            self._recorder.plan(followed(self._axes[column], column, store))
        store.forget_plans()
        self._recorder.capture(tick)

    def close(self) -> str:
        """End the recording; return the hash of the run."""
        return self._recorder.close()

    def trace(self) -> Trace:
        """End the recording and return it."""
        return self._recorder.trace()


def header(machine: Machine, seed: int, programs: Sequence[Loaded]) -> dict[str, Any]:
    """Return the header of a trace: all that is needed to run it again, and what it ran on."""
    return {
        "format": 1,
        "product": f"motionlayer {__version__}",
        "base_cycle_ns": machine.description.base_cycle_ns,
        "seed": seed,
        "machine": machine.description.model_dump(mode="json"),
        "programs": [{"name": p.name, "file": p.file, "sha256": p.sha256} for p in programs],
        "installation": {
            "python": sys.version.split()[0],
            "numpy": np.__version__,
            "numba": version("numba"),
            "kernels": _kernel.MODE,
            "system": platform.system(),
            "processor": platform.machine(),
        },
    }
