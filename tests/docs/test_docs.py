"""The code of README and documentation runs, and the machine files in it are valid."""

import re
import tomllib
from pathlib import Path

import pytest

from motionlayer import Machine

ROOT = Path(__file__).resolve().parent.parent.parent
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])
BLOCK = re.compile(r"^```(python|toml)\n(.*?)^```", re.DOTALL | re.MULTILINE)


def blocks(page: Path, language: str) -> list[str]:
    return [text for kind, text in BLOCK.findall(page.read_text()) if kind == language]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_python_blocks_of_a_page_run_one_after_the_other(page: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    names: dict[str, object] = {}
    for number, block in enumerate(blocks(page, "python"), 1):
        exec(compile(block, f"{page.name}, block {number}", "exec"), names)  # noqa: S102 - our own documentation
    assert "machine" in names or not names


def test_the_machine_file_page_shows_a_valid_machine() -> None:
    (block,) = blocks(ROOT / "docs" / "machine-file.md", "toml")
    machine = Machine.from_dict(tomllib.loads(block))
    assert machine.description.axis["X"].home.switch == -5.0


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(page: Path) -> None:
    targets = re.findall(r"\]\(([^)#]+)\)|<img src=\"([^\"]+)\"", page.read_text())
    for target in (one or other for one, other in targets):
        if not target.startswith("http"):
            assert (page.parent / target).exists(), target
