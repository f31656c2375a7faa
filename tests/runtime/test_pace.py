"""Pacing, on a clock that the tests move."""

import itertools
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.runtime import BRAKE, CATCH_UP, Pace
from tests.runtime.clock import MS, FakeClock

READ = 50
"""Nanoseconds that a look at the clock costs."""


class Line:
    """A pace, its clock, and what it said."""

    def __init__(self, *, speed: float = 1.0, spin_ns: int = 0, oversleep: int = 0) -> None:
        self.clock = FakeClock(read_ns=READ, oversleep=lambda: oversleep)
        self.reports: list[int] = []
        self.slips: list[int] = []
        self.tick = 0
        self.pace = Pace(
            MS, self.clock, report=self.reports.append, slipped=self.slips.append, speed=speed, spin_ns=spin_ns
        )
        self.pace.start(0)
        self.start = self.clock.now

    def run(self, *works: int) -> list[int]:
        """Run a tick for each compute time (ns); return when each began, since the start."""
        begun = []
        for work in works:
            self.pace.wait(self.tick)
            self.tick += 1
            begun.append(self.clock.now - self.start)
            self.clock.work(work)
        return begun


@pytest.mark.parametrize("speed", [0.01, 0.3, 1.0, 7.0, 1000.0])
def test_ticks_begin_at_absolute_instants_and_time_never_drifts(speed: float) -> None:
    line = Line(speed=speed)
    begun = line.run(*[100] * 10_000)
    period = MS / Fraction(str(speed))
    for tick, instant in enumerate(begun):
        due = tick * period
        assert -1 < instant - due <= 3 * READ, tick
    assert line.pace.overruns == line.pace.slips == 0
    assert not line.reports


def test_a_whole_day_is_exact() -> None:
    line = Line(speed=0.3)
    last = 86_400_000
    line.pace.wait(last)
    assert line.clock.now - line.start - last * MS * 10 // 3 <= 3 * READ


def test_up_to_five_late_ticks_run_back_to_back() -> None:
    line = Line()
    begun = line.run(0, int(6.5 * MS), *[1000] * 8)
    late = [(instant - tick * MS) // MS for tick, instant in enumerate(begun)]
    assert late == [0, 0, 5, 4, 3, 2, 1, 0, 0, 0]
    assert line.pace.overruns == 5
    assert line.pace.slips == 0
    assert line.reports == [5]
    assert begun[8] - 8 * MS <= 3 * READ  # caught up: the instants have not moved


def test_more_than_five_late_ticks_let_time_slip_to_the_next_whole_tick() -> None:
    line = Line()
    begun = line.run(0, int(7.5 * MS), 1000, 1000)
    assert [round(instant / MS, 2) for instant in begun] == [0, 1, 9, 10]
    assert (line.pace.overruns, line.pace.slips, line.pace.slipped_ns) == (1, 1, 7 * MS)
    assert line.slips == [7 * MS]
    assert line.reports == [6]


def test_a_suspended_computer_is_one_slip_and_one_message() -> None:
    line = Line()
    hours = 3 * 3600 * 1000
    begun = line.run(0, hours * MS, *[1000] * 1000)
    assert (line.pace.overruns, line.pace.slips) == (1, 1)
    assert line.reports == [hours - 1]
    assert begun[-1] - begun[2] == pytest.approx(999 * MS, abs=3 * READ)


def test_a_late_wake_up_is_late_as_well() -> None:
    clock = FakeClock(oversleep=itertools.chain([0, 12 * MS], itertools.repeat(0)).__next__)
    reports: list[int] = []
    pace = Pace(MS, clock, report=reports.append)
    for tick in range(10):
        pace.wait(tick)
    assert reports == [12]


@pytest.mark.parametrize("share", [1.02, 1.5, 4.0, 7.0, 30.0])
def test_a_cycle_that_is_always_too_long_passes_every_limit_once(share: float) -> None:
    line = Line()
    line.run(*[int(share * MS)] * 1500)
    assert [late > BRAKE for late in line.reports].count(True) == 1
    assert line.reports[-1] > BRAKE
    assert len(line.reports) <= 3
    # Under SCHED_FIFO this is what leaves time for others: every slip ends in a sleep.
    assert len(line.clock.sleeps) >= line.pace.slips > 0


def test_braking_is_told_once_in_every_incident() -> None:
    line = Line()
    for _ in range(3):
        line.run(int(12.5 * MS), *[1000] * 3)
    assert line.reports == [11, 11, 11]
    assert line.pace.brakes == 3


def test_warnings_come_once_a_second_and_all_overruns_are_counted() -> None:
    line = Line()
    for _ in range(500):
        line.run(int(2.5 * MS), *[1000] * 3)
    assert line.reports == [1, 1]  # in two seconds
    assert line.pace.overruns == 500


def test_faster_than_real_time_a_late_tick_is_a_base_cycle_of_the_clock() -> None:
    line = Line(speed=10.0)
    begun = line.run(0, int(4.15 * MS), *[1000] * 60)
    assert line.pace.slips == 0
    assert line.pace.overruns > 3
    assert line.reports == [4]
    assert begun[-1] - 61 * MS // 10 <= 3 * READ  # caught up


def test_slower_than_real_time_a_late_tick_is_a_tick() -> None:
    line = Line(speed=0.1)
    line.run(0, 19 * MS, 1000, 31 * MS, *[1000] * 4)
    assert line.pace.overruns == 2  # 9 ms late is none; 21 ms are two ticks, then one
    assert line.reports == [2]


def test_it_spins_no_longer_than_it_may_and_begins_on_time() -> None:
    line = Line(spin_ns=100_000, oversleep=60_000)
    begun = line.run(*[100_000] * 100)
    lateness = [instant - tick * MS for tick, instant in enumerate(begun)]
    assert lateness[1] >= 60_000  # it has to learn
    assert max(lateness[2:]) <= 3 * READ
    assert line.clock.reads < 100 * 70_000 // READ


def test_a_sleep_that_is_later_than_the_longest_spin_does_not_lengthen_it() -> None:
    line = Line(spin_ns=100_000, oversleep=300_000)
    begun = line.run(*[100_000] * 100)
    assert max(instant - tick * MS for tick, instant in enumerate(begun)) <= 300_000 + 3 * READ
    assert line.pace.lateness.spread.median == pytest.approx(200_000, rel=1 / 32)


def test_without_a_spin_it_looks_at_the_clock_a_few_times_a_tick() -> None:
    line = Line(oversleep=300)
    line.run(*[100_000] * 1000)
    assert line.clock.reads < 3 * 1000 + 10


def test_a_new_start_makes_the_next_tick_due_at_once() -> None:
    line = Line()
    line.run(*[1000] * 5)
    line.clock.work(3_600_000 * MS)  # paused
    line.pace.start(line.tick)
    line.run(*[1000] * 5)
    assert line.pace.overruns == 0
    assert not line.reports


@pytest.mark.parametrize("speed", [0.0, -1.0, 0.009, 1001.0, float("nan"), float("inf")])
def test_a_speed_out_of_range(speed: float) -> None:
    with pytest.raises(ValueError, match=r"must be 0\.01 to 1000 \(times real time\)"):
        Line(speed=speed)


@given(
    works=st.lists(st.integers(0, 20 * MS) | st.integers(0, MS), min_size=2, max_size=60),
    speed=st.sampled_from([0.5, 1.0, 3.0]),
    oversleep=st.integers(0, 3 * MS),
)
def test_whatever_happens(works: list[int], speed: float, oversleep: int) -> None:
    """No tick is early, every late one is counted, time is lost by slips alone, and never in catching up."""
    line = Line(speed=speed, oversleep=oversleep)
    period = MS / Fraction(str(speed))
    unit = max(MS, int(period))
    late = 0
    for tick, work in enumerate(works):
        lost, slips = line.pace.slipped_ns, line.pace.slips
        begun = line.run(work)[0]
        behind = begun - tick * period - lost
        assert behind > -1
        if line.pace.slips == slips:
            late += behind >= unit
            assert behind < (CATCH_UP + 1) * unit
        else:
            late += 1
            assert begun - tick * period >= line.pace.slipped_ns  # it waited for the next whole tick
    assert line.pace.overruns == late
    assert line.pace.lateness.count == len(works)
    assert sum(line.slips) == line.pace.slipped_ns
    assert all(one % unit == 0 for one in line.slips)
