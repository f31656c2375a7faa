"""Declarations in Structured Text, with the attributes that TwinCAT reads.

Enumerations are qualified and strict: members of different ones may share a name. Every structure tells its pack mode,
so that the default of the project it is put into makes no difference. Variables that the control side writes are
outputs (`%Q*`) and those that it reads inputs (`%I*`), to be linked with the images of the motion side; those without a
place are reached by symbol. All of it is made object by object, as projects keep them, and is put together as one text.
"""

from collections.abc import Iterable, Iterator
from typing import Any, Final

from motionlayer.iec import Array, Boolean, Enumeration, IecType, Member, String, StructType
from motionlayer.iec.export._declarations import (
    AnyEnumeration,
    AnyStruct,
    Constant,
    Declarations,
    Variable,
    VariableList,
    number,
    one_line,
    units,
)
from motionlayer.iec.export._st_object import StKind, StObject
from motionlayer.iec.export._st_parts import parts

MAIN: Final = "motion_layer.st"
LIBRARY: Final = "motion_layer_libraries.st"

_PLACES: Final = {True: " AT %Q*", False: " AT %I*", None: ""}


def structured_text(told: Declarations) -> dict[str, str]:
    """Return the files by their names.

    The second one declares what a project with the motion libraries has already; without such types it is left out.
    """
    title, made = f"// {one_line(told.title)}", st_objects(told)
    library = [one.text for one in made if one.library]
    files = {MAIN: [title, *(one.text for one in made if not one.library)]}
    if library:
        files[LIBRARY] = [f"{title}\n// Only for projects without the motion libraries.", *library]
    return {name: "\n\n".join(texts) + "\n" for name, texts in files.items()}


def st_objects(told: Declarations) -> list[StObject]:
    """Return everything as the objects of a project: types, lists of variables, functions and blocks."""
    return [*_types(told), *_aliases(told), *_constants(told), *map(_list, told.lists), *parts(told)]


def literal(kind: IecType[Any, Any], value: Any) -> str:  # noqa: ANN401 - values differ by type
    """Return a value as it is written in Structured Text."""
    if isinstance(kind, Enumeration):
        named = kind.iec_name(value)
        return named if named.lstrip("-").isdigit() else f"{kind.name}.{named}"
    if isinstance(kind, Boolean):
        return "TRUE" if value else "FALSE"
    if isinstance(kind, String):
        return _text(kind, value)
    if isinstance(kind, Array):
        return "[" + ", ".join(literal(kind.of, one) for one in value) + "]"
    if isinstance(kind, StructType):
        parts = (f"{one.name} := {literal(one.type, getattr(value, one.attribute))}" for one in kind.fields)
        return "(" + ", ".join(parts) + ")"
    return number(kind, value)


def _begun(kind: IecType[Any, Any], start: Any) -> str:  # noqa: ANN401 - as above
    """Return a start value; members that it does not name have their own."""
    if isinstance(kind, StructType):
        parts = (f"{one.name} := {_begun(one.type, start[one.name])}" for one in kind.fields if one.name in start)
        return "(" + ", ".join(parts) + ")"
    if isinstance(kind, Array):
        return "[" + ", ".join(_begun(kind.of, one) for one in start) + "]"
    return literal(kind, start)


def _text(kind: String, value: str) -> str:
    """Return a text; what is no plain character is written as its code."""
    quote, digits = ("'", 2) if kind.alignment == 1 else ('"', 4)
    codes = [int.from_bytes(one, "little") for one in units(kind, value)]
    plain = (chr(code) if 0x20 <= code < 0x7F else f"${code:0{digits}X}" for code in codes)
    return quote + "".join(f"${one}" if one in ("$", quote) else one for one in plain) + quote


def _types(told: Declarations) -> Iterator[StObject]:
    for library in (False, True):
        for enumeration in told.enumerations(library=library):
            yield _object(StKind.DUT, enumeration.name, _enumeration(enumeration), library=library)
        for struct in told.structs(library=library):
            yield _object(StKind.DUT, struct.name, _struct(struct), library=library)


def _object(kind: StKind, name: str, lines: Iterable[str], *, library: bool = False) -> StObject:
    return StObject(kind, name, "\n".join(lines), library=library)


def _enumeration(kind: AnyEnumeration) -> Iterator[str]:
    yield from ["{attribute 'qualified_only'}", "{attribute 'strict'}", "{attribute 'to_string'}"]
    yield from [f"TYPE {kind.name} :", "("]
    last = len(kind.items) - 1
    for at, (name, value) in enumerate(kind.items):
        yield f"    {name} := {int(value)}" + ("" if at == last else ",")
    yield from [f") {kind.base.name};", "END_TYPE"]


def _struct(kind: AnyStruct) -> Iterator[str]:
    word = "UNION" if kind.union else "STRUCT"
    yield from [f"// {one_line(kind.comment)}"] if kind.comment else []
    yield from [f"{{attribute 'pack_mode' := '{kind.pack}'}}", f"TYPE {kind.name} :", word]
    yield from (f"    {one.name} : {one.type.name}{_start(one)};{_comment(one.comment)}" for one in kind.fields)
    yield from [f"END_{word}", "END_TYPE"]


def _start(member: Member) -> str:
    return "" if member.default is None else f" := {literal(member.type, member.default)}"


def _aliases(told: Declarations) -> Iterator[StObject]:
    for name, kind in told.aliases.items():
        yield _object(StKind.DUT, name, [f"TYPE {name} : {kind.name};", "END_TYPE"])


def _comment(text: str) -> str:
    return f" // {one_line(text)}" if text else ""


def _constants(told: Declarations) -> Iterator[StObject]:
    if told.constants:
        lines = [f"// Global variable list {told.constant_list}", "VAR_GLOBAL CONSTANT"]
        lines += [f"    {_constant(one)}" for one in told.constants]
        yield _object(StKind.GVL, told.constant_list, [*lines, "END_VAR"])


def _constant(one: Constant) -> str:
    return f"{one.name} : {one.type.name} := {literal(one.type, one.value)};{_comment(one.comment)}"


def _list(group: VariableList) -> StObject:
    lines = [f"// Global variable list {group.name}", "{attribute 'qualified_only'}", "VAR_GLOBAL"]
    lines += [f"    {_variable(one)}" for one in group.variables]
    return _object(StKind.GVL, group.name, [*lines, "END_VAR"])


def _variable(one: Variable) -> str:
    start = "" if one.start is None else f" := {_begun(one.type, one.start)}"
    return f"{one.name}{_PLACES[one.written]} : {one.type.name}{start};{_comment(one.comment)}"
