"""Write docs/layer-types.md and docs/layer-types-later.md: symbols, constants, structures, enumerations of the layer.

What is carried out comes first, what only has its symbols is on the second page.

`--check` writes nothing and fails if the page is not what the code says.
"""

import sys
import textwrap
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import Any, Final

from _generated import ROOT, current

from motionlayer.iec import Array, Enumeration, InputArray, Member, Scalar, Struct, StructType
from motionlayer.iec.export import st_literal as literal
from motionlayer.layer import Features, Globals, Sizes, types
from motionlayer.layer._constants import constants
from motionlayer.layer._declarations import TYPE_ALIASES
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

- `--st` prints Structured Text. `--st --out FOLDER` writes the objects of a TwinCAT 3 project, a file for each, and a
  block that carries all of it by ADS: [You have a TwinCAT PLC](twincat.md). Variables at `%Q*` and `%I*` can be linked
  with the [images](mapping.md) of the motion side as well; those without a place are reached by symbol.
- `--c` is `motion_layer.h`, for C11 and C++20. The compiler checks every offset.
  `ST_MOVE_DATA data = ST_MOVE_DATA_INIT;` has the declared start values.
- `--csharp` is `MotionLayer.cs`, for C# 7.3. `ST_MOVE_DATA.Create()` has the declared start values.

- Each has what splits a state into command and progress: `F_StateCommand`, `motion_layer_command`, `State.Command`.

Start values matter: a `rOverride` of 0 lets no axis move. `HomeParameter` begins with `home.position` of the axes
where one is not 0: declared with the variable in Structured Text, `GVL_AXIS_HomeParameter_INIT` in C,
`GVL_AXIS.CreateHomeParameter()` in C#.

The variables of channels, cams, flying saws, touch probes and trigger boxes have their symbols, and answer NOT_EXIST:
[types that wait](layer-types-later.md).
"""

LATER_HEAD: Final = """\
# Types and symbols that wait

What has its place, its bytes and its symbols, and is not carried out yet: NCI channels, cams, flying saws, touch
probes and trigger boxes. Their commands answer NOT_EXIST, command + 100. How to read this page:
[types and symbols](layer-types.md).
"""

MAIN: Final = "layer-types.md"
LATER: Final = "layer-types-later.md"
USED: Final = ("GVL_AXIS", "GVL_MSG_AXIS", START := "eInit")
"""Lists whose variables are carried out, and that of all programs."""


class Page:
    """A page of types.

    Args:
        name: of the file.
        head: what comes first.
        groups: lists of variables, by their names.
        kinds: types that are described here, others on the other page.
    """

    def __init__(self, name: str, head: str, groups: Mapping[str, GlobalList], kinds: Collection[str]) -> None:
        self.name, self.head, self.groups, self.kinds = name, head, groups, kinds

    def text(self, shared: Globals, constants: Iterable[str]) -> str:
        """Return the page."""
        parts = [*_symbols(self), *constants, *_structs(shared, self), *_enumerations(self)]
        return "\n".join([NOTE, "", self.head, *parts]).rstrip() + "\n"

    def linked(self, kind: Any) -> str:  # noqa: ANN401 - any type
        """Return a type with a link to its section."""
        if isinstance(kind, Array):
            return f"ARRAY [{kind.bounds}] OF {self.linked(kind.of)}"
        if isinstance(kind, StructType | Enumeration):
            other = MAIN if self.name == LATER else LATER
            return f"[{kind.name}]({'' if kind.name in self.kinds else other}#{kind.name.lower()})"
        return str(kind.name)


def pages() -> dict[str, str]:
    """Return the pages by their names below docs/."""
    shared = Globals(Sizes(AXES), Features())
    lists = {**shared.lists, "GVL_MSG_AXIS": shared.messages, START: shared.program}
    groups = {name: group for name, group in lists.items() if name in USED}
    later = {name: group for name, group in lists.items() if name not in USED}
    waiting = _kinds(later) - _kinds(groups)
    known = {one.name for one in [*_every_struct(shared), *_every_enumeration()]}
    waiting |= {name for name in known if name.startswith(_WAITING)}
    first, second = Page(MAIN, HEAD, groups, known - waiting), Page(LATER, LATER_HEAD, later, waiting)
    return {MAIN: first.text(shared, _constants(shared)), LATER: second.text(shared, ())}


_WAITING: Final = (
    "E_NCI",
    "E_CAM",
    "E_FLY",
    "MC_Cam",
    "MC_Table",
    "MC_Motion",
    "MC_Interpolation",
    "E_GearIn",
    "E_XFC",
    "E_SignalEdge",
    "ST_Index",
)
"""What the names of types begin with that no variable has, but programs for what is not carried out."""


def _kinds(groups: Mapping[str, GlobalList]) -> set[str]:
    """Return the names of the types that the variables are made of."""
    return {one.name for group in groups.values() for entry in group.entries for one in _parts(entry.variable.type)}


def _parts(kind: Any) -> Iterator[Any]:  # noqa: ANN401 - any type
    while isinstance(kind, Array):
        kind = kind.of
    if isinstance(kind, StructType):
        for one in kind.fields:
            yield from _parts(one.type)
    if isinstance(kind, StructType | Enumeration):
        yield kind


def _every_struct(shared: Globals) -> Iterator[StructType[Any]]:
    """Yield all structures, those whose sizes the machine says as they are there."""
    used = {one.name: one for one in shared.symbols.types if isinstance(one, StructType)}
    for cls in vars(types).values():
        if isinstance(cls, type) and issubclass(cls, Struct):
            yield used.get(cls.type.name, cls.type)


def _every_enumeration() -> Iterator[Enumeration[Any]]:
    yield from types.ENUMERATIONS
    yield from types.LIBRARY_ENUMERATIONS


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> Iterator[str]:
    names = list(head)
    yield "| " + " | ".join(names) + " |"
    yield "|" + "---|" * len(names)
    for row in rows:
        yield "| " + " | ".join(cell.replace("|", r"\|") for cell in row) + " |"
    yield ""


def _symbols(page: Page) -> Iterator[str]:
    yield from [
        "## Symbols",
        "",
        "Case makes no difference: `gvl_axis.ctrl[2].ecmd`. Clients can read all.",
        "",
    ]
    for name, group in page.groups.items():
        yield from [f"### {name if name != START else 'Start-up of the programs'}", ""]
        head = ["symbol", "type", "bytes", "written by", "content"]
        yield from _table(head, (_symbol(one, page) for one in group.entries))
        yield from _aliases(group)


def _symbol(one: Entry, page: Page) -> list[str]:
    variable = one.variable
    writer = "clients" if isinstance(variable, InputArray) else "the layer"
    return [f"`{variable.name}`", page.linked(variable.type), str(variable.type.size), writer, one.comment]


def _aliases(group: GlobalList) -> Iterator[str]:
    also = [f"`{alias}` is `{one.variable.name}`" for one in group.entries for alias in one.aliases]
    used = [one.variable.of for one in group.entries]
    also += [f"type `{alias}` is `{kind.name}`" for alias, kind in TYPE_ALIASES.items() if kind in used]
    yield from [*textwrap.wrap(f"Other names of the same: {', '.join(also)}.", WIDTH), ""] if also else []


def _constants(shared: Globals) -> Iterator[str]:
    yield from ["## Constants", "", "Of `PLC_CONSTANT`, reached with and without that name.", ""]
    rows = (
        [f"`{one.name}`", one.type.name, f"`{literal(one.type, one.value)}`", one.comment]
        for one in constants(shared.sizes, shared.features)
    )
    yield from _table(["constant", "type", "value", "meaning"], rows)


def _structs(shared: Globals, page: Page) -> Iterator[str]:
    yield from ["## Structures", ""]
    for one in _every_struct(shared):
        if one.name in page.kinds:
            yield from _struct(one, page)


def _struct(kind: StructType[Any], page: Page) -> Iterator[str]:
    yield from [f"### {kind.name}", "", f"{kind.comment} In Python `{kind.cls.__name__}`."]
    yield from [f"{kind.size} bytes, pack {kind.pack}.", ""]
    head = ["place", "member", "type", "start", "in Python", "meaning"]
    yield from _table(head, (_member(one, page) for one in kind.fields))


def _member(one: Member, page: Page) -> list[str]:
    place = str(one.offset) if one.bit is None else f"{one.offset}.{one.bit}"
    start = "" if one.default is None or not isinstance(one.type, Scalar) else f"`{literal(one.type, one.default)}`"
    return [place, f"`{one.name}`", page.linked(one.type), start, f"`{one.attribute}`", one.comment]


def _enumerations(page: Page) -> Iterator[str]:
    yield from ["## Enumerations", ""]
    for one in types.ENUMERATIONS:
        if one.name in page.kinds:
            yield from _enumeration(one)
    yield from ["## Enumerations of the motion libraries", ""]
    yield from ["A project with these libraries has them already; in an export they are apart.", ""]
    for one in types.LIBRARY_ENUMERATIONS:
        if one.name in page.kinds:
            yield from _enumeration(one)


def _enumeration(kind: Enumeration[Any]) -> Iterator[str]:
    package = kind.members.__module__.partition("._")[0]
    yield from [f"### {kind.name}", "", f"{kind.base.name}. In Python `{package}.{kind.members.__name__}`.", ""]
    members = " · ".join(f"`{name}`\u00a0{int(value)}" for name, value in kind.items)
    yield from [*(line.replace("\u00a0", " ") for line in textwrap.wrap(members, WIDTH, break_on_hyphens=False)), ""]


if __name__ == "__main__":
    sys.exit(current(__doc__ or "", "scripts/layer_types.py", ROOT / "docs", pages()))
