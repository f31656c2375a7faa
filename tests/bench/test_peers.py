"""Peers: what is there is measured, what is not leaves a note."""

import sys
from pathlib import Path

import pytest

from motionlayer.bench import GROUPS, Effort, Environment, Peer, _environment, _peers
from motionlayer.bench._environment import PINS, PeersMissing

HERE = Environment(Path(sys.executable))
TINY = Effort(samples=3, runs=1, peers=HERE)
PEERS = {row.peer.job: row.peer for rows in GROUPS.values() for row in rows if row.peer}
PLAN, CYCLE = PEERS["plan"], PEERS["cycle"]


def test_every_peer_of_a_row_has_a_pinned_version() -> None:
    assert {peer.package for peer in PEERS.values()} <= set(PINS)


@pytest.mark.parametrize("peer", [peer for peer in PEERS.values() if peer.package == "ruckig"], ids=lambda one: one.job)
def test_a_peer_that_is_installed_is_measured(peer: Peer) -> None:
    values, notes = _peers.measure([peer], TINY)
    assert values[peer.job] > -1e-9
    assert notes == []


def test_a_package_that_is_not_installed_leaves_the_others_alone() -> None:
    values, notes = _peers.measure([CYCLE, PLAN], TINY)
    assert set(values) == {"plan"}
    assert notes == ["no pyplcopen: ModuleNotFoundError: No module named 'pyplcopen'"]


def test_a_job_of_several_rows_is_done_once(tmp_path: Path) -> None:
    python, count = tmp_path / "python", tmp_path / "count"
    python.write_text(f"#!/bin/sh\necho x >>{count}\necho 1.5\n")
    python.chmod(0o755)
    effort = TINY._replace(peers=Environment(python))
    assert _peers.measure([PLAN, PLAN], effort) == ({"plan": 1.5}, [])
    assert count.read_text() == "x\n"


def test_an_interpreter_that_fails_is_a_note(tmp_path: Path) -> None:
    python = tmp_path / "python"
    python.write_text("#!/bin/sh\necho broken >&2\nexit 3\n")
    python.chmod(0o755)
    assert _peers.measure([PLAN], TINY._replace(peers=Environment(python))) == ({}, ["no ruckig: broken"])


def test_an_environment_with_the_right_versions_is_used_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    home = _environment.folder()
    assert home.is_relative_to(tmp_path)
    home.mkdir(parents=True)
    pins = ", ".join(f'"{name}=={version}"' for name, version in PINS.items())
    (home / "installed.json").write_text(f"[{pins}]", encoding="utf-8")
    said: list[str] = []
    assert Environment(say=said.append).set_up() == home / "bin" / "python"
    assert said == []


def test_a_cache_that_cannot_be_written_is_a_note_and_tried_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    said: list[str] = []
    environment = Environment(say=said.append)
    for _ in range(2):
        with pytest.raises(PeersMissing):
            environment.run(_peers.SCRIPT, {})
    assert len(said) <= 1


@pytest.mark.slow
def test_without_the_network_the_peers_are_missing_and_tried_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("PIP_CONFIG_FILE", "/dev/null")
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    said: list[str] = []
    values, notes = _peers.measure([PLAN], TINY._replace(peers=Environment(say=said.append)))
    assert values == {}
    assert notes == ["no ruckig: ModuleNotFoundError: No module named 'ruckig'"]
    assert len(said) == 1 + len(PINS)
    assert not (_environment.folder() / "installed.json").exists()
