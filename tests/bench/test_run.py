"""`run`: groups, table, JSON and exit codes, with rows that are quick."""

import json
from pathlib import Path

import pytest

from motionlayer.bench import GROUPS, Effort, Environment, Failed, Figure, Goal, Peer, Row, Skipped, run
from motionlayer.bench._environment import PINS
from motionlayer.bench._report import Result, rounded, table
from motionlayer.bench._run import measure

TINY = Effort(samples=3, runs=1)


def good(_effort: Effort) -> Figure:
    return Figure(123.456, "with a note")


def skipped(_effort: Effort) -> Figure:
    raise Skipped("not here")


def failed(_effort: Effort) -> Figure:
    raise Failed("it broke")


GOOD = Row("a.good", "µs", Goal(20), good)
PEER = Row("b.peer", "µs", Goal(200), good, Peer("ruckig", "all of it", "plan", lambda _effort: {}))
SKIPPED = Row("a.skipped", "s", Goal(1), skipped)
FAILED = Row("a.failed", "s", Goal(1), failed)


@pytest.fixture(autouse=True)
def history(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Keep the user's history out of it; return the one in place of it."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    return tmp_path / "data" / "motionlayer" / "bench.jsonl"


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Put groups of quick rows in place of the real ones."""
    for group in list(GROUPS):
        monkeypatch.delitem(GROUPS, group)
    monkeypatch.setitem(GROUPS, "fine", (GOOD, SKIPPED))
    monkeypatch.setitem(GROUPS, "broken", (FAILED, GOOD))


def test_an_unknown_group_is_one_error_that_lists_the_groups(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("cor", None) == 2
    out, err = capsys.readouterr()
    assert out == ""
    groups = "core, axis, numerics, runtime, layer, ads"
    assert err.splitlines() == [f"motionlayer bench: no group 'cor'; there are: {groups}"]


@pytest.mark.usefixtures("quick")
def test_json_has_a_row_per_measurement_and_null_for_what_is_missing(tmp_path: Path) -> None:
    file = tmp_path / "bench.json"
    assert run("fine", file) == 0
    assert json.loads(file.read_text(encoding="utf-8")) == [
        {"name": "a.good", "value": 123.0, "unit": "µs", "peer": None, "peer_value": None},
        {"name": "a.skipped", "value": None, "unit": "s", "peer": None, "peer_value": None},
    ]


@pytest.mark.usefixtures("quick")
def test_progress_goes_to_stderr_and_the_table_to_stdout(capsys: pytest.CaptureFixture[str]) -> None:
    run("fine", None)
    out, err = capsys.readouterr()
    assert err.splitlines() == ["[1/2] a.good", "[2/2] a.skipped"]
    assert "a.good: with a note" in out
    assert "a.skipped: not here" in out


@pytest.mark.usefixtures("quick")
def test_a_row_that_fails_leaves_the_others_and_tells_by_the_exit_code(tmp_path: Path) -> None:
    file = tmp_path / "bench.json"
    assert run("broken", file) == 1
    assert [row["value"] for row in json.loads(file.read_text(encoding="utf-8"))] == [None, 123.0]


@pytest.mark.usefixtures("quick")
def test_without_a_group_all_are_measured(tmp_path: Path) -> None:
    file = tmp_path / "bench.json"
    run(None, file)
    assert len(json.loads(file.read_text(encoding="utf-8"))) == 4


@pytest.mark.usefixtures("quick")
def test_a_file_that_cannot_be_written_is_one_error(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("fine", tmp_path / "none" / "bench.json") == 1
    assert capsys.readouterr().err.splitlines()[-1].endswith("cannot be written: No such file or directory")


def test_the_table_shows_missed_goals_and_empty_cells() -> None:
    lines = table([Result(GOOD, 123.456), Result(PEER, 1.0), Result(SKIPPED, None)], ["a note"]).splitlines()
    assert lines[1].split() == ["a.good", "123", "µs", "≤", "20", "missed"]
    assert lines[2].endswith(f"ruckig {PINS['ruckig']}, all of it")
    assert lines[3].split() == ["a.skipped", "s", "≤", "1"]
    assert lines[-2:] == ["", "a note"]


@pytest.mark.parametrize(("value", "shown"), [(0.12345, 0.123), (1234.5, 1230.0), (None, None)])
def test_values_have_three_digits(value: float | None, shown: float | None) -> None:
    assert rounded(value) == shown


def test_without_the_peers_their_cells_are_empty(tmp_path: Path) -> None:
    results, notes = measure([GOOD, PEER], TINY._replace(peers=Environment(tmp_path / "no" / "python")))
    assert [result.peer_value for result in results] == [None, None]
    assert [result.value for result in results] == [123.456, 123.456]
    assert not any(result.failed for result in results)
    assert len(notes) == 1
    assert notes[0].startswith("no ruckig: ")
