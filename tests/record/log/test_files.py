from pathlib import Path
from typing import Any

import pytest

from motionlayer.event import MessageList
from motionlayer.record.log import LogError, LogFolder
from tests.record.log.support import files, message, opened, texts, times

DAY = "2025_10_24"
MOTION = f"{DAY}/851_MSG_PLC_{DAY}"
METRICS_DEVICE = 17_001


def write(folder: Path, count: int, first: int = 0, **changes: Any) -> None:
    log = opened(folder, **changes)
    for number in range(first, first + count):
        log(message(number, f"number {number}"))
    log.close()


def test_the_file_of_the_specification(tmp_path: Path) -> None:
    write(tmp_path, 3)
    assert list(files(tmp_path)) == [f"{MOTION}.txt"] == ["2025_10_24/851_MSG_PLC_2025_10_24.txt"]


def test_counters_have_a_file_of_their_own_only_when_there_are_any(tmp_path: Path) -> None:
    log = opened(tmp_path)
    log(message(0, "count", device=METRICS_DEVICE))
    log.close()
    found = files(tmp_path)
    assert texts(found[f"{DAY}/851_MSG_Metrics_{DAY}.txt"]) == ["count"]
    assert found[f"{MOTION}.txt"] == []


def test_a_list_that_has_no_file_here_is_left_out(tmp_path: Path) -> None:
    log = opened(tmp_path)
    log(message(0, "application", device=30_001))
    log(message(0, "axis"))
    log.close()
    assert {name: texts(lines) for name, lines in files(tmp_path).items()} == {f"{MOTION}.txt": ["axis"]}
    assert log.missing == 0


def test_a_second_run_goes_on_in_the_same_file(tmp_path: Path) -> None:
    write(tmp_path, 3)
    write(tmp_path, 2, first=3)
    (lines,) = files(tmp_path).values()
    assert texts(lines) == [f"number {number}" for number in range(5)]


def test_a_file_that_has_its_size_is_followed_by_the_next_part(tmp_path: Path) -> None:
    write(tmp_path, 1000, size=10_000)
    found = files(tmp_path)
    parts = len(found)
    names = [f"{MOTION}.txt", *(f"{MOTION}_{part}.txt" for part in range(1, parts))]
    assert set(found) == set(names)
    assert [text for name in names for text in texts(found[name])] == [f"number {number}" for number in range(1000)]
    sizes = [(tmp_path / name).stat().st_size for name in names]
    assert all(9_900 < size <= 10_000 for size in sizes[:-1]), sizes


def test_a_second_run_goes_on_in_the_last_part(tmp_path: Path) -> None:
    write(tmp_path, 1000, size=10_000)
    parts = len(files(tmp_path))
    write(tmp_path, 1, first=1000, size=10_000)
    found = files(tmp_path)
    assert len(found) == parts
    assert texts(found[f"{MOTION}_{parts - 1}.txt"])[-1] == "number 1000"


def test_a_day_has_its_own_folder_and_file(tmp_path: Path) -> None:
    log = opened(tmp_path, "2025-10-24T23:59:59.990")
    for tick in range(20):
        log(message(tick, str(tick)))
    log.close()
    found = files(tmp_path)
    assert texts(found[f"{MOTION}.txt"]) == [str(tick) for tick in range(10)]
    assert texts(found["2025_10_25/851_MSG_PLC_2025_10_25.txt"]) == [str(tick) for tick in range(10, 20)]
    assert times(found["2025_10_25/851_MSG_PLC_2025_10_25.txt"])[0] == "2025-10-25-00:00:00.000"


def test_parts_are_counted_anew_each_day(tmp_path: Path) -> None:
    log = opened(tmp_path, "2025-10-24T23:59:59.500", size=10_000)
    for tick in range(1000):
        log(message(tick, str(tick)))
    log.close()
    found = files(tmp_path)
    assert "2025_10_24/851_MSG_PLC_2025_10_24_1.txt" in found
    assert "2025_10_25/851_MSG_PLC_2025_10_25.txt" in found
    assert sum(map(len, found.values())) == 1000


def test_a_piece_of_a_line_that_a_killed_run_left_stays_alone(tmp_path: Path) -> None:
    write(tmp_path, 1)
    path = tmp_path / f"{MOTION}.txt"
    path.write_bytes(path.read_bytes() + b"eMessageInfo\t2025-10-")
    write(tmp_path, 1, first=1)
    (lines,) = files(tmp_path).values()
    assert lines[1] == "eMessageInfo\t2025-10-"
    assert texts([lines[0], lines[2]]) == ["number 0", "number 1"]


def test_a_file_and_its_folder_may_be_taken_away_at_any_time(tmp_path: Path) -> None:
    folder = LogFolder(tmp_path / "log")
    folder.write(MessageList.MOTION, DAY, b"one\n")
    (tmp_path / "log" / DAY).rename(tmp_path / "moved")
    folder.write(MessageList.MOTION, DAY, b"two\n")
    folder.close()
    assert files(tmp_path) == {f"moved/851_MSG_PLC_{DAY}.txt": ["one"], f"log/{MOTION}.txt": ["two"]}
    assert (folder.trouble, folder.missing) == ("", 0)


def test_the_port_is_part_of_the_name(tmp_path: Path) -> None:
    folder = LogFolder(tmp_path, port=852)
    folder.write(MessageList.METRICS, DAY, b"one\n")
    folder.close()
    assert list(files(tmp_path)) == [f"{DAY}/852_MSG_Metrics_{DAY}.txt"]


def test_a_size_in_which_no_line_has_room_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="message files of 9999 bytes: must be at least 10000"):
        LogFolder(tmp_path, size=9_999)


def test_a_folder_that_cannot_be_made_or_written_to_is_found_before_the_run(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(LogError, match=r"log folder .*file/log cannot be made: Not a directory; name another one"):
        LogFolder(tmp_path / "file" / "log")
    (tmp_path / DAY).write_text("")  # where the folder of the day is to be
    with pytest.raises(LogError, match=rf"851_MSG_PLC_{DAY}\.txt cannot be written: Not a directory; mend that"):
        opened(tmp_path)
    LogFolder(tmp_path).close()  # and the folder is free again
