"""Peers: what is there is measured, what is not leaves a note."""

import sys
from pathlib import Path

import pytest

from motionlayer.bench import GROUPS, Effort, _peers
from motionlayer.bench._peers import PINS, PeersMissing

TINY = Effort(samples=3, runs=1)
HERE = Path(sys.executable)


def test_every_peer_of_a_row_has_a_pinned_version() -> None:
    assert {row.peer.package for rows in GROUPS.values() for row in rows if row.peer} <= set(PINS)


def test_a_peer_that_is_installed_is_measured() -> None:
    values, notes = _peers.measure(["ruckig"], TINY, HERE, print)
    assert values["ruckig"] > 0.0
    assert notes == []


def test_a_package_that_is_not_installed_leaves_the_others_alone() -> None:
    values, notes = _peers.measure(["pyplcopen", "ruckig"], TINY, HERE, print)
    assert set(values) == {"ruckig"}
    assert notes == ["no pyplcopen: ModuleNotFoundError: No module named 'pyplcopen'"]


def test_an_interpreter_that_fails_is_a_note(tmp_path: Path) -> None:
    python = tmp_path / "python"
    python.write_text("#!/bin/sh\necho broken >&2\nexit 3\n")
    python.chmod(0o755)
    assert _peers.measure(["ruckig"], TINY, python, print) == ({}, ["no peers: broken"])


def test_an_environment_with_the_right_versions_is_used_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    home = _peers.folder()
    assert home.is_relative_to(tmp_path)
    home.mkdir(parents=True)
    pins = ", ".join(f'"{name}=={version}"' for name, version in PINS.items())
    (home / "installed.json").write_text(f"[{pins}]", encoding="utf-8")
    said: list[str] = []
    assert _peers._environment(said.append) == home / "bin" / "python"
    assert said == []


def test_a_cache_that_cannot_be_written_is_a_note(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    with pytest.raises(PeersMissing):
        _peers._environment(print)


@pytest.mark.slow
def test_without_the_network_the_peers_are_missing_and_tried_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("PIP_CONFIG_FILE", "/dev/null")
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    said: list[str] = []
    values, notes = _peers.measure(["ruckig"], TINY, None, said.append)
    assert values == {}
    assert notes == ["no ruckig: ModuleNotFoundError: No module named 'ruckig'"]
    assert len(said) == 1 + len(PINS)
    assert not (_peers.folder() / "installed.json").exists()
