"""Exported declarations say what the types say: read back, compiled, and run."""

import enum
import random
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from motionlayer.iec import (
    BIT,
    BOOL,
    DINT,
    LINT,
    LREAL,
    REAL,
    STRING,
    UINT,
    ULINT,
    USINT,
    WSTRING,
    Array,
    Boolean,
    Enumeration,
    Field,
    Real,
    Scalar,
    String,
    Struct,
    StructType,
    Union,
)
from motionlayer.iec.export import (
    Constant,
    Declarations,
    Variable,
    VariableList,
    c_header,
    csharp,
    structured_text,
)
from motionlayer.layer import Features, Globals, Sizes, control_side
from tests.connect.clients import compiler

from .readers import read_cs, read_st

STARTS = ("-Wno-missing-field-initializers",)
"""A start value names the members that are not zero; the others are."""

MCS, MONO = shutil.which("mcs") or "", shutil.which("mono") or ""
NO_MONO = "no C# compiler; layouts are judged by the text alone, see test_csharp_lays_out_as_declared"


class Colour(enum.IntEnum):
    RED = 0
    DARK_RED = 7


COLOUR = Enumeration("E_COLOUR", UINT, Colour, prefix="COLOUR_")


class Inner(Struct, iec="ST_INNER"):
    """Not packed."""

    flag = Field("bFlag", BOOL, "a flag", default=True)
    number = Field("nNumber", ULINT, "a number", default=2**63)


class Overlay(Union, iec="U_OVERLAY"):
    """The same bytes twice."""

    whole = Field("nWhole", DINT, "whole")
    part = Field("nPart", USINT, "lowest byte")


class Outer(Struct, iec="ST_OUTER", pack=2):
    """All that the language has."""

    first = Field("b1", BIT, "first bit")
    second = Field("b2", BIT, "second bit", default=True)
    colour = Field("eColour", COLOUR, "which <colour> & shade", default=Colour.DARK_RED)
    unknown = Field("eUnknown", COLOUR, default=5)
    text = Field("sText", STRING(7), "text", default="a'b\"c\\")
    wide = Field("wsText", WSTRING(3), "wide text", default='€"$')
    names = Field("aNames", Array(STRING(3), (1, 2)), "texts", default=["é", "ab"])
    matrix = Field("aMatrix", Array(REAL, (0, 1), (-1, 1)), "two by three", default=[1.5, 2, 3, 4, 5, -6.1])
    weights = Field("aWeights", Array(LREAL, (1, 2)), "weights", default=[0.1, 1e300])
    inner = Field("stInner", Inner, "nested")
    other = Field("stOther", Inner, "nested", default=Inner(flag=False, number=3))
    many = Field("aMany", Array(Inner, (5, 6)), "nested, twice")
    overlay = Field("uOverlay", Overlay, "union")
    last = Field("bLast", BIT, "a byte of its own")
    lowest = Field("nLowest", LINT, "a number without a literal in C", default=-(2**63))


class Foreign(Struct, iec="ST_FOREIGN"):
    """Text that is not plain; in C# its bytes are up to the system."""

    foreign = Field("sForeign", STRING(9), "a comment */ of\n two lines", default="ä€?$\n")


BEGUN = [{"b2": False, "wsText": "ab", "stInner": {"nNumber": 5}}, {"bLast": True, "eColour": 0, "aWeights": [3, 4.5]}]
FOREIGN = Declarations("test", [Foreign.type])
SMALL = Declarations(
    "test",
    [Outer.type],
    constants=[Constant("MAX_THING", UINT, 3, "things"), Constant("PATH", STRING(80), "C:\\x")],
    lists=[
        VariableList(
            "GVL",
            [
                Variable("Out", Array(Outer, (1, 3)), "written", written=True),
                Variable("In", UINT, "read", written=False),
                Variable("Symbol", Array(STRING(7), (1, 2)), "neither"),
                Variable("Begun", Array(Outer, (1, 2)), "begins otherwise", written=True, start=BEGUN),
                Variable("One", Inner.type, "one object", start={"bFlag": False}),
            ],
        )
    ],
    aliases={"ST_OTHER_NAME": Outer.type},
)
LAYER = control_side(Globals(Sizes(6), Features()), "six axes")
TOLD = {"small": SMALL, "foreign": FOREIGN, "layer": LAYER}


@pytest.mark.parametrize("name", TOLD)
def test_structured_text_reads_back(name: str) -> None:
    told = TOLD[name]
    files = structured_text(told)
    structs, enumerations = read_st("".join(files[one] for one in sorted(files, reverse=True)))
    assert set(structs) == {one.name for one in told.structs()}
    assert set(enumerations) - {"E_MOTION_LAYER_ADS"} == {one.name for one in told.enumerations()}  # of the block
    for kind in told.structs():
        read = structs[kind.name]
        assert (read.size, read.alignment) == (kind.size, kind.alignment)
        assert read.places == {one.name: (one.offset, one.bit) for one in kind.fields}
    for enumeration in told.enumerations():
        assert enumerations[enumeration.name] == {name: int(value) for name, value in enumeration.items}


def test_structured_text_of_values_and_variables() -> None:
    (text,) = structured_text(SMALL).values()
    assert "    eColour : E_COLOUR := E_COLOUR.COLOUR_DARK_RED; // which <colour> & shade\n" in text
    assert "    eUnknown : E_COLOUR := 5;\n" in text
    assert "    sText : STRING(7) := 'a$'b\"c\\'; // text\n" in text
    assert '    wsText : WSTRING(3) := "$20AC$"$$"; // wide text\n' in text
    assert "    aWeights : ARRAY [1..2] OF LREAL := [0.1, 1.0e+300]; // weights\n" in text
    assert "    stOther : ST_INNER := (bFlag := FALSE, nNumber := 3); // nested\n" in text
    assert "    MAX_THING : UINT := 3; // things\n" in text
    assert "    Out AT %Q* : ARRAY [1..3] OF ST_OUTER; // written\n" in text
    assert "    In AT %I* : UINT; // read\n" in text
    assert "    Symbol : ARRAY [1..2] OF STRING(7); // neither\n" in text
    first = '(b2 := FALSE, wsText := "ab", stInner := (nNumber := 5))'
    second = "(eColour := E_COLOUR.COLOUR_RED, aWeights := [3.0, 4.5], bLast := TRUE)"
    assert f"    Begun AT %Q* : ARRAY [1..2] OF ST_OUTER := [{first}, {second}]; // begins otherwise\n" in text
    assert "    One : ST_INNER := (bFlag := FALSE); // one object\n" in text
    assert "TYPE ST_OTHER_NAME : ST_OUTER;\nEND_TYPE\n" in text


def test_structured_text_of_texts_and_comments_that_are_not_plain() -> None:
    (text,) = structured_text(FOREIGN).values()
    assert "    sForeign : STRING(9) := '$E4$80?$$$0A'; // a comment * / of two lines\n" in text


def test_library_types_are_kept_apart() -> None:
    files = structured_text(LAYER)
    main, library = files["motion_layer.st"], files["motion_layer_libraries.st"]
    assert "TYPE MC_Direction :" in library
    assert "TYPE ST_HomingOptions :" in library
    assert "TYPE MC_Direction :" not in main
    assert "TYPE ST_HOMING :" in main
    assert set(structured_text(SMALL)) == {"motion_layer.st"}


@pytest.mark.parametrize("name", TOLD)
def test_csharp_lays_out_as_declared(name: str) -> None:
    """Readers of .NET pad by rules of their own; sizes and offsets must come to the same."""
    told = TOLD[name]
    (text,) = csharp(told).values()
    structs = read_cs(text)
    for kind in told.structs():
        read, declared = structs[kind.name]
        assert read.size == declared == kind.size
        shown = {f"bits{one.offset}" if one.bit is not None else one.name: one.offset for one in kind.fields}
        assert {key: offset for key, (offset, _) in read.places.items()} == shown


def test_csharp_refuses_a_union_that_dotnet_cannot_have() -> None:
    class Texts(Union, iec="U_TEXTS"):
        """Text over a number."""

        text = Field("sText", STRING(3))
        number = Field("nNumber", DINT)

    with pytest.raises(ValueError, match=r"U_TEXTS\.sText: an array or a text cannot be in a union in C#"):
        csharp(Declarations("test", [Texts.type]))


def test_a_start_value_that_no_language_writes_is_refused() -> None:
    class Lost(Struct, iec="ST_LOST"):
        """Not a number."""

        number = Field("rNumber", LREAL, default=float("nan"))

    for write in (structured_text, c_header, csharp):
        with pytest.raises(ValueError, match=r"a start value nan cannot be declared; it must be finite \(LREAL\)"):
            write(Declarations("test", [Lost.type]))


def test_two_types_of_one_name_are_refused() -> None:
    class Twin(Struct, iec="st_inner"):
        """Another one."""

        number = Field("nNumber", DINT)

    with pytest.raises(ValueError, match="two different types are named st_inner"):
        Declarations("test", [Inner.type, Twin.type])


def assignments(kind: StructType[Any], value: Any, path: str, rng: random.Random) -> Iterator[str]:
    """Write random values to every scalar of an object, and yield the statements that do the same in C."""
    for one in kind.fields:
        if isinstance(one.type, Scalar):
            made = random_value(one.type, rng)
            setattr(value, one.attribute, made)
            yield assign(one.type, f"{path}.{one.name}", getattr(value, one.attribute))
        elif isinstance(one.type, StructType):
            yield from assignments(one.type, getattr(value, one.attribute), f"{path}.{one.name}", rng)
        else:
            yield from elements(one.type, getattr(value, one.attribute), f"{path}.{one.name}", rng)


def elements(kind: Any, array: Any, path: str, rng: random.Random) -> Iterator[str]:
    shape = kind.bounds.shape
    for place in range(kind.bounds.count):
        index, rest = "", place
        for count in reversed(shape):
            index, rest = f"[{rest % count}]{index}", rest // count
        at = tuple(low + int(one) for (low, _), one in zip(kind.bounds.pairs, index[1:-1].split("]["), strict=True))
        key: Any = at if len(at) > 1 else at[0]
        if isinstance(kind.of, StructType):
            yield from assignments(kind.of, array[key], path + index, rng)
        else:
            array[key] = random_value(kind.of, rng)
            yield assign(kind.of, path + index, array[key])


def random_value(kind: Any, rng: random.Random) -> Any:
    if isinstance(kind, Boolean):
        return rng.random() < 0.5
    if isinstance(kind, Real):
        return rng.uniform(-1e6, 1e6)
    if isinstance(kind, String):
        return "".join(rng.choices("abcXYZ 019_/", k=rng.randint(0, kind.length)))
    base = kind.base if isinstance(kind, Enumeration) else kind
    return rng.randint(base.low, base.high)


def assign(kind: Any, path: str, value: Any) -> str:
    if isinstance(kind, String):
        codes = ", ".join(str(ord(one)) for one in value)
        width = "uint16_t" if kind.alignment == 2 else "char"
        return f"{{ const {width} text[] = {{ {codes}{',' if codes else ''} 0 }}; memcpy({path}, text, sizeof text); }}"
    if isinstance(kind, Real):
        return f"{path} = ({'float' if kind is REAL else 'double'}){value.hex()};"
    suffix = "" if -(2**31) <= int(value) < 2**31 else "ULL" if value >= 0 else "LL"
    return f"{path} = {int(value)}{suffix};"


def begun() -> list[bytes]:
    """Return the start values of `Begun` and `One` as the types make them."""
    first, second, one = Outer(), Outer(), Inner(flag=False)
    first.second, first.wide, first.inner.number = False, "ab", 5
    second.last, second.colour, second.weights = True, Colour.RED, [3, 4.5]
    return [bytes(first) + bytes(second), bytes(one)]


def test_c_has_the_start_values_of_variables_and_other_names_of_types(tmp_path: Path) -> None:
    for file, text in c_header(SMALL).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    lines = ["  ST_OTHER_NAME other; (void)sizeof(char[sizeof other == sizeof(ST_OUTER) ? 1 : -1]);"]
    lines += [f"  static const GVL_{name} v{name} = GVL_{name}_INIT;" for name in ("Begun", "One")]
    lines += [f"  show(&v{name}, sizeof v{name});" for name in ("Begun", "One")]
    assert compiled("\n".join(lines), tmp_path) == begun()


def compiled(body: str, folder: Path) -> list[bytes]:
    """Return what a program with these statements shows."""
    source, program = folder / "main.c", folder / "main"
    source.write_text(PROGRAM.replace("@", body), encoding="utf-8")
    compile_it("c", "-std=c11", "-o", str(program), str(source))
    shown = subprocess.run([str(program)], check=True, timeout=120, capture_output=True, text=True).stdout.split()
    return [bytes.fromhex(one) for one in shown]


@pytest.mark.parametrize("name", TOLD)
def test_c_compiles_and_has_the_same_bytes(name: str, tmp_path: Path) -> None:
    """Offsets are checked by the compiler; start values and every member by bytes that the program prints."""
    told, rng = TOLD[name], random.Random(7)
    for file, text in c_header(told).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    lines, expected = [], []
    for kind in told.structs():
        if kind.union:
            continue
        value = kind.initial()
        expected.append(bytes(value))
        written = list(assignments(kind, value, "v", rng))
        expected.append(bytes(value))
        lines += [f"{{ {kind.name} v; memset(&v, 0, sizeof v); {{ {kind.name} s = {kind.name}_INIT; (void)s; }}"]
        lines += [f"  {{ static const {kind.name} s = {kind.name}_INIT; show(&s, sizeof s); }}"]
        lines += [*(f"  {line}" for line in written), "  show(&v, sizeof v); }"]
    assert compiled("\n".join(lines), tmp_path) == expected


def compile_it(language: str, *arguments: str) -> None:
    """Compile with all warnings as errors, at first perhaps by a compiler that has to build its libraries."""
    *zig, driver = compiler()
    by = [*zig, "cc" if (language, driver) == ("c", "c++") else driver]
    run = [*by, "-x", language, "-Wall", "-Wextra", "-Werror", *STARTS, *arguments]
    subprocess.run(run, check=True, timeout=300)


PROGRAM = """\
#include <stdio.h>
#include <string.h>
#include "motion_layer.h"

static void show(const void *memory, size_t size)
{
    const unsigned char *bytes = memory;
    for (size_t at = 0; at < size; at++) printf("%02x", bytes[at]);
    printf("\\n");
}

int main(void)
{
@
    return 0;
}
"""


def test_the_header_is_c_plus_plus_too(tmp_path: Path) -> None:
    for file, text in c_header(SMALL).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    source = tmp_path / "main.cpp"
    program = "static const ST_OUTER start = ST_OUTER_INIT;\nint main() { return start.eColour + GVL_Out_SYMBOL[0]; }\n"
    source.write_text('#include "motion_layer.h"\n' + program, encoding="utf-8")
    compile_it("c++", "-std=c++20", "-c", "-o", str(tmp_path / "main.o"), str(source))


STATES = {0: (0, 0), 10012: (12, 10000), 9000: (0, 9000), 112: (12, 100), 1009: (9, 1000)}


def test_c_splits_a_state(tmp_path: Path) -> None:
    for file, text in c_header(LAYER).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    calls = "".join(
        f'    printf("%u %u\\n", motion_layer_command({one}), motion_layer_progress({one}));\n' for one in STATES
    )
    source, program = tmp_path / "main.c", tmp_path / "main"
    head = '#include <stdio.h>\n#include "motion_layer.h"\n'
    source.write_text(f"{head}int main(void)\n{{\n{calls}    return 0;\n}}\n", encoding="utf-8")
    compile_it("c", "-std=c11", "-o", str(program), str(source))
    shown = subprocess.run([str(program)], check=True, timeout=120, capture_output=True, text=True).stdout.splitlines()
    assert [tuple(map(int, line.split())) for line in shown] == list(STATES.values())


@pytest.mark.skipif(not (MCS and MONO), reason=NO_MONO)
def test_csharp_splits_a_state(tmp_path: Path) -> None:
    for file, text in csharp(LAYER).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    calls = "".join(
        f'System.Console.WriteLine("{{0}} {{1}}", State.Command({one}), State.Progress({one}));\n' for one in STATES
    )
    program = f"using MotionLayer;\nstatic class Program {{ static void Main() {{\n{calls}}} }}\n"
    (tmp_path / "Show.cs").write_text(program, encoding="utf-8")
    run = [MCS, "-langversion:7", "-out:show.exe", "MotionLayer.cs", "Show.cs"]
    subprocess.run(run, check=True, timeout=120, cwd=tmp_path)
    lines = subprocess.run([MONO, "show.exe"], check=True, timeout=120, cwd=tmp_path, capture_output=True, text=True)
    assert [tuple(map(int, line.split())) for line in lines.stdout.splitlines()] == list(STATES.values())


@pytest.mark.skipif(not (MCS and MONO), reason=NO_MONO)
@pytest.mark.parametrize("name", ["small", "layer"])
def test_csharp_marshals_to_the_same_bytes(name: str, tmp_path: Path) -> None:
    told = TOLD[name]
    for file, text in csharp(told).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    shown = [kind for kind in told.structs() if not kind.union]
    calls = "".join(f"        Show({kind.name}.Create());\n" for kind in shown)
    expected = [bytes(kind.initial()) for kind in shown]
    if told is SMALL:
        calls += "        foreach (var one in GVL.CreateBegun()) Show(one);\n        Show(GVL.CreateOne());\n"
        both, one = begun()
        expected += [both[: Outer.type.size], both[Outer.type.size :], one]
    (tmp_path / "Show.cs").write_text(SHOW.replace("@", calls), encoding="utf-8")
    run = [MCS, "-langversion:7", "-out:show.exe", "MotionLayer.cs", "Show.cs"]
    subprocess.run(run, check=True, timeout=120, cwd=tmp_path)
    lines = subprocess.run([MONO, "show.exe"], check=True, timeout=120, cwd=tmp_path, capture_output=True, text=True)
    assert [bytes.fromhex(one) for one in lines.stdout.split()] == expected


SHOW = """\
using System;
using System.Runtime.InteropServices;
using MotionLayer;

static class Program
{
    static void Show(object value)
    {
        var bytes = new byte[Marshal.SizeOf(value)];
        var memory = Marshal.AllocHGlobal(bytes.Length);
        Marshal.Copy(bytes, 0, memory, bytes.Length);
        Marshal.StructureToPtr(value, memory, false);
        Marshal.Copy(memory, bytes, 0, bytes.Length);
        Console.WriteLine(BitConverter.ToString(bytes).Replace("-", ""));
    }

    static void Main()
    {
@
    }
}
"""
