"""Types and values as C# writes them."""

import json
from collections.abc import Iterator, Mapping
from math import prod
from typing import Any, Final

from motionlayer.iec import REAL, Array, Boolean, Enumeration, IecType, Integer, Real, String, StructType
from motionlayer.iec.export._declarations import AnyStruct, counts, element, number, runs

INTEGERS: Final = {1: "byte", 2: "ushort", 4: "uint", 8: "ulong", -1: "sbyte", -2: "short", -4: "int", -8: "long"}
"""By size in bytes, negative where the type has a sign."""


def cs_type(kind: IecType[Any, Any]) -> str:
    """Return the type of a scalar or a structure in C#."""
    if isinstance(kind, Enumeration | StructType):
        return kind.name
    if isinstance(kind, String):
        return "string"
    if isinstance(kind, Real):
        return "float" if kind is REAL else "double"
    if isinstance(kind, Boolean):
        return "bool"
    assert isinstance(kind, Integer)
    return INTEGERS[-kind.size if kind.low else kind.size]


def literal(kind: IecType[Any, Any], value: Any) -> str:  # noqa: ANN401 - values differ by type
    """Return a value as an expression in C#."""
    if isinstance(kind, Enumeration):
        named = kind.iec_name(value)
        return f"({kind.name}){named}" if named.lstrip("-").isdigit() else f"{kind.name}.{named}"
    if isinstance(kind, Boolean):
        return "true" if value else "false"
    if isinstance(element(kind), String):
        return json.dumps(value) if is_text(kind) else _codes(kind, value)
    if isinstance(kind, Array):
        return f"new {cs_type(element(kind))}[] {{ " + ", ".join(literal(kind.of, one) for one in value) + " }"
    if isinstance(kind, StructType):
        return f"new {kind.name} {{ " + ", ".join(_given(kind, value)) + " }"
    return number(kind, value) + ("f" if kind is REAL else "")


def _given(kind: AnyStruct, value: object) -> Iterator[str]:
    for one in kind.fields:
        yield f"{one.name} = {literal(one.type, getattr(value, one.attribute))}"


def starts(kind: AnyStruct, start: Mapping[str, Any]) -> Iterator[str]:
    """Yield what members begin with: those that `start` names with its values, the others as declared."""
    for run in runs(kind):
        one = run[0]
        if one.bit is not None:
            byte = sum(1 << (bit.bit or 0) for bit in run if start.get(bit.name, bit.default))
            if byte:
                yield f"bits{one.offset} = 0x{byte:02X}"
        elif one.name in start:
            yield f"{one.name} = {begun(one.type, start[one.name])}"
        elif one.default is not None:
            yield f"{one.name} = {literal(one.type, one.default)}"
        elif (made := _made(one.type)) is not None:
            yield f"{one.name} = {made}"


def begun(kind: IecType[Any, Any], start: Any) -> str:  # noqa: ANN401
    """Return a start value as an expression; members that it does not name have their own."""
    if isinstance(kind, StructType):
        return f"new {kind.name} {{ {', '.join(starts(kind, start))} }}"
    if isinstance(kind, Array) and isinstance(element(kind), StructType):
        return f"new {cs_type(element(kind))}[] {{ {', '.join(begun(kind.of, one) for one in start)} }}"
    return literal(kind, start)


def is_text(kind: IecType[Any, Any]) -> bool:
    """Tell whether a type is a string in C#; WSTRING and arrays of texts are arrays of their codes there."""
    return isinstance(kind, String) and kind.alignment == 1


def _codes(kind: IecType[Any, Any], value: Any) -> str:  # noqa: ANN401
    """Return the codes of a WSTRING or of an array of texts."""
    data, unit = bytearray(kind.size), element(kind).alignment
    kind.pack_into(value, data)
    codes = (str(int.from_bytes(data[at : at + unit], "little")) for at in range(0, kind.size, unit))
    return f"new {INTEGERS[unit]}[] {{ {', '.join(codes)} }}"


def _made(kind: IecType[Any, Any]) -> str | None:
    """Return what makes the start value of a type that C# starts with null; None for others."""
    inner, many = element(kind), prod(counts(kind))
    if isinstance(inner, String):
        return '""' if is_text(kind) else f"new {INTEGERS[inner.alignment]}[{kind.size // inner.alignment}]"
    if isinstance(inner, StructType):
        one = f"{inner.name}.Create()"
        return f"Enumerable.Range(0, {many}).Select(_ => {one}).ToArray()" if counts(kind) else one
    return f"new {cs_type(inner)}[{many}]" if counts(kind) else None
