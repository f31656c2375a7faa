"""Declarations as a header for C11 and C++20.

Layouts are told to the compiler by `#pragma pack`, and checked by it: a wrong offset does not compile. Members of
enumerations carry the name of their enumeration, since C has one name space for all; a variable of one is of the
integer type, whose size an `enum` would not promise. A macro `NAME_INIT` has the declared start values of a type, and
those of a variable that begins with others than its type.
"""

from collections.abc import Iterator, Sequence
from math import prod
from typing import Any, Final

from motionlayer.iec import (
    BIT,
    DINT,
    LINT,
    LWORD,
    REAL,
    Array,
    Boolean,
    Enumeration,
    IecType,
    Integer,
    Member,
    Real,
    String,
    StructType,
)
from motionlayer.iec.export._declarations import (
    AnyEnumeration,
    AnyStruct,
    Declarations,
    VariableList,
    counts,
    element,
    number,
    one_line,
    runs,
    units,
)

NAME: Final = "motion_layer.h"

_SIDES: Final = {True: "image written here", False: "image read here", None: "by symbol"}

_HEAD: Final = """\
#ifndef MOTION_LAYER_H
#define MOTION_LAYER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define MOTION_LAYER_CHECK(what) static_assert(what, #what)
#else
#define MOTION_LAYER_CHECK(what) _Static_assert(what, #what)
#endif

/* Numbers are little-endian, and doubles aligned to 8 bytes; where they are not, a check below fails. Arrays begin at 0
   here: element 1 of the interface is element 0. Text is Windows-1252, ended by a zero. BOOL is 0 or 1. */
"""


_STATES: Final = """\
/* Command and progress of a state, for instance 12 and 10000 of 10012, 12 and 100 of 112. */
static inline uint16_t motion_layer_command(uint16_t state)
{
    return state >= 100 && state < 1000 ? (uint16_t)(state - 100) : (uint16_t)(state % 1000);
}

static inline uint16_t motion_layer_progress(uint16_t state)
{
    return state >= 100 && state < 1000 ? 100 : (uint16_t)(state - state % 1000);
}
"""


def c_header(told: Declarations) -> dict[str, str]:
    """Return the header by its name."""
    lines = [f"/* {one_line(told.title)} */", _HEAD]
    for enumeration in told.enumerations():
        lines += _enumeration(enumeration)
    for struct in told.structs():
        lines += _struct(struct)
    lines += [f"typedef {kind.name} {name};\n" for name, kind in told.aliases.items()]
    lines += [*_constants(told)]
    for group in told.lists:
        lines += _list(group)
    lines += [_STATES] if told.start else []
    return {NAME: "\n".join([*lines, "#endif"]) + "\n"}


def c_type(kind: IecType[Any, Any]) -> str:
    """Return the type of a scalar, or of the elements of an array, in C."""
    kind = element(kind)
    if isinstance(kind, Enumeration | StructType):
        return kind.name
    if isinstance(kind, String):
        return "char" if kind.alignment == 1 else "uint16_t"
    if isinstance(kind, Real):
        return "float" if kind is REAL else "double"
    if isinstance(kind, Boolean):
        return "uint8_t"
    assert isinstance(kind, Integer)
    return f"{'int' if kind.low else 'uint'}{8 * kind.size}_t"


def _enumeration(kind: AnyEnumeration) -> Iterator[str]:
    yield f"typedef {c_type(kind.base)} {kind.name};"
    yield from ["enum", "{"]
    yield from (f"    {kind.name}_{name} = {int(value)}," for name, value in kind.items)
    yield from ["};", ""]


def _struct(kind: AnyStruct) -> Iterator[str]:
    yield from [f"/* {one_line(kind.comment)} */"] if kind.comment else []
    yield from [f"#pragma pack(push, {kind.pack})", f"typedef {'union' if kind.union else 'struct'}", "{"]
    yield from (f"    {_member(one)}" for one in kind.fields)
    yield from [f"}} {kind.name};", "#pragma pack(pop)"]
    yield f"MOTION_LAYER_CHECK(sizeof({kind.name}) == {kind.size});"
    for run in runs(kind):
        if run[0].bit is None:
            yield f"MOTION_LAYER_CHECK(offsetof({kind.name}, {run[0].name}) == {run[0].offset});"
    yield from [f"#define {kind.name}_INIT {_begun(kind, {})}", ""]


def _member(one: Member) -> str:
    text = f" /* {_told(one)} */" if _told(one) else ""
    if one.type is BIT:
        return f"uint8_t {one.name} : 1;{text}"
    return f"{c_type(one.type)} {one.name}{_room(one.type)};{text}"


def _told(one: Member) -> str:
    """Return what a member means; of an array its declared bounds too."""
    bounds = one.type.name.partition(" OF ")[0].removeprefix("ARRAY ") if counts(one.type) else ""
    return one_line(", ".join(filter(None, (bounds, one.comment))))


def _room(kind: IecType[Any, Any]) -> str:
    inner = element(kind)
    shape = [*counts(kind), *([inner.length + 1] if isinstance(inner, String) else [])]
    return "".join(f"[{count}]" for count in shape)


def _start(one: Member) -> str:
    """Return the start value of a member, empty where it is zero."""
    inner, shape = element(one.type), counts(one.type)
    if one.default is None and isinstance(inner, StructType):
        if not _has_starts(inner):
            return ""
        return f".{one.name} = {_nested([f'{inner.name}_INIT'] * prod(shape), shape)}"
    return "" if one.default is None else f".{one.name} = {literal(one.type, one.default)}"


def _begun(kind: IecType[Any, Any], start: Any) -> str:  # noqa: ANN401 - as in `literal`
    """Return a start value as an initialiser; members that it does not name have their own."""
    if isinstance(kind, StructType):
        starts = (_given(one, start[one.name]) if one.name in start else _start(one) for one in kind.fields)
        return f"{{ {', '.join(filter(None, starts)) or '0'} }}"
    if isinstance(kind, Array):
        return _nested([_begun(kind.of, one) for one in start], kind.bounds.shape)
    return literal(kind, start)


def _given(one: Member, start: Any) -> str:  # noqa: ANN401
    return f".{one.name} = {_begun(one.type, start)}"


def _has_starts(kind: AnyStruct) -> bool:
    return any(_start(one) for one in kind.fields)


def literal(kind: IecType[Any, Any], value: Any) -> str:  # noqa: ANN401 - values differ by type
    """Return a value as an initialiser in C."""
    if isinstance(kind, Enumeration):
        named = kind.iec_name(value)
        return named if named.lstrip("-").isdigit() else f"{kind.name}_{named}"
    if isinstance(kind, Boolean):
        return str(int(value))
    if isinstance(kind, String):
        return _text(kind, value)
    if isinstance(kind, Array):
        return _nested([literal(kind.of, one) for one in value], kind.bounds.shape)
    if isinstance(kind, StructType):
        parts = (f".{one.name} = {literal(one.type, getattr(value, one.attribute))}" for one in kind.fields)
        return "{ " + ", ".join(parts) + " }"
    return _number(kind, value)


def _text(kind: String, value: str) -> str:
    """Return a text; what is no plain character is written as its code, three octal digits long."""
    codes = [int.from_bytes(one, "little") for one in units(kind, value)]
    if kind.alignment > 1:
        return "{ " + ", ".join(map(str, [*codes, 0])) + " }"
    shown = (chr(code) if 0x20 <= code < 0x7F and chr(code) not in '"\\?' else f"\\{code:03o}" for code in codes)
    return '"' + "".join(shown) + '"'


def _nested(items: list[str], shape: Sequence[int]) -> str:
    """Return the elements of an array in braces, a pair for each dimension."""
    for count in reversed(shape):
        items = ["{ " + ", ".join(items[at : at + count]) + " }" for at in range(0, len(items), count)]
    return items[0]


def _number(kind: IecType[Any, Any], value: float) -> str:
    """Return a number; a negative one is an operation in C, and the lowest of LINT has no literal to negate."""
    if not isinstance(kind, Integer):
        return number(kind, value) + ("f" if kind is REAL else "")
    if kind.low == 0:
        return f"{value}{'ULL' if kind.size == LWORD.size else 'U'}"
    if value == LINT.low:
        return f"({value + 1}LL - 1)"
    return f"{value}{'LL' if abs(value) > DINT.high else ''}"


def _constants(told: Declarations) -> Iterator[str]:
    for one in told.constants:
        text = f" /* {one_line(one.comment)} */" if one.comment else ""
        yield f"#define {told.constant_list}_{one.name} {literal(one.type, one.value)}{text}"
    yield ""


def _list(group: VariableList) -> Iterator[str]:
    """Yield the type and the name of each variable, as an image or a symbol of the motion side."""
    for one in group.variables:
        yield f"/* {one_line(one.comment)}; {_SIDES[one.written]} */"
        yield f"typedef {c_type(one.type)} {group.name}_{one.name}{_room(one.type)};"
        yield f'#define {group.name}_{one.name}_SYMBOL "{group.name}.{one.name}"'
        yield f"MOTION_LAYER_CHECK(sizeof({group.name}_{one.name}) == {one.type.size});"
        if one.start is not None:
            yield f"#define {group.name}_{one.name}_INIT {_begun(one.type, one.start)}"
    yield ""
