"""Readers of exported declarations, with layout rules of their own: nothing here uses the code that wrote them."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

SIZES = {
    **dict.fromkeys(("BOOL", "BYTE", "SINT", "USINT"), 1),
    **dict.fromkeys(("WORD", "INT", "UINT"), 2),
    **dict.fromkeys(("DWORD", "DINT", "UDINT", "REAL", "TIME", "DATE", "TOD", "DT"), 4),
    **dict.fromkeys(("LWORD", "LINT", "ULINT", "LREAL", "LTIME"), 8),
}
CS_SIZES = {
    **dict.fromkeys(("byte", "sbyte", "bool"), 1),
    **dict.fromkeys(("short", "ushort"), 2),
    **dict.fromkeys(("int", "uint", "float"), 4),
    **dict.fromkeys(("long", "ulong", "double"), 8),
}


@dataclass
class Read:
    """A type that was read: size and alignment in bytes, and of a structure the place of each member."""

    size: int
    alignment: int
    places: dict[str, tuple[int, int | None]] = field(default_factory=dict)


def place(members: Sequence[tuple[str, Read | None]], pack: int, *, union: bool = False) -> Read:
    """Lay out members; a BIT has None for its type."""
    made, end, bits = Read(0, 1), 0, 0
    for name, of in members:
        if of is None:
            if bits % 8 == 0:
                end += 1
            made.places[name] = end - 1, bits % 8
            bits += 1
        else:
            bits = 0
            step = min(of.alignment, pack)
            start = 0 if union else end + (-end) % step
            made.places[name] = start, None
            made.alignment = max(made.alignment, step)
            end = start + of.size
        made.size = max(made.size, end)
    made.size += (-made.size) % made.alignment
    return made


def read_st(text: str) -> tuple[dict[str, Read], dict[str, dict[str, int]]]:
    """Return structures, and enumerations with their members."""
    text = re.sub(r"//[^\n]*", "", text)
    known: dict[str, Read] = {name: Read(size, size) for name, size in SIZES.items()}
    enumerations: dict[str, dict[str, int]] = {}
    for name, members, base in re.findall(r"TYPE (\w+) :\s*\(([^)]*)\) (\w+);\s*END_TYPE", text):
        enumerations[name] = {one: int(value) for one, value in re.findall(r"(\w+) := (-?\d+)", members)}
        known[name] = known[base]
    structs = {}
    shape = r"\{attribute 'pack_mode' := '(\d)'\}\s*TYPE (\w+) :\s*(STRUCT|UNION)(.*?)END_\3\s*END_TYPE"
    for pack, name, word, body in re.findall(shape, text, re.DOTALL):
        members = [
            (one, None if of == "BIT" else st_type(of.strip(), known))
            for one, of in re.findall(r"(\w+) : ([^;:]*?)(?: := [^;]*)?;", body)
        ]
        known[name] = structs[name] = place(members, int(pack), union=word == "UNION")
    return structs, enumerations


def st_type(of: str, known: dict[str, Read]) -> Read:
    """Return a type by its text."""
    array = re.fullmatch(r"ARRAY \[(.*)\] OF (.*)", of)
    if array:
        inner, size = st_type(array[2], known), 1
        for low, high in re.findall(r"(-?\d+)\.\.(-?\d+)", array[1]):
            size *= int(high) - int(low) + 1
        return Read(size * inner.size, inner.alignment)
    string = re.fullmatch(r"(W?)STRING\((\d+)\)", of)
    if string:
        width = 2 if string[1] else 1
        return Read(width * (int(string[2]) + 1), width)
    return known[of]


def read_cs(text: str) -> dict[str, tuple[Read, int]]:
    """Return structures as .NET marshals them, and the size that each declares."""
    known = {name: Read(size, size) for name, size in CS_SIZES.items()}
    for name, base in re.findall(r"public enum (\w+) : (\w+)", text):
        known[name] = known[base]
    found = {}
    head = r"\[StructLayout\(LayoutKind\.(\w+)(?:, Pack = (\d))?, Size = (\d+)[^]]*\)\]\s*"
    shape = head + r"public struct (\w+)\s*\{(.*?)\n    \}"
    for kind, pack, size, name, body in re.findall(shape, text, re.DOTALL):
        members = [
            (one, cs_type(marshal, of, known))
            for marshal, of, one in re.findall(r"(?:\[MarshalAs\(([^\n]*)\)\]\s*)?public ([\w\[\]]+) (\w+);", body)
        ]
        known[name] = place(members, int(pack or 8), union=kind == "Explicit")
        found[name] = known[name], int(size)
    return found


def cs_type(marshal: str, of: str, known: dict[str, Read]) -> Read:
    """Return a type by its text, and how it is marshalled."""
    count = re.search(r"SizeConst = (\d+)", marshal)
    if "ByValTStr" in marshal:
        assert count
        return Read(int(count[1]), 1)
    inner = known[of.removesuffix("[]")]
    return Read(inner.size * int(count[1]), inner.alignment) if count else inner
