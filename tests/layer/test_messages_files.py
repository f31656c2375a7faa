"""Defects of the message files (motion-layer 9.6), by runs of a machine with a motion layer."""

from pathlib import Path

import pytest

from tests.layer.message_runs import lines, opened, read, say

LONGEST = 524_288
"""Characters of the buffer of the original, whose length was counted with 16 bits."""


def names(folder: Path) -> list[str]:
    return [path.relative_to(folder).as_posix() for path in sorted(folder.rglob("*.txt"))]


def test_d39_a_new_day_has_a_new_folder_and_a_new_file(tmp_path: Path) -> None:
    with opened(tmp_path, start="2025-12-31T23:59:59") as run:
        run.step(999)
        say(run, "old")
        run.step()
        say(run, "new")
        run.step()
        assert read(run, "sLocalTime") == "2026-01-01-00:00:00.000"
    assert names(tmp_path) == [
        "2025_12_31/851_MSG_PLC_2025_12_31.txt",
        "2026_01_01/851_MSG_PLC_2026_01_01.txt",
    ]
    assert [columns[5] for columns in lines(tmp_path)][-2:] == ["old", "new"]
    assert (tmp_path / "2026_01_01/851_MSG_PLC_2026_01_01.txt").read_text().count("\n") == 1


def test_d40_the_time_is_valid_from_the_first_folder_and_message_on(tmp_path: Path) -> None:
    with opened(tmp_path) as run:
        run.step(3)
    assert names(tmp_path) == ["2025_10_24/851_MSG_PLC_2025_10_24.txt"]
    assert lines(tmp_path)[0][1] == "2025-10-24-13:00:00.001"


def test_d41_folder_and_file_are_joined_as_the_system_does(tmp_path: Path) -> None:
    with opened(tmp_path, layer={"paths": "windows"}) as run:
        run.step(3)
        assert "\\" in read(run, "LOG_DIR")  # what clients read; the files are where the machine file says
    (file,) = tmp_path.rglob("*.txt")
    assert file.parent == tmp_path / "2025_10_24"
    assert "\\" not in file.name


@pytest.mark.parametrize(("paths", "separator"), [("windows", "\\"), ("bsd", "/")])
def test_d48_one_switch_chooses_all_paths(paths: str, separator: str) -> None:
    run = opened(layer={"paths": paths})
    folders = [run.symbols.read(name) for name in ("PLC_CONSTANT.NCI_DIR", "GVL_MSG_AXIS.LOG_DIR")]
    other = {"\\": "/", "/": "\\"}[separator]
    assert all(folder.endswith(separator) and other not in folder for folder in folders)


def test_d68_more_text_than_the_buffer_of_the_original_is_written_whole(tmp_path: Path) -> None:
    with opened(tmp_path) as run:
        run.step(100)
        for number in range(4000):
            say(run, f"{number:04d}{150 * 'x'}")
        run.step()
    texts = [columns[5] for columns in lines(tmp_path) if columns[5].endswith("x")]
    assert sum(map(len, texts)) > LONGEST
    assert texts == [f"{number:04d}{150 * 'x'}" for number in range(4000)]
