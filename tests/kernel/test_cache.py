"""The cache folder is that of exactly these sources and versions: numba sees no change in a callee or constant."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from motionlayer._kernel import _compile
from tests.effort import thinned

PACKAGE = _compile.PACKAGE


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("MOTIONLAYER_CACHE", str(tmp_path / "cache"))
    monkeypatch.setenv("MOTIONLAYER_KERNELS", "compiled")
    return tmp_path / "cache"


@pytest.fixture
def sources(tmp_path: Path) -> Path:
    """Return a copy of the package, beside which a process finds nothing else of it."""
    copy = tmp_path / "src" / "motionlayer"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


def ask(sources: Path, question: str = "cache_folder()", *path: Path) -> str:
    """Return what a process that uses these sources answers."""
    run = subprocess.run(
        [sys.executable, "-c", f"from motionlayer._kernel import *; print({question})"],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, [*path, sources.parent]))},
        capture_output=True,
        text=True,
        check=True,
    )
    return run.stdout.strip()


def append(file: Path, text: str = "\n# changed\n") -> None:
    file.write_text(file.read_text() + text)


def test_same_sources_have_the_same_folder_wherever_they_lie(sources: Path, own_cache: Path) -> None:
    folder = ask(sources)
    assert folder == ask(sources)
    assert Path(folder).parent == own_cache / "kernels"
    moved = sources.parent.parent / "elsewhere" / "motionlayer"
    moved.parent.mkdir()
    sources.rename(moved)
    assert ask(moved) == folder


@pytest.mark.parametrize(
    "file",
    thinned(
        [
            "profile/_kernels.py",
            "profile/_check.py",
            "store/_kernels.py",
            # no kernel in these, but what kernels are made of: constants compiled in, and how they are compiled
            "profile/_tolerances.py",
            "store/_layout.py",
            "_kernel/_compile.py",
        ],
        3,
    ),
)
def test_change_in_a_source_gives_another_folder(sources: Path, file: str) -> None:
    before = ask(sources)
    append(sources / file)
    assert ask(sources) != before


def test_renamed_source_gives_another_folder(sources: Path) -> None:
    before = ask(sources)
    (sources / "store" / "_kernels.py").rename(sources / "store" / "_sampling.py")
    assert ask(sources) != before


def test_source_without_kernels_keeps_the_folder(sources: Path) -> None:
    before = ask(sources)
    append(sources / "event" / "_event.py")
    append(sources / "__init__.py")
    assert ask(sources) == before


@pytest.mark.parametrize("package", ["numba", "llvmlite", "numpy"])
def test_another_version_gives_another_folder(sources: Path, tmp_path: Path, package: str) -> None:
    before = ask(sources)
    other = tmp_path / "other"
    metadata = other / f"{package}-999.0.dist-info" / "METADATA"
    metadata.parent.mkdir(parents=True)
    metadata.write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 999.0\n")
    assert ask(sources, "cache_folder()", other) != before


def test_modes_are_cached_apart(sources: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    compiled = ask(sources)
    monkeypatch.setenv("MOTIONLAYER_KERNELS", "checked")
    assert ask(sources) != compiled


def test_mark_is_kept_in_the_folder(sources: Path) -> None:
    assert ask(sources, "is_cached()") == "False"
    Path(ask(sources)).mkdir(parents=True)
    assert ask(sources, "(is_cached(), mark_cached(), is_cached())") == "(False, None, True)"
    assert ask(sources, "is_cached()") == "True"
    append(sources / "profile" / "_kernels.py")
    assert ask(sources, "is_cached()") == "False"


def test_plain_needs_no_cache(sources: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MOTIONLAYER_KERNELS", "plain")
    assert ask(sources, "(is_cached(), mark_cached())") == "(True, None)"
    assert not own_cache.exists()
