"""A disk that is full: a real one, small, and a limit of the operating system on the size of a file."""

import os
import resource
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from motionlayer.event import Level, Levels, MessageList
from motionlayer.record.log import LogFolder, MessageLog
from tests.record.log.support import files, local, message, resize, small_disk, texts, times

DAY = "2025_10_24"
FILE = f"{DAY}/851_MSG_PLC_{DAY}.txt"


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of 64 KiB."""
    with small_disk(tmp_path / "disk") as made:
        yield made


def lines(first: int, count: int) -> bytes:
    """Return lines of 50 bytes."""
    pattern = b"type\t%06d\tdevice\tpart\t0\t%023d\n"
    return b"".join(pattern % (number, number) for number in range(first, first + count))


def numbers(folder: Path) -> list[int]:
    return [int(text) for text in texts(files(folder)[FILE]) if text.isdigit()]


def test_d69_lines_are_kept_and_written_when_there_is_room_again(disk: Path) -> None:
    told: list[str] = []
    folder = LogFolder(disk, on_trouble=told.append)
    for block in range(20):
        folder.write(MessageList.MOTION, DAY, lines(100 * block, 100))
    (trouble,) = told
    assert trouble.startswith(f"messages cannot be written into {disk}: No space left on device; free space: ")
    fit = numbers(disk)  # whole lines only: `files` looks at that
    assert fit == list(range(len(fit)))
    assert 0 < len(fit) < 2000
    resize(disk, "1m")
    folder.retry()
    assert numbers(disk) == list(range(2000))
    folder.close()
    assert (len(told), folder.missing) == (1, 0)


def test_what_exceeds_the_bound_is_counted_and_marked_in_its_place(disk: Path) -> None:
    folder = LogFolder(disk, held=20_000)
    for block in range(40):
        folder.write(MessageList.MOTION, DAY, lines(100 * block, 100))
    assert folder.missing > 0
    resize(disk, "1m")
    folder.write(MessageList.MOTION, DAY, lines(4000, 100))
    folder.close()
    whole = files(disk)[FILE]
    (mark,) = [number for number, line in enumerate(whole) if "missing" in line]
    assert [int(text) for text in texts(whole[:mark])] == list(range(mark))
    assert [int(text) for text in texts(whole[mark + 1 :])] == list(range(4000, 4100))
    assert whole[mark].split("\t") == [
        "eMessageWarning",
        f"{mark:06d}",  # the time of the first one that is missing
        "Device_Main_ID_1",
        "General",
        str(folder.missing),
        f"{folder.missing} messages are missing here: they could not be written",
    ]
    assert mark + folder.missing == 4000


def test_a_disk_that_stays_full_costs_what_is_kept_and_the_end_comes_in_order(disk: Path) -> None:
    log = MessageLog(LogFolder(disk, held=10_000), local(), Levels(Level.INFO))
    for number in range(50_000):
        log(message(number, str(number)))
    log.close()
    written = [int(text) for text in texts(files(disk)[FILE])]
    assert written == list(range(len(written)))
    assert log.missing == 50_000 - len(written) > 0
    assert "No space left on device" in log.trouble


def test_after_each_recovery_the_next_trouble_is_told_again(disk: Path) -> None:
    told: list[str] = []
    folder = LogFolder(disk, on_trouble=told.append)
    folder.write(MessageList.MOTION, DAY, lines(0, 2000))
    resize(disk, "200k")
    folder.retry()
    folder.sync()
    assert len(told) == 1
    folder.write(MessageList.MOTION, DAY, lines(2000, 5000))
    assert len(told) == 2
    folder.close()


def test_a_limit_on_the_size_of_a_file(tmp_path: Path) -> None:
    """In a process of its own: the limit would hold for everything that is tested after this."""
    told: list[str] = []
    child = os.fork()
    if child == 0:  # no pytest in here
        signal.alarm(60)
        resource.setrlimit(resource.RLIMIT_FSIZE, (30_000, 30_000))
        folder = LogFolder(tmp_path, on_trouble=told.append)
        folder.write(MessageList.MOTION, DAY, lines(0, 1000))
        os._exit(0 if len(told) == 1 and "File too large" in told[0] else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    assert numbers(tmp_path) == list(range(600))
    assert times(files(tmp_path)[FILE])[-1] == "000599"
