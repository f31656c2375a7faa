"""Objects of a TwinCAT project: the XML by a parser of XML, the text in it by a parser of Structured Text."""

import re
import uuid
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from motionlayer.iec import DINT, Field, Struct
from motionlayer.iec.export import Declarations, structured_text, twincat
from motionlayer.layer import Features, Globals, Sizes, control_side
from motionlayer.machine import Machine, Simulation, interface
from tests.scripts import ROOT

from .plc import parsed

LAYER = control_side(Globals(Sizes(2), Features()), "two axes")
MACHINES = sorted(
    file
    for file in (ROOT / "examples").rglob("*.toml")
    if re.search(r"^\[(layer|control)\]", file.read_text(encoding="utf-8"), re.MULTILINE)
)


def texts(node: ET.Element) -> list[str]:
    """Return what stands in an object as units of plain text."""
    (declaration,) = (one.text or "" for one in node.findall("Declaration"))
    body = "".join(one.text or "" for one in node.findall("Implementation/ST"))
    found = re.search(r"^(FUNCTION_BLOCK|FUNCTION|METHOD) ", declaration, re.MULTILINE)
    whole = f"{declaration}\n{body}\nEND_{found[1]}" if found else declaration
    return [whole, *(text for method in node.findall("Method") for text in texts(method))]


@pytest.mark.parametrize("path", twincat(LAYER))
def test_a_file_holds_one_object_of_its_name(path: str) -> None:
    (node,) = ET.fromstring(twincat(LAYER)[path])  # noqa: S314 - our own text
    assert f"{node.get('Name')}.Tc{node.tag}" == Path(path).name
    assert uuid.UUID(node.get("Id")).version == 5
    assert re.search(rf"\b(TYPE|FUNCTION|FUNCTION_BLOCK|list) {node.get('Name')}\b", "".join(texts(node)))


def test_identities_are_unique_and_stay_the_same() -> None:
    found = re.findall(r'Id="([^"]*)"', "".join(twincat(LAYER).values()))
    assert len(set(found)) == len(found)
    assert found == re.findall(r'Id="([^"]*)"', "".join(twincat(LAYER).values()))


def test_objects_hold_what_is_printed() -> None:
    objects = "\n".join(text for file in twincat(LAYER).values() for text in texts(ET.fromstring(file)[0]))  # noqa: S314
    printed = "".join(structured_text(LAYER).values())
    lines = {line for line in printed.splitlines() if line.strip() and not line.startswith("// ")}
    assert lines - set(objects.splitlines()) == set()


def test_comments_speak_the_language_of_the_interface() -> None:
    """Neither names of Python nor places in texts that a reader has not."""
    printed = "".join(structured_text(LAYER).values())
    comments = [line.partition("// ")[2] for line in printed.splitlines() if "// " in line]
    assert [one for one in comments if "`" in one or re.search(r"motion-layer \d", one)] == []


def test_library_types_have_a_folder_of_their_own() -> None:
    files = twincat(LAYER)
    assert "libraries/MC_Direction.TcDUT" in files
    assert "DUTs/ST_HOMING.TcDUT" in files
    assert "DUTs/MC_Direction.TcDUT" not in files


def test_a_comment_that_would_end_the_section() -> None:
    class Odd(Struct, iec="ST_ODD"):
        """Odd ]]> comment."""

        number = Field("nNumber", DINT, "a <number> & ]]>")

    (file,) = twincat(Declarations("test", [Odd.type])).values()
    (text,) = texts(ET.fromstring(file)[0])  # noqa: S314
    assert "nNumber : DINT; // a <number> & ]]>" in text


@pytest.mark.slow
@pytest.mark.parametrize("file", MACHINES, ids=lambda one: str(one.relative_to(ROOT)))
def test_every_example_is_structured_text(file: Path) -> None:
    with Simulation(Machine.load(file), ads=False, log=False) as run:
        files = twincat(interface(run))
    for one in files.values():
        for text in texts(ET.fromstring(one)[0]):  # noqa: S314
            parsed(text)


def test_the_parser_refuses_what_is_none() -> None:
    with pytest.raises(Exception, match="END_TIPE"):
        parsed("TYPE ST_X :\nSTRUCT\n    n : UINT;\nEND_STRUCT\nEND_TIPE")
