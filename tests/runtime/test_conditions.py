"""What a real-time run asks of the computer is given back, and what is refused is no error."""

import gc
import os
import sys
import time
from typing import NoReturn

import pytest

from motionlayer.runtime import SYSTEM, Conditions, collect_young
from tests.cli.support import python


def state() -> tuple[object, ...]:
    return gc.isenabled(), gc.get_freeze_count(), sys.getswitchinterval(), os.sched_getscheduler(0) & 0xFF


def test_everything_is_given_back() -> None:
    before = state()
    with Conditions(40, lock_memory=True).held():
        assert not gc.isenabled()
        assert gc.get_freeze_count() > 0
        assert sys.getswitchinterval() == pytest.approx(0.0002)
    assert state() == before


def test_everything_is_given_back_after_a_failure() -> None:
    before = state()
    with pytest.raises(LookupError), Conditions(40, lock_memory=True).held():
        raise LookupError
    assert state() == before


def test_a_collector_that_was_off_stays_off() -> None:
    gc.disable()
    try:
        with Conditions(0, lock_memory=False).held():
            pass
        assert not gc.isenabled()
    finally:
        gc.enable()


def test_what_is_not_asked_for_is_neither_granted_nor_refused() -> None:
    conditions = Conditions(0, lock_memory=False)
    with conditions.held():
        assert not conditions.fifo
        assert os.sched_getscheduler(0) & 0xFF == os.SCHED_OTHER
    assert conditions.refused == []


def test_the_priority_is_granted_or_refused_with_the_way_out() -> None:
    conditions = Conditions(7, lock_memory=False)
    with conditions.held():
        granted = os.sched_getscheduler(0) & 0xFF == os.SCHED_FIFO
        assert conditions.fifo is granted
        assert granted == (conditions.refused == [])
        if granted:
            assert os.sched_getparam(0).sched_priority == 7
    assert not conditions.fifo


REFUSED = """
import os, resource
resource.setrlimit(resource.RLIMIT_RTPRIO, (0, 0))
resource.setrlimit(resource.RLIMIT_MEMLOCK, (65536, 65536))
if os.getuid() == 0:
    os.setgroups([]), os.setgid(65534), os.setuid(65534)
from motionlayer.runtime import Conditions
conditions = Conditions(40, lock_memory=True)
with conditions.held():
    print(conditions.fifo, *conditions.refused, sep="\\n")
"""


def test_without_rights_both_are_refused_and_the_run_goes_on() -> None:
    done = python("-c", "import motionlayer.runtime\n" + REFUSED)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        "False",
        "locked memory: the limit is 64 KiB; `ulimit -l unlimited` lifts it",
        "SCHED_FIFO priority 40: Operation not permitted; `ulimit -r 40` or CAP_SYS_NICE allows it",
    ]


class Node:
    """A cycle of references."""

    def __init__(self) -> None:
        self.me = self


def test_young_garbage_is_collected_where_there_is_time_for_it() -> None:
    with Conditions(0, lock_memory=False).held():
        for _ in range(5000):
            Node()
        waiting = gc.get_count()[0]
        assert waiting > 5000
        collect_young(spare_ns=100_000)
        assert gc.get_count()[0] >= waiting
        collect_young(spare_ns=100_000_000)
        assert gc.get_count()[0] < waiting / 10


@pytest.mark.parametrize("name", ["time", "time_ns", "localtime"])
def test_the_clock_is_not_the_time_of_day(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def forbidden(*_: object) -> NoReturn:
        raise AssertionError("somebody asked for the time of day, which may be set back")

    monkeypatch.setattr(time, name, forbidden)
    before = SYSTEM.now_ns()
    SYSTEM.sleep_until(before + 1000)
    assert SYSTEM.now_ns() >= before + 1000


def test_a_clock_that_is_behind_does_not_sleep() -> None:
    slept: list[float] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(time, "sleep", slept.append)
        SYSTEM.sleep_until(SYSTEM.now_ns() - 1)
    assert slept == []
