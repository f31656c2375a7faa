"""README and documentation: their code runs, their commands work as printed, their links lead somewhere."""

import re
import shlex
import tomllib
from pathlib import Path

import pytest
from click.testing import CliRunner

from motionlayer import Machine
from motionlayer.cli._main import group

ROOT = Path(__file__).resolve().parent.parent.parent
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])
NAMES = [page.relative_to(ROOT).as_posix() for page in PAGES]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.DOTALL | re.MULTILINE)
OUTPUT = re.compile(r"# → (.*)$", re.MULTILINE)
SLOW = ("bench",)
LONG = {"docs/replay.md"}  # its commands run the whole demo twice

every_page = pytest.mark.parametrize("page", PAGES, ids=NAMES)


def blocks(page: Path, language: str) -> list[str]:
    return [text for kind, text in BLOCK.findall(page.read_text()) if kind == language]


def commands(page: Path) -> list[list[str]]:
    """Return what a page tells to type for `motionlayer`, without comments."""
    lines = [line[2:] for block in blocks(page, "console") for line in block.splitlines() if line.startswith("$ ")]
    words = [shlex.split(line, comments=True) for line in lines]
    return [line[1:] for line in words if line[0] == "motionlayer" and line[1] not in SLOW]


def anchors(page: Path) -> set[str]:
    """Return the names that a page's headings have in a link."""
    titles = re.findall(r"^#+ (.*)$", BLOCK.sub("", page.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}


@every_page
def test_python_blocks_of_a_page_run_and_print_what_it_says(
    page: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    names: dict[str, object] = {}
    for number, block in enumerate(blocks(page, "python"), 1):
        exec(compile(block, f"{page.name}, block {number}", "exec"), names)  # noqa: S102 - our own documentation
        printed = capsys.readouterr().out.splitlines()
        assert [line for line in OUTPUT.findall(block) if line not in printed] == [], printed


@pytest.mark.parametrize(
    "page",
    [
        pytest.param(page, marks=[pytest.mark.slow] if name in LONG else [], id=name)
        for page, name in zip(PAGES, NAMES, strict=True)
    ],
)
def test_commands_of_a_page_work_as_printed(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)  # nothing else is there: no folder that somebody else has made
    for line in commands(page):
        done = CliRunner().invoke(group, line, prog_name="motionlayer")
        assert done.exit_code == 0, (line, done.output)


@every_page
def test_toml_blocks_of_a_page_are_valid_machines(page: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT / "examples" / "first")
    for block in blocks(page, "toml"):
        Machine.from_dict(tomllib.loads(block))


def test_readme_shows_the_files_of_the_first_example() -> None:
    folder = ROOT / "examples" / "first"
    readme = (ROOT / "README.md").read_text()
    assert f"```python\n{(folder / 'program.py').read_text()}```" in readme
    (shown,) = blocks(ROOT / "README.md", "toml")
    assert (folder / "machine.toml").read_text().endswith(shown)


@every_page
def test_links_lead_somewhere(page: Path) -> None:
    targets = re.findall(r"\]\(([^)]+)\)|<img src=\"([^\"]+)\"", page.read_text())
    for target in (one or other for one, other in targets):
        if target.startswith("http"):
            continue
        file, _, anchor = target.partition("#")
        goal = page.parent / file if file else page
        assert goal.exists(), target
        assert not anchor or anchor in anchors(goal), target
