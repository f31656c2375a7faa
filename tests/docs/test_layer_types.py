"""The page of types and symbols is what the declarations say, and its links lead somewhere."""

import re

from tests.scripts import ROOT, script


def test_the_page_is_what_the_code_says() -> None:
    (made,) = script("layer_types").pages().values()
    text = (ROOT / "docs" / "layer-types.md").read_text(encoding="utf-8")
    assert text == made, "run scripts/layer_types.py"
    headings = {line.removeprefix("### ").lower() for line in text.splitlines() if line.startswith("### ")}
    assert set(re.findall(r"\]\(#([^)]*)\)", text)) <= headings
