from collections.abc import Callable
from datetime import UTC, datetime
from zoneinfo import ZoneInfo

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.record.log import LocalTime
from motionlayer.record.log._zone import Shift
from tests.record.log.support import CYCLE, SECOND, at, local, utc

HOUR = 3600


def offset_in(name: str) -> Callable[[int], int]:
    """Return what looks up the offset of a zone, by another way than the one of the log."""
    zone = ZoneInfo(name)

    def offset(second: int) -> int:
        found = datetime.fromtimestamp(second, zone).utcoffset()
        assert found is not None
        return round(found.total_seconds())

    return offset


def in_seconds(begin: str, zone: str = "Europe/Berlin") -> LocalTime:
    """Return the local time of ticks of one second from a time in UTC on."""
    return LocalTime(at(begin), SECOND, offset_in(zone))


def test_the_text_of_a_tick() -> None:
    time = local()
    assert time.text(0) == "2025-10-24-13:00:00.000"
    assert time.text(18_408) == "2025-10-24-13:00:18.408"
    assert time.date == "2025_10_24"


def test_milliseconds_are_cut_not_rounded() -> None:
    time = LocalTime(at("2025-01-01T00:00:00"), 50_000, utc)
    assert [time.text(tick)[-6:] for tick in (19, 20, 39, 40)] == ["00.000", "00.001", "00.001", "00.002"]


@given(
    st.datetimes(datetime(1971, 1, 1), datetime(2100, 1, 1)),  # noqa: DTZ001 - as hypothesis wants it
    st.lists(st.integers(0, 10**8), min_size=1, max_size=20).map(sorted),
)
def test_without_a_zone_it_is_the_calendar(begin: datetime, ticks: list[int]) -> None:
    epoch = at(begin.isoformat())
    time = LocalTime(epoch, CYCLE, utc)
    for tick in ticks:
        expected = datetime.fromtimestamp((epoch // CYCLE + tick) / 1000, UTC)
        text = time.text(tick)
        assert text[:19] == expected.strftime("%Y-%m-%d-%H:%M:%S")
        assert abs(int(text[20:]) * 1000 - expected.microsecond) < 1000
        assert time.date == expected.strftime("%Y_%m_%d")


def test_a_slip_moves_what_comes_after_it() -> None:
    time = local()
    assert time.text(10) == "2025-10-24-13:00:00.010"
    time.slip(5 * SECOND)
    assert time.text(10) == "2025-10-24-13:00:05.010"
    assert time.text(11) == "2025-10-24-13:00:05.011"


def test_the_zone_is_that_of_the_start_until_midnight_when_summer_begins() -> None:
    time = in_seconds("2025-03-29T23:00:00")  # 2025-03-30 00:00 in Berlin; at 02:00 clocks go to 03:00
    assert time.text(4 * HOUR) == "2025-03-30-04:00:00.000"
    assert time.text(24 * HOUR - 1) == "2025-03-30-23:59:59.000"
    assert time.text(24 * HOUR) == "2025-03-31-01:00:00.000"
    assert time.shift == Shift(HOUR, 2 * HOUR)
    assert time.date == "2025_03_31"


def test_the_last_hour_comes_twice_when_summer_ends() -> None:
    time = in_seconds("2025-10-25T22:00:00")  # 2025-10-26 00:00 in Berlin; at 03:00 clocks go to 02:00
    assert time.text(24 * HOUR - 1) == "2025-10-26-23:59:59.000"
    passed = time.midnights
    assert time.text(24 * HOUR) == "2025-10-26-23:00:00.000"
    assert (time.midnights, time.date) == (passed + 1, "2025_10_26")
    assert time.shift == Shift(2 * HOUR, HOUR)
    assert time.text(25 * HOUR) == "2025-10-27-00:00:00.000"
    assert time.shift is None


@pytest.mark.parametrize("zone", ["Europe/Berlin", "America/New_York", "Asia/Kathmandu", "Australia/Lord_Howe"])
def test_each_day_begins_with_the_offset_that_is_in_force_there(zone: str) -> None:
    time, offset = in_seconds("2025-01-01T00:30:00", zone), offset_in(zone)
    begin = at("2025-01-01T00:30:00") // SECOND
    for tick in range(0, 400 * 24 * HOUR, 1800):
        text = time.text(tick)
        shown = at(f"{text[:10]}T{text[11:19]}") // SECOND - (begin + tick)
        # A change of the clocks is taken over at the next midnight, so within a day.
        assert shown in {offset(begin + tick), offset(begin + tick - 24 * HOUR)}


@given(st.integers(1, 800 * 24), st.sampled_from(["Europe/Berlin", "America/New_York", "Australia/Lord_Howe"]))
def test_hours_without_messages_change_nothing(hours: int, zone: str) -> None:
    silent, busy = in_seconds("2025-01-01T12:00:00", zone), in_seconds("2025-01-01T12:00:00", zone)
    for day in range(hours // 24):
        busy.text(day * 24 * HOUR)
    assert silent.text(hours * HOUR) == busy.text(hours * HOUR)
    assert silent.date == busy.date
    next_day = (hours + 24) * HOUR
    assert silent.text(next_day) == busy.text(next_day)


def test_decades_are_one_step() -> None:
    looked_up: list[int] = []

    def offset(second: int) -> int:
        looked_up.append(second)
        return HOUR

    time = LocalTime(0, SECOND, offset)
    time.slip(at("2026-11-23T12:00:00"))
    assert time.text(0) == "2026-11-23-13:00:00.000"
    assert len(looked_up) < 7
