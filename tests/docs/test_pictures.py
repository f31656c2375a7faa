"""The pictures of the documentation that are drawn from runs are what these runs show."""

import re

import pytest

from tests.scripts import ROOT, script

IMAGES = ROOT / "docs" / "images"


@pytest.mark.parametrize("name", ["servo.svg", "blending.svg", "homing.svg"])
def test_a_picture_is_what_its_run_shows(name: str) -> None:
    made = script("motion_pictures").PICTURES[name]()
    assert (IMAGES / name).read_text(encoding="utf-8") == made, "run scripts/motion_pictures.py"


def test_every_picture_is_shown_somewhere_and_says_what_it_shows() -> None:
    pages = [ROOT / "README.md", *(ROOT / "docs").glob("*.md")]
    shown = {
        file: text for page in pages for text, file in re.findall(r"!\[([^]]*)\]\(\S*images/(\S+)\)", page.read_text())
    }
    assert set(shown) == {path.name for path in IMAGES.iterdir()}
    assert all(len(text) > 20 for text in shown.values())
