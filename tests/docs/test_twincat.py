"""The page for TwinCAT: its program is Structured Text, and what it says of the block is so."""

import re

from tests.iec.plc import parsed
from tests.scripts import ROOT

PAGE = (ROOT / "docs" / "twincat.md").read_text(encoding="utf-8")
FOLDER = ROOT / "src" / "motionlayer" / "iec" / "export" / "templates"


def test_the_program_is_structured_text() -> None:
    (program,) = re.findall(r"^```iecst\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
    parsed(program)


def test_the_steps_are_those_of_the_block() -> None:
    text = (FOLDER / "E_MOTION_LAYER_ADS.st").read_text(encoding="utf-8")
    declared = re.findall(r"^    (\w+) := \d", text, re.MULTILINE)
    assert re.findall(r"^\| ([A-Z]+) \|", PAGE, re.MULTILINE) == declared


def test_what_the_page_names_is_there() -> None:
    block = (FOLDER / "FB_MotionLayerAds.st").read_text(encoding="utf-8")
    for name in ("bEnable", "sNetId", "bReady", "nErrorId", "sErrorSymbol", "tRetry"):
        assert f"`{name}`" in PAGE or f"{name} :=" in PAGE
        assert re.search(rf"^    {name} : ", block, re.MULTILINE)
