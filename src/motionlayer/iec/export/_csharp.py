"""Declarations in C#, for `System.Runtime.InteropServices.Marshal` and for ADS clients that marshal by it; C# 7.3.

Structures are sequential with their pack mode. A byte of BITs is a byte with one property per bit. A structure in C#
has no start values and no arrays of its own: `Create()` makes one with both, as declared. Text is marshalled in the
ANSI code page of the system, which is that of the interface on Windows alone; ASCII is the same everywhere.
"""

import json
from collections.abc import Iterator, Sequence
from math import prod
from typing import Any, Final

from motionlayer.iec import REAL, Array, Boolean, Enumeration, IecType, Integer, Member, Real, String, StructType
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
)

NAME: Final = "MotionLayer.cs"

_INTEGERS: Final = {1: "byte", 2: "ushort", 4: "uint", 8: "ulong", -1: "sbyte", -2: "short", -4: "int", -8: "long"}
"""By size in bytes, negative where the type has a sign."""

_SIDES: Final = {True: "Side.Writes", False: "Side.Reads", None: "Side.Symbol"}

_HEAD: Final = """\
using System;
using System.Linq;
using System.Runtime.InteropServices;

namespace MotionLayer
{
    /// <summary>How the control side reaches a variable: by an image that it writes or reads, or by symbol.</summary>
    public enum Side
    {
        Writes,
        Reads,
        Symbol,
    }

    /// <summary>A variable of the motion side: its name, type and number of elements, and its bytes.</summary>
    public sealed class Symbol
    {
        public readonly string Name;
        public readonly Type Element;
        public readonly int Count;
        public readonly int Size;
        public readonly Side Side;

        public Symbol(string name, Type element, int count, int size, Side side)
        {
            Name = name;
            Element = element;
            Count = count;
            Size = size;
            Side = side;
        }
    }
"""

_STATES: Final = """\
    /// <summary>Command and progress of a state, for instance 12 and 10000 of 10012, 12 and 100 of 112.</summary>
    public static class State
    {
        public static ushort Command(ushort state) =>
            (ushort)(state >= 100 && state < 1000 ? state - 100 : state % 1000);

        public static ushort Progress(ushort state) =>
            (ushort)(state >= 100 && state < 1000 ? 100 : state - state % 1000);
    }
"""


def csharp(told: Declarations) -> dict[str, str]:
    """Return the file by its name.

    Raises:
        ValueError: a union has members that cannot share memory in C#.
    """
    lines = [f"// {one_line(told.title)}", _HEAD, *([_STATES] if told.start else [])]
    for enumeration in told.enumerations():
        lines += _indented(_enumeration(enumeration))
    for struct in told.structs():
        lines += _indented(_struct(struct))
    lines += _indented(_constants(told))
    for group in told.lists:
        lines += _indented(_list(group))
    return {NAME: "\n".join([*lines[:-1], "}"]) + "\n"}


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
    return _INTEGERS[-kind.size if kind.low else kind.size]


def literal(kind: IecType[Any, Any], value: Any) -> str:  # noqa: ANN401 - values differ by type
    """Return a value as an expression in C#."""
    if isinstance(kind, Enumeration):
        named = kind.iec_name(value)
        return f"({kind.name}){named}" if named.lstrip("-").isdigit() else f"{kind.name}.{named}"
    if isinstance(kind, Boolean):
        return "true" if value else "false"
    if isinstance(kind, String):
        return json.dumps(value)
    if isinstance(kind, Array):
        return f"new {cs_type(element(kind))}[] {{ " + ", ".join(literal(kind.of, one) for one in value) + " }"
    if isinstance(kind, StructType):
        return f"new {kind.name} {{ " + ", ".join(_given(kind, value)) + " }"
    return number(kind, value) + ("f" if kind is REAL else "")


def _given(kind: AnyStruct, value: object) -> Iterator[str]:
    for one in kind.fields:
        yield f"{one.name} = {literal(one.type, getattr(value, one.attribute))}"


def _enumeration(kind: AnyEnumeration) -> Iterator[str]:
    yield from [f"public enum {kind.name} : {cs_type(kind.base)}", "{"]
    yield from (f"    {name} = {int(value)}," for name, value in kind.items)
    yield from ["}", ""]


def _struct(kind: AnyStruct) -> Iterator[str]:
    yield from _summary(kind.comment)
    how = "Explicit" if kind.union else f"Sequential, Pack = {kind.pack}"
    yield f"[StructLayout(LayoutKind.{how}, Size = {kind.size}, CharSet = CharSet.Ansi)]"
    yield from [f"public struct {kind.name}", "{"]
    for run in runs(kind):
        yield from (f"    {line}" for line in (_member(run[0], kind) if run[0].bit is None else _bits(run)))
    yield from ["", "    /// <summary>Start values as declared, and room for arrays.</summary>"]
    yield f"    public static {kind.name} Create() => new {kind.name}"
    yield from ["    {", *(f"        {line}," for line in _starts(kind)), "    };", "}", ""]


def _member(one: Member, kind: AnyStruct) -> Iterator[str]:
    yield from _summary(one.comment)
    inner, many = element(one.type), prod(counts(one.type))
    if kind.union:
        if counts(one.type) or isinstance(inner, String):
            raise ValueError(f"{kind.name}.{one.name}: an array or a text cannot be in a union in C#; nest a structure")
        yield "[FieldOffset(0)]"
    if isinstance(inner, String) and not _is_text(one.type):
        yield f"[MarshalAs(UnmanagedType.ByValArray, SizeConst = {one.type.size // inner.alignment})]"
        yield f"public {_INTEGERS[inner.alignment]}[] {one.name};"
    elif counts(one.type):
        elements = ", ArraySubType = UnmanagedType.I1" if isinstance(inner, Boolean) else ""
        yield f"[MarshalAs(UnmanagedType.ByValArray, SizeConst = {many}{elements})]"
        yield f"public {cs_type(inner)}[] {one.name};"
    else:
        if isinstance(inner, String):
            yield f"[MarshalAs(UnmanagedType.ByValTStr, SizeConst = {inner.size})]"
        elif isinstance(inner, Boolean):
            yield "[MarshalAs(UnmanagedType.I1)]"
        yield f"public {cs_type(inner)} {one.name};"


def _bits(run: Sequence[Member]) -> Iterator[str]:
    byte = f"bits{run[0].offset}"
    yield f"public byte {byte};"
    for one in run:
        mask = f"0x{1 << (one.bit or 0):02X}"
        yield from _summary(one.comment)
        yield f"public bool {one.name}"
        yield "{"
        yield f"    get => ({byte} & {mask}) != 0;"
        yield f"    set => {byte} = (byte)(value ? {byte} | {mask} : {byte} & ~{mask});"
        yield "}"


def _starts(kind: AnyStruct) -> Iterator[str]:
    for run in runs(kind):
        one = run[0]
        if one.bit is not None:
            byte = sum(1 << (bit.bit or 0) for bit in run if bit.default)
            if byte:
                yield f"bits{one.offset} = 0x{byte:02X}"
        elif one.default is not None:
            raw = isinstance(element(one.type), String) and not _is_text(one.type)
            yield f"{one.name} = {_raw(one.type, one.default) if raw else literal(one.type, one.default)}"
        elif (made := _made(one.type)) is not None:
            yield f"{one.name} = {made}"


def _is_text(kind: IecType[Any, Any]) -> bool:
    """Tell whether a type is a string in C#; WSTRING and arrays of texts are arrays of their codes there."""
    return isinstance(kind, String) and kind.alignment == 1


def _raw(kind: IecType[Any, Any], value: Any) -> str:  # noqa: ANN401
    """Return the codes of a WSTRING or of an array of texts."""
    data, unit = bytearray(kind.size), element(kind).alignment
    kind.pack_into(value, data)
    codes = (str(int.from_bytes(data[at : at + unit], "little")) for at in range(0, kind.size, unit))
    return f"new {_INTEGERS[unit]}[] {{ {', '.join(codes)} }}"


def _made(kind: IecType[Any, Any]) -> str | None:
    """Return what makes the start value of a type that C# starts with null; None for others."""
    inner, many = element(kind), prod(counts(kind))
    if isinstance(inner, String):
        return '""' if _is_text(kind) else f"new {_INTEGERS[inner.alignment]}[{kind.size // inner.alignment}]"
    if isinstance(inner, StructType):
        one = f"{inner.name}.Create()"
        return f"Enumerable.Range(0, {many}).Select(_ => {one}).ToArray()" if counts(kind) else one
    return f"new {cs_type(inner)}[{many}]" if counts(kind) else None


def _constants(told: Declarations) -> Iterator[str]:
    if told.constants:
        yield from [f"public static class {told.constant_list}", "{"]
        for one in told.constants:
            yield from (f"    {line}" for line in _summary(one.comment))
            yield f"    public const {cs_type(one.type)} {one.name} = {literal(one.type, one.value)};"
        yield from ["}", ""]


def _list(group: VariableList) -> Iterator[str]:
    yield from [f"public static class {group.name}", "{"]
    for one in group.variables:
        yield from (f"    {line}" for line in _summary(one.comment))
        inner, many = element(one.type), prod(counts(one.type))
        arguments = f'"{group.name}.{one.name}", typeof({cs_type(inner)}), {many}, {one.type.size}'
        yield f"    public static readonly Symbol {one.name} = new Symbol({arguments}, {_SIDES[one.written]});"
    yield from ["}", ""]


def _summary(text: str) -> list[str]:
    plain = one_line(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return [f"/// <summary>{plain}</summary>"] if text else []


def _indented(lines: Iterator[str]) -> Iterator[str]:
    return (f"    {line}" if line else "" for line in lines)
