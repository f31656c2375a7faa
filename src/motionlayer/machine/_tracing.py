"""Recording a run: the capture of every tick, and the plans and events that go with it."""

import contextlib
import platform
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any, Final

import numpy as np

from motionlayer import __version__, _kernel
from motionlayer.machine._build import Parts
from motionlayer.machine._machine import Machine
from motionlayer.machine._outside import Told
from motionlayer.machine._plans import followed, redefinition, shift
from motionlayer.machine._programs import Loaded
from motionlayer.machine._signals import signals_of
from motionlayer.record import End, Mark, Recorder, Trace
from motionlayer.runtime import Mailbox, MailboxFull

CHANNEL: Final = "trace"
"""The channel of the mailbox by which trouble with the writer of a trace enters the run."""


class Tracing:
    """The observer that records.

    Args:
        machine: goes into the header.
        parts: what is recorded.
        seed: goes into the header.
        programs: go into the header.
        path: the file, None for memory.
        keep: False takes the hash alone.
        lossless: False for real time: the cycle never waits for the writer, and its trouble is told as a warning.
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
        lossless: bool = True,
    ) -> None:
        signals = signals_of(machine.description, parts.store) if keep else []
        self._told = Told(parts.events, parts.ledger, CHANNEL)
        self._store = parts.store
        self._mailbox: Mailbox | None = None
        self._axes = list(parts.axes.values())
        self._recorder = Recorder(
            parts.store.table,
            signals,
            header(machine, seed, programs),
            path,
            keep=keep,
            lossless=lossless,
            warn=self._warn,
        )
        parts.events.listen(self._recorder.event)
        parts.store.begun = self._begun

    def capture(self, tick: int) -> None:
        """Record everything valid at this tick."""
        store = self._store
        # Of several redefinitions in one tick only the last counts, and likewise of profiles.
        for (column, since), position in {
            (column, since): position for column, since, position in store.placed
        }.items():
            if (column, since) not in store.shifted:
                self._recorder.plan(redefinition(self._axes[column], since, position))
        for column, since in dict.fromkeys(store.shifted):
            self._recorder.plan(shift(self._axes[column], column, since, store))
        for column in store.taken_over:
            self._recorder.plan(followed(self._axes[column], column, store))
        store.forget_plans()
        self._recorder.capture(tick)

    def _begun(self, column: int) -> None:
        """Record a profile that took over inside a cycle, before anything can replace it."""
        self._recorder.plan(followed(self._axes[column], column, self._store))

    def attach(self, mailbox: Mailbox) -> None:
        """Record what comes from outside from now on, trouble of the writer among it: that depends on the computer."""
        self._mailbox = mailbox
        mailbox.register(CHANNEL, self._told)
        mailbox.listen(self._recorder.input)

    def _warn(self, text: str) -> None:
        """Hand trouble to the next tick."""
        assert self._mailbox is not None
        with contextlib.suppress(MailboxFull):  # the trace names the gap itself
            self._mailbox.post(CHANNEL, text.encode())

    def mark(self) -> Mark | None:
        """Return a mark that the recording can go back to; None if it is written to a file."""
        return self._recorder.mark() if self.in_memory else None

    @property
    def in_memory(self) -> bool:
        """The recording can go back: it is not written to a file."""
        return self._recorder.in_memory

    def require_memory(self) -> None:
        """Make sure that the recording can go back.

        Raises:
            TraceError: it is written to a file.
        """
        self._recorder.require_memory()

    def go_back(self, mark: Mark, **changes: object) -> None:
        """Forget what was recorded since a mark, and change the header."""
        self._recorder.go_back(mark, changes)

    def close(self, end: End | None = None) -> str:
        """End the recording; return the hash of the run."""
        return self._recorder.close(end)

    def trace(self, end: End | None = None) -> Trace:
        """End the recording and return it."""
        return self._recorder.trace(end)


def header(machine: Machine, seed: int, programs: Sequence[Loaded]) -> dict[str, Any]:
    """Return the header of a trace: all that is needed to run it again, and what it ran on."""
    return {
        "format": 1,
        "product": f"motionlayer {__version__}",
        "base_cycle_ns": machine.description.base_cycle_ns,
        "seed": seed,
        "machine": machine.description.model_dump(mode="json"),
        "programs": [_program(program) for program in programs],
        "installation": {
            "python": sys.version.split()[0],
            "numpy": np.__version__,
            "numba": version("numba"),
            "kernels": _kernel.MODE,
            "system": platform.system(),
            "processor": platform.machine(),
        },
    }


def _program(program: Loaded) -> dict[str, Any]:
    """Return what it takes to load a program again, and to tell whether it is still the same."""
    told: dict[str, Any] = {"name": program.name, "file": program.file, "sha256": program.sha256}
    source = program.source
    if source is not None:
        told |= {
            "path": str(source.file.resolve()),
            "function": source.function,
            "task": source.task,
            "prefix": source.prefix,
        }
    return told
