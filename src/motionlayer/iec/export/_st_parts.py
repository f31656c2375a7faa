"""What an exported project is given beside declarations: functions that split a state, and a block that carries by ADS.

Their texts are files of Structured Text in `templates`; what depends on the machine, sizes and the table of the
variables that are carried, stands between @.
"""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

from motionlayer.iec.export._declarations import Declarations, Variable
from motionlayer.iec.export._st_object import StKind, StMethod, StObject, head, unit

_FOLDER: Final = Path(__file__).parent / "templates"
_UNITS: Final = ("F_StateCommand", "F_StateProgress", "FB_MotionLayerAds")
_TYPES: Final = ("E_MOTION_LAYER_ADS", "ST_MOTION_LAYER_PLACE", "ST_MOTION_LAYER_IMAGE")

_PLACE: Final = 12
"""Bytes that name a variable in a sum request: index group, index offset, length."""
_CODE: Final = 4
"""Bytes of a result."""


def parts(told: Declarations) -> Iterator[StObject]:
    """Yield the functions and the block with its types; nothing where no layer is told of."""
    if not told.start:
        return
    for name in _TYPES:
        yield StObject(StKind.DUT, name, _text(name))
    known = {"START": told.start} | _table(told)
    for name in _UNITS:
        yield _unit(name, re.sub(r"@(\w+)@", lambda one: known[one[1]], _text(name)))


def carried(told: Declarations) -> list[tuple[str, Variable]]:
    """Return the variables that go by ADS with the names of their symbols: those that are images of lists in use."""
    return [
        (f"{group.name}.{one.name}", one)
        for group in told.lists
        for one in group.variables
        if group.used and one.written is not None
    ]


def _text(name: str) -> str:
    return (_FOLDER / f"{name}.st").read_text(encoding="utf-8").rstrip()


def _unit(name: str, text: str) -> StObject:
    """Return a unit, what stands between it and the next one being the comment of that one."""
    first, *others = re.split(r"\n\n(?=// [^\n]*\nMETHOD )", text)
    declaration, body = unit(first)
    return StObject(StKind.POU, name, declaration, body, tuple(_methods(others)))


def _methods(texts: Sequence[str]) -> Iterator[StMethod]:
    for text in texts:
        declaration, body = unit(text)
        yield StMethod(head(declaration)[1], declaration, body)


def _table(told: Declarations) -> dict[str, str]:
    """Return the rows of the variables, and the room that requests and answers need."""
    rows = carried(told)
    out = [one for _, one in rows if one.written]
    back = [one for _, one in rows if not one.written]
    order = sum(_PLACE + one.type.size for one in out) + _PLACE * len(back)
    answer = _CODE + 1 + sum(_CODE + one.type.size for one in back)
    return {
        "IMAGES": str(len(rows)),
        "ORDER": str(order),
        "ANSWER": str(max(answer, _CODE * len(out))),
        "ROWS": "\n".join(_row(name, one) for name, one in rows),
    }


def _row(name: str, one: Variable) -> str:
    written, optional = (str(flag).upper() for flag in (bool(one.written), one.optional))
    return (
        f"AddImage(sSymbol := '{name}', pData := ADR({name}), nSize := SIZEOF({name}),\n"
        f"    bWritten := {written}, bOptional := {optional});"
    )
