"""Campaigns stop, go on where they stopped, and know when they may not."""

import itertools
import json
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from motionlayer.bench.campaign import Campaign, Failure, State, StateError, _pursuit, pursue, resume
from motionlayer.bench.campaign._pursuit import batches
from tests.scripts import ROOT, script

SCRIPT = ROOT / "scripts" / "campaign.py"


def odd(_seed: int, cases: range) -> list[Failure]:
    """Fail in every seventh case."""
    return [Failure(case, f"case {case}") for case in cases if case % 7 == 3]


FAKE = Campaign("fake", "things", 2, 10, 100, odd, lambda _seed, case: f"input of {case}")


def quiet(_cases: int) -> None:
    """Show nothing."""


def test_batches_never_cross_their_border() -> None:
    assert list(batches(FAKE, 7, 25)) == [range(7, 10), range(10, 20), range(20, 25)]
    assert list(batches(FAKE, 25, 25)) == []


def test_the_count_is_reached_and_saved(tmp_path: Path) -> None:
    file, shown = tmp_path / "new" / "fake-1.json", list[int]()
    state, why = resume(FAKE, 1, file)
    assert why == "no earlier state"
    pursue(FAKE, state, 61, file, shown.append)
    assert shown == [10, 20, 30, 31]  # 61 things are 31 cases
    data = json.loads(file.read_text(encoding="utf-8"))
    assert (data["cases"], data["seed"]) == (31, 1)
    assert [failure["case"] for failure in data["failures"]] == [3, 10, 17, 24]


def test_an_interrupted_campaign_goes_on_and_finds_the_same(tmp_path: Path) -> None:
    whole, file = State("fake", 1, ""), tmp_path / "fake-1.json"
    pursue(FAKE, whole, 100, tmp_path / "whole.json", quiet)

    def interrupt(_seed: int, cases: range) -> list[Failure]:
        if cases.start == 30:
            raise KeyboardInterrupt
        return odd(_seed, cases)

    state, _ = resume(FAKE, 1, file)
    with pytest.raises(KeyboardInterrupt):
        pursue(FAKE._replace(run=interrupt), state, 100, file, quiet)
    again, why = resume(FAKE, 1, file)
    assert (why, again.cases) == ("", 30)
    pursue(FAKE, again, 100, file, quiet)
    assert (again.cases, again.failures) == (whole.cases, whole.failures)


def test_a_killed_campaign_loses_a_few_seconds_at_most(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The state is saved whenever the period is over, not only in the end."""
    saved: list[int] = []
    monkeypatch.setattr(State, "save", lambda state, _file: saved.append(state.cases))
    seconds = itertools.count()
    pursue(FAKE, State("fake", 1, ""), 100, tmp_path / "state", quiet, clock=lambda: float(next(seconds)))
    assert saved[0] < 50
    assert len(saved) >= 2
    assert saved[-1] == 50


def test_other_sources_start_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "fake-1.json"
    state, _ = resume(FAKE, 1, file)
    pursue(FAKE, state, 100, file, quiet)
    monkeypatch.setattr(_pursuit, "digest", lambda: "other")
    state, why = resume(FAKE, 1, file)
    assert state.cases == 0
    assert "sources" in why


def test_a_state_of_another_seed_is_not_taken(tmp_path: Path) -> None:
    file = tmp_path / "state.json"
    state, _ = resume(FAKE, 1, file)
    state.save(file)
    assert resume(FAKE, 2, file)[1] == "the earlier state is of another campaign"


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"format": 1}', '{"format": 1, "failures": [{}]}'])
def test_a_broken_state_is_one_error(tmp_path: Path, text: str) -> None:
    file = tmp_path / "state.json"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(StateError, match="delete it to start anew"):
        resume(FAKE, 1, file)


def test_a_state_that_cannot_be_written_is_one_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(StateError, match="cannot be written"):
        State("fake", 1, "").save(tmp_path / "file" / "state.json")


def command(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the command with a folder of its own."""
    line = [sys.executable, str(SCRIPT), "--folder", str(folder), *arguments]
    return subprocess.run(line, capture_output=True, text=True, timeout=120, check=False)


def test_the_command_counts_and_goes_on(tmp_path: Path) -> None:
    options = ["--folder", str(tmp_path), "--name", "planning", "--seed", "3"]
    first = CliRunner().invoke(script("campaign").main, [*options, "--count", "2e2"])
    assert first.exit_code == 0, first.stderr
    assert first.stdout.splitlines()[-1].startswith("planning: 200 states, seed 3: 0 failures; ")
    again = CliRunner().invoke(script("campaign").main, [*options, "--count", "300"])
    assert "goes on at 200" in again.stdout
    assert "planning: 300 states, seed 3: 0 failures" in again.stdout


@pytest.mark.slow
def test_the_command_repeats_one_case(tmp_path: Path) -> None:
    done = command(tmp_path, "--name", "planning", "--case", "17")
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("plan_")
    assert done.stdout.splitlines()[-1] == "fine"
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("count", ["0", "-1", "1.5", "nan", "inf", "many"])
def test_the_command_wants_a_whole_count(count: str) -> None:
    done = CliRunner().invoke(script("campaign").main, ["--name", "planning", f"--count={count}"])
    assert done.exit_code == 2
    assert "is no whole number above zero" in done.stderr
