"""Pages of the function blocks: what the code and a run say, one for each, and all of them linked."""

import re
from types import ModuleType

import pytest

from tests.scripts import ROOT, script

FOLDER = ROOT / "docs" / "blocks"


@pytest.fixture(scope="module")
def generator() -> ModuleType:
    return script("blocks")


def test_pages_and_pictures_are_current(generator: ModuleType) -> None:
    made = generator.pages()
    assert len(made) > 40
    assert {path.name for path in FOLDER.iterdir()} == set(made)
    for name, text in made.items():
        assert (FOLDER / name).read_text(encoding="utf-8") == text, f"{name}: run scripts/blocks.py"


def test_every_output_of_a_block_is_explained(generator: ModuleType) -> None:
    for name, block in generator.blocks().items():
        made = generator._instance(block)
        shown = {one for one in vars(made) if not one.startswith("_")} - set(block.INPUTS) - set(block.HIDDEN)
        assert shown <= set(generator._outputs(made)), name


def test_the_overview_links_every_page() -> None:
    linked = re.findall(r"\(blocks/(\w+\.md)\)", (ROOT / "docs" / "blocks.md").read_text(encoding="utf-8"))
    assert set(linked) == {path.name for path in FOLDER.glob("*.md")}
