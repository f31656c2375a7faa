"""The table of errors: complete, in ranges, and advised where the runtime raises them."""

import re
from itertools import pairwise
from pathlib import Path

from motionlayer.command import ERRORS, RANGES, ErrorId, MotionError, range_of

SOURCE = Path(__file__).resolve().parents[2] / "src" / "motionlayer"

# How many errors the source lists, by section; and what the text beside its tables adds: three of the position
# correction, three of the Bode plot.
COUNTS = {
    0x40: 15, 0x41: 40, 0x42: 127, 0x43: 30, 0x44: 19, 0x45: 4, 0x46: 5, 0x4A: 20, 0x4B: 47 + 3, 0x4C: 3, 0x81: 40 + 3,
}  # fmt: skip

PROPER = {"NC", "FIFO", "GoAhead", "M", "D", "G", "Bode"}
"""First words of a text that are no common nouns."""


def test_ids_are_in_order_and_each_lies_in_a_range() -> None:
    assert list(ErrorId) == sorted(ErrorId)
    assert list(ERRORS) == list(ErrorId)
    assert all(range_of(error) is not None for error in ErrorId)


def test_ranges_are_in_order_and_do_not_overlap() -> None:
    for one, following in pairwise(RANGES):
        assert one.first <= one.last < following.first
    assert range_of(0x3FFF) is None


def test_the_table_is_complete() -> None:
    found: dict[int, int] = {}
    for error in ErrorId:
        if error < ErrorId.PROGRAM_FAILED:
            found[error >> 8] = found.get(error >> 8, 0) + 1
    assert found == COUNTS


def test_ids_of_the_illegal_requests_are_those_of_the_field() -> None:
    expected = {
        0x4012: "AXIS_ID", 0x4220: "GROUP_BUSY", 0x4221: "VELOCITY", 0x4223: "FEED_NOT_ENABLED",
        0x4225: "NOT_READY_AT_START", 0x425D: "STOP_ACTIVE", 0x4282: "MODULO_TARGET", 0x4289: "REVERSAL_NOT_PERMITTED",
        0x4292: "BUFFER_FULL", 0x4296: "BLENDING_POSITION", 0x4297: "DISTANCE_TOO_SHORT", 0x429F: "BUFFER_MODE",
        0x42EF: "LOCKED_BY_STOP", 0x4B05: "COMMAND_NOT_PERMITTED", 0x4B64: "BUFFER_MODE_UNSUPPORTED",
        0x8186: "COLLISION",
    }  # fmt: skip
    assert {number: ErrorId(number).name for number in expected} == expected


def test_texts_are_single_and_read_within_a_sentence() -> None:
    for error, (text, advice, raised) in ERRORS.items():
        for said in (text, advice, raised):
            assert said == " ".join(said.split()), error.name
            assert not said.endswith((".", ",", ";", ":")), error.name
        assert text[0].islower() or text.split()[0] in PROPER, error.name


def test_what_the_runtime_raises_says_who_raises_it() -> None:
    used = set()
    for path in SOURCE.rglob("*.py"):
        if "_errors" not in path.parts and path.parent.name != "cli":
            used |= set(re.findall(r"\bErrorId\.([A-Z_]+)\b", path.read_text(encoding="utf-8")))
    silent = {name for name in used & set(ErrorId.__members__) if not ERRORS[ErrorId[name]].raised}
    assert silent == set(), "say in command/_errors what answers with these"


def test_an_error_without_advice_of_its_own_has_that_of_its_range() -> None:
    kin = range_of(ErrorId.CAM_PERIOD)
    assert kin is not None
    assert ERRORS[ErrorId.CAM_PERIOD].advice == kin.advice
    assert str(MotionError(ErrorId.CAM_PERIOD, "cam 3")) == f"cam 3: period not valid [0x4A05]; {kin.advice}"
