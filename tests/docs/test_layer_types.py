"""The pages of types and symbols are what the declarations say, have all of them, and their links lead somewhere."""

import re

import pytest

from motionlayer.layer import Features, Globals, Sizes, types
from tests.scripts import ROOT, script

PAGES: dict[str, str] = script("layer_types").pages()


def headings(text: str) -> list[str]:
    return [line.removeprefix("### ") for line in text.splitlines() if line.startswith("### ")]


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_what_the_code_says(name: str) -> None:
    text = (ROOT / "docs" / name).read_text(encoding="utf-8")
    assert text == PAGES[name], "run scripts/layer_types.py"
    for page, anchor in re.findall(r"\]\(((?:layer-types[a-z-]*\.md)?)#([^)]*)\)", text):
        known = {one.lower() for one in headings(PAGES[page or name])}
        assert anchor in known


def test_every_type_and_list_has_one_section() -> None:
    found = [one for text in PAGES.values() for one in headings(text)]
    assert len(set(found)) == len(found)
    enumerations = [one.name for one in (*types.ENUMERATIONS, *types.LIBRARY_ENUMERATIONS)]
    assert {*enumerations, *Globals(Sizes(1), Features()).lists} <= set(found)


def test_what_is_carried_out_does_not_need_the_other_page() -> None:
    first = PAGES["layer-types.md"]
    assert {"ST_AXIS_CTRL", "ST_HOMING", "E_PROGRESS", "MC_BufferMode"} <= set(headings(first))
    assert not {"ST_NCI_CTRL", "ST_CAM_CTRL", "ST_FLY_CTRL"} & set(headings(first))
    assert re.findall(r"\(layer-types-later\.md#", first) == []
