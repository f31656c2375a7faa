"""To stay awake for what comes soon, as long as that is of use."""

from collections.abc import Callable

import pytest

from motionlayer.connect.ads._awake import REST, Awake

STEP = 0.001
"""Seconds that a look takes."""


class Clock:
    """Goes on by a step whenever others are given way to."""

    def __init__(self) -> None:
        self.time = 5.0
        self.looks = 0

    def now(self) -> float:
        return self.time

    def give_way(self) -> None:
        self.time += STEP

    def coming_at(self, time: float) -> Callable[[], bool]:
        def come() -> bool:
            self.looks += 1
            return self.time >= time

        return come


@pytest.fixture
def clock() -> Clock:
    return Clock()


def awake(clock: Clock, cores: int = 2) -> Awake:
    return Awake(cores, clock.now, clock.give_way)


def test_what_comes_in_time_is_seen_at_once(clock: Clock) -> None:
    one = awake(clock)
    for _ in range(5):
        at = clock.time + 3.5 * STEP
        assert one.until(clock.coming_at(at), clock.time + 10 * STEP)
        assert clock.time == pytest.approx(at + 0.5 * STEP)


def test_after_it_was_in_vain_nobody_looks_for_a_while(clock: Clock) -> None:
    one = awake(clock)
    never = clock.coming_at(1e9)
    assert not one.until(never, clock.time + 4.5 * STEP)
    assert clock.looks == 5
    slept = clock.time
    while clock.time < slept + REST - 0.5 * STEP:
        assert not one.until(never, clock.time + STEP)
        clock.time += STEP
    assert clock.looks == 5
    assert one.until(clock.coming_at(0.0), clock.time + STEP)


def test_a_moment_that_is_over_costs_nothing(clock: Clock) -> None:
    one = awake(clock)
    assert not one.until(clock.coming_at(0.0), clock.time)
    assert clock.looks == 0


def test_with_one_core_nobody_stays_awake(clock: Clock) -> None:
    assert not awake(clock, cores=1).until(clock.coming_at(0.0), clock.time + STEP)
    assert clock.looks == 0
