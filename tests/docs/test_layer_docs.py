"""Pages of the motion layer: drawn from its tables and a run; its defects are all listed, with tests that exist."""

import re
from collections import Counter
from pathlib import Path

from motionlayer.layer import AXIS_JOBS
from motionlayer.layer.types import AxisCommand
from tests.scripts import ROOT, script

DOCS = ROOT / "docs"
DEFECTS = (DOCS / "layer-defects.md").read_text(encoding="utf-8")
LINK = re.compile(r"\[([a-z0-9 ]+)\]\(\.\./(tests/[\w/]+\.py)\)")
TEST = re.compile(r"^(?:async )?def (test_\w+)\(", re.MULTILINE)


def rows() -> dict[int, str]:
    """Return the rows of all tables of defects by their numbers."""
    found = re.findall(r"^\| D(\d+) \|(.*)\|$", DEFECTS, re.MULTILINE)
    assert [number for number, count in Counter(number for number, _ in found).items() if count > 1] == []
    return {int(number): text for number, text in found}


def functions(path: Path) -> set[str]:
    return set(TEST.findall(path.read_text(encoding="utf-8")))


def test_the_states_are_what_the_tables_say() -> None:
    (made,) = script("layer_states").pages().values()
    assert (DOCS / "layer-states.md").read_text(encoding="utf-8") == made, "run scripts/layer_states.py"
    assert made.count("```mermaid") == len(AXIS_JOBS) + 4
    for job in AXIS_JOBS.values():
        assert all(f"| {row.next.name}" in made.partition(f"AXIS_{job.name}\n")[2] for row in job.rows)


def test_the_picture_is_what_the_run_shows() -> None:
    (made,) = script("layer_picture").pages().values()
    assert (DOCS / "images" / "layer.svg").read_text(encoding="utf-8") == made, "run scripts/layer_picture.py"


def test_every_defect_is_listed_once() -> None:
    assert sorted(rows()) == list(range(1, 70))


def test_every_defect_that_concerns_what_is_built_has_a_test_that_exists() -> None:
    built, _, later = DEFECTS.partition("## Not built yet")
    for words, file in LINK.findall(DEFECTS):
        name = f"test_{words.replace(' ', '_')}"
        assert name in functions(ROOT / file), f"{file} has no {name}"
    untested = [number for number, text in rows().items() if f"| D{number} |" in built and not LINK.search(text)]
    assert untested == []
    assert "[what is not built in answers not exist]" in later


def test_every_test_that_names_a_defect_stands_in_its_row() -> None:
    listed = rows()
    named = [name for path in sorted((ROOT / "tests").rglob("test_*.py")) for name in functions(path)]
    for name in named:
        for number in re.findall(r"(?:^test_|_)d(\d\d)(?=_)", name):
            words = name.removeprefix("test_").replace("_", " ")
            assert f"[{words}]" in listed[int(number)], f"{name} is missing in the row of D{int(number)}"


def test_every_command_of_an_axis_is_in_the_table_of_the_guide() -> None:
    guide = (DOCS / "layer.md").read_text(encoding="utf-8")
    for number in (AxisCommand.NULL, *AXIS_JOBS):
        assert f"| {int(number)} | `AXIS_{AxisCommand(number).name}` |" in guide
