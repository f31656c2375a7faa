"""What a real-time run asks of the interpreter and of the operating system, while it lasts.

======================= =============================================================================================
garbage collection      all that exists is taken out of its reach (`gc.freeze`), and it no longer begins by itself, in
                        the middle of a tick: `collect_young` does it before a wait that is long enough
thread switch interval  0.2 ms instead of 5 ms: how long the cycle may have to wait for another Python thread
timer slack             1 ns instead of 50 µs: by how much Linux may delay a wake-up in order to save power
locked memory           no page is swapped out
SCHED_FIFO              ordinary processes do not displace the cycle; threads started by it are ordinary again
======================= =============================================================================================

Memory and priority need rights. What is refused is kept as a text and is no error: the run is later, not wrong. It is
no event either, because the hash of a run must not depend on the rights of who runs it.
"""

import contextlib
import ctypes
import gc
import os
import resource
import sys
from collections.abc import Iterator
from typing import Final

SWITCH_INTERVAL: Final = 0.0002
"""Seconds for which another Python thread may keep the cycle waiting."""

_MCL_CURRENT, _MCL_FUTURE, _MCL_ONFAULT = 1, 2, 4
_PR_SET_TIMERSLACK, _PR_GET_TIMERSLACK = 29, 30

_WORTH_IT: Final = 500
"""Objects, net of those freed, after which the collector looks at them."""

_PER_OBJECT_NS: Final = 200
"""Time allowed for each; about twice of what it takes."""


class Conditions:
    """Ask for what a real-time run needs, and give it back.

    Args:
        priority: of SCHED_FIFO, 1 to 99; 0 does not ask for it.
        lock_memory: keep all pages in memory.

    Attributes:
        refused: what was asked for in vain, and why; complete while the conditions are held.
        fifo: the thread runs under SCHED_FIFO.
    """

    def __init__(self, priority: int, *, lock_memory: bool) -> None:
        self.refused: list[str] = []
        self.fifo = False
        self._priority = priority
        self._lock_memory = lock_memory

    @contextlib.contextmanager
    def held(self) -> Iterator[None]:
        """Keep the conditions during the block; entered in the thread of the cycle."""
        self.refused.clear()
        with contextlib.ExitStack() as undo:
            undo.enter_context(_collector_held())
            undo.enter_context(_switching_often())
            undo.enter_context(_precise_timers())
            if self._lock_memory:
                self._ask(undo, "locked memory", _locked_memory())
            if self._priority:
                self.fifo = self._ask(undo, f"SCHED_FIFO priority {self._priority}", _fifo(self._priority))
            try:
                yield
            finally:
                self.fifo = False

    def _ask(self, undo: contextlib.ExitStack, what: str, grant: contextlib.AbstractContextManager[None]) -> bool:
        try:
            undo.enter_context(grant)
        except OSError as error:
            self.refused.append(f"{what}: {error.strerror}")
            return False
        return True


def collect_young(spare_ns: int) -> None:
    """Collect what became garbage lately, if a wait of this many nanoseconds leaves the time for it."""
    young = gc.get_count()[0]
    if young > _WORTH_IT and spare_ns > young * _PER_OBJECT_NS:
        gc.collect(1)


@contextlib.contextmanager
def _collector_held() -> Iterator[None]:
    was_on = gc.isenabled()
    gc.collect()
    gc.freeze()
    gc.disable()
    try:
        yield
    finally:
        gc.unfreeze()
        if was_on:
            gc.enable()


@contextlib.contextmanager
def _switching_often() -> Iterator[None]:
    before = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_INTERVAL)
    try:
        yield
    finally:
        sys.setswitchinterval(before)


@contextlib.contextmanager
def _precise_timers() -> Iterator[None]:
    if sys.platform != "linux":
        yield
        return
    system = ctypes.CDLL(None)
    before = system.prctl(_PR_GET_TIMERSLACK, 0, 0, 0, 0)
    system.prctl(_PR_SET_TIMERSLACK, 1, 0, 0, 0)
    try:
        yield
    finally:
        system.prctl(_PR_SET_TIMERSLACK, before, 0, 0, 0)


@contextlib.contextmanager
def _locked_memory() -> Iterator[None]:
    """Lock all pages, each when it is first used.

    Raises:
        OSError: refused.
    """
    limit, _ = resource.getrlimit(resource.RLIMIT_MEMLOCK)
    # Under a limit that is just large enough now, every later allocation could fail.
    if os.geteuid() != 0 and limit != resource.RLIM_INFINITY:
        raise OSError(0, f"the limit is {limit >> 10} KiB; `ulimit -l unlimited` lifts it")
    system = ctypes.CDLL(None, use_errno=True)
    if system.mlockall(_MCL_CURRENT | _MCL_FUTURE | _MCL_ONFAULT) != 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    try:
        yield
    finally:
        system.munlockall()


@contextlib.contextmanager
def _fifo(priority: int) -> Iterator[None]:
    """Schedule this thread first in, first out.

    Raises:
        OSError: refused.
    """
    if not hasattr(os, "sched_setscheduler"):
        raise OSError(0, "this system does not have it")
    before, parameters = os.sched_getscheduler(0), os.sched_getparam(0)
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO | os.SCHED_RESET_ON_FORK, os.sched_param(priority))
    except PermissionError as error:
        raise OSError(error.errno, f"{error.strerror}; `ulimit -r {priority}` or CAP_SYS_NICE allows it") from error
    try:
        yield
    finally:
        # Who lacks the right may not take the flag back either; it does no harm.
        os.sched_setscheduler(0, before | os.SCHED_RESET_ON_FORK, parameters)
