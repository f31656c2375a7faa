"""Objects of a TwinCAT 3 project, a file for each: `.TcDUT`, `.TcGVL`, `.TcPOU`, as PLC projects take them in.

An object has an identity of its own, from its name: exported again it replaces the one that is there.
"""

import uuid
from collections.abc import Iterator
from typing import Final
from xml.sax.saxutils import quoteattr

from motionlayer.iec.export._declarations import Declarations
from motionlayer.iec.export._st import st_objects
from motionlayer.iec.export._st_object import StKind, StObject

_VERSION: Final = 'Version="1.1.0.1" ProductVersion="3.1.4024.0"'
"""Of the file format; newer versions read it."""

_SPACE: Final = uuid.uuid5(uuid.NAMESPACE_URL, "motionlayer:export")
_LIBRARIES: Final = "libraries"


def twincat(told: Declarations) -> dict[str, str]:
    """Return the files by their paths, with / between folders.

    Objects that a project with the motion libraries has already are in the folder `libraries`.
    """
    return {_path(one): "\n".join(_lines(one)) + "\n" for one in st_objects(told)}


def _path(one: StObject) -> str:
    return f"{_LIBRARIES if one.library else f'{one.kind}s'}/{one.name}.Tc{one.kind}"


def _lines(one: StObject) -> Iterator[str]:
    special = ' SpecialFunc="None"' if one.kind is StKind.POU else ""
    yield from ['<?xml version="1.0" encoding="utf-8"?>', f"<TcPlcObject {_VERSION}>"]
    yield f"  <{one.kind} Name={quoteattr(one.name)} Id={_identity(one.name)}{special}>"
    yield f"    <Declaration>{_text(one.declaration)}</Declaration>"
    if one.kind is StKind.POU:
        yield f"    <Implementation><ST>{_text(one.body)}</ST></Implementation>"
    for method in one.methods:
        yield f"    <Method Name={quoteattr(method.name)} Id={_identity(f'{one.name}.{method.name}')}>"
        yield f"      <Declaration>{_text(method.declaration)}</Declaration>"
        yield f"      <Implementation><ST>{_text(method.body)}</ST></Implementation>"
        yield "    </Method>"
    yield from [f"  </{one.kind}>", "</TcPlcObject>"]


def _identity(name: str) -> str:
    return f'"{{{uuid.uuid5(_SPACE, name.lower())}}}"'


def _text(text: str) -> str:
    """Return a text for XML as it is; what would end it is divided between two sections."""
    return f"<![CDATA[{text.replace(']]>', ']]]]><![CDATA[>')}\n]]>"
