"""The history file: one line per run, and what it shows of a row."""

import json
from pathlib import Path

import pytest

from motionlayer.bench import Figure, Goal, Row, _history, run, show_history
from motionlayer.bench import _run as running
from motionlayer.bench._report import Result

ROW = Row("a.row", "µs", Goal(20), lambda _effort: Figure(3.0))


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Point the user's history to a folder of the test, and measure one quick row."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    monkeypatch.setattr(running, "GROUPS", {"quick": (ROW,)})
    return tmp_path / "motionlayer" / "bench.jsonl"


def test_every_run_adds_a_line_with_date_commit_and_computer(file: Path) -> None:
    assert [run("quick"), run("quick")] == [0, 0]
    entries = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
    assert [entry["rows"] for entry in entries] == [{"a.row": 3.0}] * 2
    assert all({"date", "version", "commit", "machine"} <= entry.keys() for entry in entries)


def test_another_file_can_be_named(file: Path, tmp_path: Path) -> None:
    run("quick", history=tmp_path / "own.jsonl")
    assert (tmp_path / "own.jsonl").exists()
    assert not file.exists()


def test_a_history_that_cannot_be_written_is_told(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file.parent.write_text("in the way", encoding="utf-8")
    assert run("quick") == 0  # the measurement itself has worked
    assert run("quick", history=tmp_path / "motionlayer" / "own.jsonl") == 1
    assert capsys.readouterr().err.count("the history cannot be written") == 2


def test_the_history_shows_values_and_the_last_change(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for value in (10.0, None, 8.0):
        _history.append([Result(ROW, value)], file)
    assert show_history("quick") == 0
    out = capsys.readouterr().out
    assert "3 runs" in out
    assert out.splitlines()[-1].split() == ["a.row", "-20.0", "%", "10", "8"]


def test_other_computers_and_broken_lines_are_left_out(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _history.append([Result(ROW, 4.0)], file)
    other = {"date": "", "machine": "another", "rows": {"a.row": 99.0}}
    with file.open("a", encoding="utf-8") as stream:
        stream.write(json.dumps(other) + "\n[1]\n{}\n" + '{"cut off')
    show_history(None)
    out = capsys.readouterr().out
    assert "1 runs" in out
    assert "99" not in out


def test_without_a_history_there_is_a_word(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert show_history(None) == 0
    assert capsys.readouterr().out.startswith("no history of ")
    assert not file.exists()


def test_the_history_of_an_unknown_group_is_an_error(file: Path) -> None:
    assert show_history("none", file) == 2


def test_a_history_that_is_a_folder_is_an_error(tmp_path: Path) -> None:
    assert show_history(None, tmp_path) == 1


def test_no_commit_outside_a_checkout(tmp_path: Path) -> None:
    assert _history.commit(tmp_path) is None
