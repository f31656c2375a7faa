"""Write docs/layer-types.md: symbols, constants, structures and enumerations of the motion layer.

`--check` writes nothing and fails if the page is not what the code says.
"""

import sys
import textwrap
from collections.abc import Iterable, Iterator
from typing import Any, Final

from _generated import ROOT, current

from motionlayer.iec import Array, Enumeration, InputArray, Member, Scalar, Struct, StructType
from motionlayer.iec.export import st_literal as literal
from motionlayer.layer import Features, Globals, Sizes, types
from motionlayer.layer._constants import constants
from motionlayer.layer._global_list import Entry, GlobalList

NOTE: Final = "<!-- Written by scripts/layer_types.py from the code; do not edit. -->"
AXES: Final = 6
WIDTH: Final = 118

HEAD: Final = f"""\
# Types and symbols of the motion layer

Everything that stands on the interface of the motion layer, with the bytes that any control program sees.
`motionlayer export MACHINE --st | --c | --csharp` writes the same for the language of the control program, with the
sizes of the machine; here it has {AXES} axes and no other key that sets a size.

- Numbers are little-endian. Text is Windows-1252, ended by a zero.
- *Pack 2*: every member begins at a multiple of 2 bytes, or of its own alignment where that is 1. *Pack 8* is natural
  alignment. A nested structure keeps its own inside.
- A *place* like `0.3` is bit 3 of byte 0. BITs that follow one another share a byte, the lowest bit first.
- In Python a structure is a class of `motionlayer.layer.types`, its members are attributes, and enumerations are
  `enum.IntEnum` whose members lack the prefix of the interface: `ctrl.cmd = AxisCommand.MOVE_POS`. A number without a
  member is read as a plain `int`.
- A state is the number of a command plus a `Progress`: 10012 is `AXIS_MOVE_POS` and `PROGRESS_DONE`.
- u is the unit of the axis.

For the control side:

- `--st` writes `motion_layer.st` and `motion_layer_libraries.st`: one DUT for each TYPE, one GVL for each list. The
  other file is for projects without the motion libraries. Variables at `%Q*` and `%I*` are linked with the
  [images](mapping.md) of the motion side; the rest is reached by symbol.
- `--c` writes `motion_layer.h`, for C11 and C++20. The compiler checks every offset.
  `ST_MOVE_DATA data = ST_MOVE_DATA_INIT;` has the declared start values.
- `--csharp` writes `MotionLayer.cs`, for C# 7.3. `ST_MOVE_DATA.Create()` has the declared start values.

Start values matter: a `rOverride` of 0 lets no axis move.
"""


def pages() -> dict[str, str]:
    """Return the page by its name below docs/."""
    shared = Globals(Sizes(AXES), Features())
    lines = [NOTE, "", HEAD, *_symbols(shared), *_constants(shared), *_structs(shared), *_enumerations()]
    return {"layer-types.md": "\n".join(lines).rstrip() + "\n"}


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> Iterator[str]:
    names = list(head)
    yield "| " + " | ".join(names) + " |"
    yield "|" + "---|" * len(names)
    for row in rows:
        yield "| " + " | ".join(cell.replace("|", r"\|") for cell in row) + " |"
    yield ""


def _symbols(shared: Globals) -> Iterator[str]:
    yield from [
        "## Symbols",
        "",
        "Case makes no difference: `gvl_axis.ctrl[2].ecmd`. Clients can read all.",
        "",
    ]
    for name, group in {**shared.lists, "GVL_MSG_AXIS": shared.messages, "eInit": shared.program}.items():
        yield from [f"### {name if name != 'eInit' else 'Start-up of the programs'}", ""]
        head = ["symbol", "type", "bytes", "written by", "content"]
        yield from _table(head, (_symbol(one) for one in group.entries))
        yield from _aliases(group)


def _symbol(one: Entry) -> list[str]:
    variable = one.variable
    writer = "clients" if isinstance(variable, InputArray) else "the layer"
    return [f"`{variable.name}`", _linked(variable.type), str(variable.type.size), writer, one.comment]


def _aliases(group: GlobalList) -> Iterator[str]:
    also = [f"`{alias}` is `{one.variable.name}`" for one in group.entries for alias in one.aliases]
    yield from [*textwrap.wrap(f"Other names of the same: {', '.join(also)}.", WIDTH), ""] if also else []


def _constants(shared: Globals) -> Iterator[str]:
    yield from ["## Constants", "", "Of `PLC_CONSTANT`, reached with and without that name.", ""]
    rows = (
        [f"`{one.name}`", one.type.name, f"`{literal(one.type, one.value)}`", one.comment]
        for one in constants(shared.sizes, shared.features)
    )
    yield from _table(["constant", "type", "value", "meaning"], rows)


def _structs(shared: Globals) -> Iterator[str]:
    yield from ["## Structures", ""]
    used = {one.name: one for one in shared.symbols.types if isinstance(one, StructType)}
    for cls in vars(types).values():
        if isinstance(cls, type) and issubclass(cls, Struct):
            yield from _struct(used.get(cls.type.name, cls.type))


def _struct(kind: StructType[Any]) -> Iterator[str]:
    yield from [f"### {kind.name}", "", f"{kind.comment} In Python `{kind.cls.__name__}`."]
    yield from [f"{kind.size} bytes, pack {kind.pack}.", ""]
    head = ["place", "member", "type", "start", "in Python", "meaning"]
    yield from _table(head, (_member(one) for one in kind.fields))


def _member(one: Member) -> list[str]:
    place = str(one.offset) if one.bit is None else f"{one.offset}.{one.bit}"
    start = "" if one.default is None or not isinstance(one.type, Scalar) else f"`{literal(one.type, one.default)}`"
    return [place, f"`{one.name}`", _linked(one.type), start, f"`{one.attribute}`", one.comment]


def _linked(kind: Any) -> str:  # noqa: ANN401 - any type
    """Return a type with a link to its section."""
    if isinstance(kind, Array):
        return f"ARRAY [{kind.bounds}] OF {_linked(kind.of)}"
    if isinstance(kind, StructType | Enumeration):
        return f"[{kind.name}](#{kind.name.lower()})"
    return str(kind.name)


def _enumerations() -> Iterator[str]:
    yield from ["## Enumerations", ""]
    for one in types.ENUMERATIONS:
        yield from _enumeration(one)
    yield from ["## Enumerations of the motion libraries", ""]
    yield "The exported Structured Text has them in a file of its own: a project with these libraries has them already."
    yield ""
    for one in types.LIBRARY_ENUMERATIONS:
        yield from _enumeration(one)


def _enumeration(kind: Enumeration[Any]) -> Iterator[str]:
    package = kind.members.__module__.partition("._")[0]
    yield from [f"### {kind.name}", "", f"{kind.base.name}. In Python `{package}.{kind.members.__name__}`.", ""]
    members = " · ".join(f"`{name}`\u00a0{int(value)}" for name, value in kind.items)
    yield from [*(line.replace("\u00a0", " ") for line in textwrap.wrap(members, WIDTH, break_on_hyphens=False)), ""]


if __name__ == "__main__":
    sys.exit(current(__doc__ or "", "scripts/layer_types.py", ROOT / "docs", pages()))
