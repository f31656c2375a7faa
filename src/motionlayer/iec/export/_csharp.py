"""Declarations in C#, for `System.Runtime.InteropServices.Marshal` and for ADS clients that marshal by it; C# 7.3.

Structures are sequential with their pack mode. A byte of BITs is a byte with one property per bit. A structure in C#
has no start values and no arrays of its own: `Create()` makes one with both, as declared; `CreateName()` makes those of
the variable `Name` where they are others than those of its type. Text is marshalled in the ANSI code page of the
system, which is that of the interface on Windows alone; ASCII is the same everywhere.
"""

from collections.abc import Iterator, Sequence
from math import prod
from typing import Final

from motionlayer.iec import Boolean, Member, String
from motionlayer.iec.export._csharp_values import INTEGERS, begun, cs_type, is_text, literal, starts
from motionlayer.iec.export._declarations import (
    AnyEnumeration,
    AnyStruct,
    Declarations,
    VariableList,
    counts,
    element,
    one_line,
    runs,
)

NAME: Final = "MotionLayer.cs"

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
    yield from ["    {", *(f"        {line}," for line in starts(kind, {})), "    };", "}", ""]


def _member(one: Member, kind: AnyStruct) -> Iterator[str]:
    yield from _summary(one.comment)
    inner, many = element(one.type), prod(counts(one.type))
    if kind.union:
        if counts(one.type) or isinstance(inner, String):
            raise ValueError(f"{kind.name}.{one.name}: an array or a text cannot be in a union in C#; nest a structure")
        yield "[FieldOffset(0)]"
    if isinstance(inner, String) and not is_text(one.type):
        yield f"[MarshalAs(UnmanagedType.ByValArray, SizeConst = {one.type.size // inner.alignment})]"
        yield f"public {INTEGERS[inner.alignment]}[] {one.name};"
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
        if one.start is not None:
            made = f"{cs_type(inner)}{'[]' if counts(one.type) else ''} Create{one.name}()"
            yield f"    public static {made} => {begun(one.type, one.start)};"
    yield from ["}", ""]


def _summary(text: str) -> list[str]:
    plain = one_line(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return [f"/// <summary>{plain}</summary>"] if text else []


def _indented(lines: Iterator[str]) -> Iterator[str]:
    return (f"    {line}" if line else "" for line in lines)
