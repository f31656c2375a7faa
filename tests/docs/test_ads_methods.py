"""The page of methods is what the symbols of a run say, and shows what its tests run."""

from tests.scripts import ROOT, script


def test_the_page_is_what_the_code_says() -> None:
    ((name, text),) = script("ads_methods").pages().items()
    assert (ROOT / "docs" / name).read_text(encoding="utf-8") == text, "run scripts/ads_methods.py"
    assert "client.invokeRpcMethod(axis, 'MoveAbsolute', move)" in text
    for method in ("MoveAbsolute", "Halt", "Power", "SetOverride"):
        assert f"\n### {method}\n" in text
