"""Memory of a small controller for tests: types by the text of their declarations, and values at addresses."""

import re
import struct
from dataclasses import dataclass, field
from typing import Any

CODES = {
    **dict.fromkeys(("BYTE", "USINT"), "B"),
    **dict.fromkeys(("UINT", "WORD", "T_AmsPort"), "H"),
    **dict.fromkeys(("UDINT", "TIME"), "I"),
    "BOOL": "?",
    "INT": "h",
    "DINT": "i",
    "PVOID": "Q",
}


@dataclass
class Kind:
    """A type: bytes and alignment; `code` of a number, `of` and `low` of an array, `fields` of a structure."""

    size: int
    alignment: int
    code: str = ""
    of: "Kind | None" = None
    low: int = 0
    fields: dict[str, tuple[int, "Kind"]] = field(default_factory=dict)


@dataclass(frozen=True)
class Place:
    """A variable: its type and its address."""

    kind: Kind
    at: int


class Memory:
    """Bytes with addresses; a place is given out once, and ends where the next one begins.

    Args:
        size: of all of it.
    """

    def __init__(self, size: int) -> None:
        self.data = bytearray(size)
        self.end = 8  # nothing is at 0

    def room(self, kind: Kind) -> Place:
        """Return a new place, filled with zeros."""
        at = self.end + (-self.end) % kind.alignment
        self.end = at + kind.size
        assert self.end <= len(self.data), "the controller has no more memory"
        return Place(kind, at)

    def read(self, place: Place) -> Any:
        """Return a number or a text, or the bytes of anything else."""
        kind, raw = place.kind, bytes(self.data[place.at : place.at + place.kind.size])
        if kind.code == "s":
            return raw.partition(b"\0")[0].decode("cp1252")
        return struct.unpack("<" + kind.code, raw)[0] if kind.code else raw

    def write(self, place: Place, value: Any) -> None:
        """Take a value over; what the type has no room for is a mistake of the program."""
        kind = place.kind
        if kind.code == "s":
            raw = value.encode("cp1252") + b"\0"
            assert len(raw) <= kind.size, f"{value!r} is too long for {kind.size - 1} characters"
            raw = raw.ljust(kind.size, b"\0")
        else:
            raw = struct.pack("<" + kind.code, value) if kind.code else value
        assert len(raw) == kind.size
        self.data[place.at : place.at + kind.size] = raw

    def copy(self, to: int, source: int, count: int) -> None:
        """MEMCPY."""
        self.data[to : to + count] = self.data[source : source + count]

    def compare(self, first: int, second: int, count: int) -> int:
        """MEMCMP."""
        left, right = self.data[first : first + count], self.data[second : second + count]
        return (left > right) - (left < right)


class Types:
    """Types by name."""

    def __init__(self) -> None:
        self.known = {name: Kind(struct.calcsize(code), struct.calcsize(code), code) for name, code in CODES.items()}
        self.known["T_AmsNetId"] = Kind(24, 1, "s")
        self.numbers: dict[str, int] = {}
        """Members of enumerations, `E_X.MEMBER`."""

    def declare(self, text: str) -> None:
        """Take up a declared enumeration or structure."""
        text = re.sub(r"//[^\n]*|\{[^}]*\}", "", text)
        enumeration = re.fullmatch(r"\s*TYPE (\w+) :\s*\(([^)]*)\) (\w+);\s*END_TYPE\s*", text)
        if enumeration:
            name, members, base = enumeration.groups()
            self.known[name] = self.known[base]
            for one, value in re.findall(r"(\w+) := (-?\d+)", members):
                self.numbers[f"{name}.{one}"] = int(value)
            return
        structure = re.fullmatch(r"\s*TYPE (\w+) :\s*STRUCT(.*)END_STRUCT\s*END_TYPE\s*", text, re.DOTALL)
        assert structure
        made = Kind(0, 1)
        for one, of in re.findall(r"(\w+) : ([^;]*);", structure[2]):
            kind = self.of(of, {})
            start = made.size + (-made.size) % kind.alignment
            made.fields[one] = start, kind
            made.size, made.alignment = start + kind.size, max(made.alignment, kind.alignment)
        made.size += (-made.size) % made.alignment
        self.known[structure[1]] = made

    def of(self, text: str, constants: dict[str, int]) -> Kind:
        """Return a type by its text."""
        array = re.fullmatch(r"ARRAY \[(\w+)\.\.(\w+)\] OF (.*)", text)
        if array:
            low, high = (constants[one] if one in constants else int(one) for one in array.groups()[:2])
            inner = self.of(array[3], constants)
            return Kind(inner.size * (high - low + 1), inner.alignment, of=inner, low=low)
        string = re.fullmatch(r"STRING\((\d+)\)", text)
        return Kind(int(string[1]) + 1, 1, "s") if string else self.known[text]
