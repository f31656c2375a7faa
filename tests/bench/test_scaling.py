"""The page of cost against number of axes."""

import sys
from pathlib import Path

import pytest

from motionlayer.bench import Effort, Environment, _scaling, run
from motionlayer.bench import _run as running

TINY = Effort(samples=3, runs=1, peers=Environment(Path(sys.executable)))


def test_a_missing_peer_leaves_our_curve(capsys: pytest.CaptureFixture[str]) -> None:
    curves, notes = _scaling.measure(TINY, print, axes=(1, 3))
    assert [curve.name for curve in curves] == ["motionlayer"]
    assert len(curves[0].values) == 2
    assert notes == ["no pyplcopen: ModuleNotFoundError: No module named 'pyplcopen'"]
    assert "cycle of 3 axes" in capsys.readouterr().out


def test_the_page_holds_both_curves_and_needs_nothing_else(tmp_path: Path) -> None:
    file = tmp_path / "cost.html"
    curves = [_scaling.Curve("ours", [1.0, 2.0]), _scaling.Curve("theirs", [10.0, 20.0])]
    _scaling.write_page(curves, file, "a computer", (1, 10))
    text = file.read_text(encoding="utf-8")
    body = text[text.index("<body>") :]
    assert '"name":"ours"' in body
    assert '"name":"theirs"' in body
    assert "a computer" in body
    assert 'src="http' not in text
    assert body.count('"type":"log"') == 2


def test_a_page_of_another_suffix_is_refused_before_anything_is_measured(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("core", plot=Path("cost.png")) == 2
    assert capsys.readouterr().err.splitlines() == [
        "motionlayer bench: cost.png: pages are written as .html only; name it cost.html"
    ]


def test_a_page_that_cannot_be_written_is_one_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(running, "GROUPS", {"core": ()})
    monkeypatch.setattr(_scaling, "measure", lambda *_: ([], []))
    assert run("core", plot=tmp_path / "no" / "cost.html", history=tmp_path / "history.jsonl") == 1
    assert "cannot be written" in capsys.readouterr().err
