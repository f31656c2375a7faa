import threading
from pathlib import Path

import pytest

from motionlayer.event import EventLog, Level, Levels
from motionlayer.record.log import LogFolder, MessageLog
from motionlayer.record.log._zone import LocalTime
from tests.record.log.support import AXIS, SECOND, at, files, local, message, opened, texts, times

BURST = 100_000
FILE = "2025_10_24/851_MSG_PLC_2025_10_24.txt"


class Stalled(LocalTime):
    """A time that nobody learns until `go` is set: a writer that cannot keep up."""

    def __init__(self) -> None:
        super().__init__(at("2025-10-24T13:00:00"), 1_000_000, lambda _: 0)
        self.go = threading.Event()

    def text(self, tick: int) -> str:
        assert self.go.wait(60)
        return super().text(tick)


@pytest.mark.parametrize("lossless", [True, False])
def test_a_burst_is_complete_and_in_strict_order(tmp_path: Path, *, lossless: bool) -> None:
    log, events = opened(tmp_path, lossless=lossless, capacity=2 * BURST if not lossless else 1000), EventLog()
    events.listen(log)
    for number in range(BURST):
        events.add(message(number // 7, f"number {number}"))
    log.close()
    lines = files(tmp_path)[FILE]
    assert texts(lines) == [f"number {number}" for number in range(BURST)]
    assert times(lines) == sorted(times(lines))
    assert log.missing == 0


def test_only_what_passes_the_levels_is_written_and_they_may_change(tmp_path: Path) -> None:
    levels = Levels(Level.ERROR)
    log = MessageLog(LogFolder(tmp_path), local(), levels)
    log(message(0, "no"))
    log(message(1, "error", Level.ERROR))
    levels.set_level(AXIS, Level.VERBOSE)
    log(message(2, "verbose", Level.VERBOSE))
    log(message(3, "of another axis", Level.VERBOSE, device=AXIS + 1))
    levels.set_level(AXIS, None)
    levels.level = Level.INFO
    log(message(4, "info"))
    log.close()
    assert texts(files(tmp_path)[FILE]) == ["error", "verbose", "info"]


def test_in_real_time_what_finds_no_room_is_counted_in_its_place(tmp_path: Path) -> None:
    time = Stalled()
    log = MessageLog(LogFolder(tmp_path), time, Levels(Level.INFO), lossless=False, capacity=100)
    for number in range(1000):  # returns at once, though nobody writes
        log(message(number, str(number)))
    time.go.set()
    log.close()
    lines = files(tmp_path)[FILE]
    before, gap = lines[:-1], lines[-1].split("\t")
    count = 1000 - len(before)
    # What the writer took off before it stalled made room for as many more.
    assert texts(before) == [str(number) for number in range(len(before))]
    assert 100 <= len(before) <= 200
    assert gap[0] == "eMessageWarning"
    assert gap[1] == f"2025-10-24-13:00:00.{len(before):03d}"
    assert gap[2:] == [
        "Device_Main_ID_1",
        "General",
        str(count),
        f"{count} messages are missing here: the writer could not keep up",
    ]
    assert log.missing == count


def test_after_a_gap_it_goes_on(tmp_path: Path) -> None:
    time = Stalled()
    log = MessageLog(LogFolder(tmp_path), time, Levels(Level.INFO), lossless=False, capacity=100)
    for number in range(300):
        log(message(number, str(number)))
    time.go.set()
    while log.backlog:
        threading.Event().wait(0.001)
    log(message(300, "last"))
    log.close()
    lines = files(tmp_path)[FILE]
    assert texts(lines)[-1] == "last"
    assert f"{log.missing} messages are missing here" in texts(lines)[-2]
    assert len(lines) == 300 - log.missing + 2
    assert times(lines) == sorted(times(lines))


def test_in_simulation_the_run_waits_and_nothing_is_lost(tmp_path: Path) -> None:
    time = Stalled()
    log = MessageLog(LogFolder(tmp_path), time, Levels(Level.INFO), capacity=100)
    done = threading.Event()

    def cycle() -> None:
        for number in range(1000):
            log(message(number, str(number)))
        done.set()

    thread = threading.Thread(target=cycle)
    thread.start()
    assert not done.wait(0.3)
    time.go.set()
    thread.join(60)
    log.close()
    assert texts(files(tmp_path)[FILE]) == [str(number) for number in range(1000)]


def test_a_slip_moves_what_was_said_after_it(tmp_path: Path) -> None:
    log = opened(tmp_path)
    log(message(1, "before"))
    log.slip(3 * SECOND)
    log(message(2, "after"))
    with pytest.raises(ValueError, match=r"slip\(-1\): time never goes back"):
        log.slip(-1)
    log.close()
    assert times(files(tmp_path)[FILE]) == ["2025-10-24-13:00:00.001", "2025-10-24-13:00:03.002"]


def test_a_change_of_the_clocks_is_told_in_the_file(tmp_path: Path) -> None:
    # Clocks went back during the day: from the next local midnight on the offset is one hour less.
    midnight = at("2025-10-25T22:00:00") // SECOND
    berlin = LocalTime(at("2025-10-25T21:59:59"), SECOND, lambda second: 3600 if second >= midnight else 7200)
    log = MessageLog(LogFolder(tmp_path), berlin, Levels(Level.INFO))
    for tick in (0, 1, 3601):
        log(message(tick, str(tick)))
    log.close()
    found = files(tmp_path)
    first = found["2025_10_25/851_MSG_PLC_2025_10_25.txt"]
    assert texts(first) == ["0", "local time is UTC+01:00 from here on, UTC+02:00 before", "1"]
    assert times(first) == ["2025-10-25-23:59:59.000", "2025-10-25-23:00:00.000", "2025-10-25-23:00:00.000"]
    assert times(found["2025_10_26/851_MSG_PLC_2025_10_26.txt"]) == ["2025-10-26-00:00:00.000"]


def test_closing_twice_is_closing_once(tmp_path: Path) -> None:
    log = opened(tmp_path)
    log.close()
    log.close()
    opened(tmp_path).close()
