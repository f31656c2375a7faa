"""STRING and WSTRING."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.iec import STRING, WSTRING


def test_sizes() -> None:
    assert [(STRING(n).size, STRING(n).alignment) for n in (1, 24, 80, 255)] == [(2, 1), (25, 1), (81, 1), (256, 1)]
    assert [(WSTRING(n).size, WSTRING(n).alignment) for n in (1, 80)] == [(4, 2), (162, 2)]
    assert (STRING().name, WSTRING(9).name) == ("STRING(80)", "WSTRING(9)")
    assert STRING(7) is STRING(7)
    assert STRING(7).dtype.itemsize == 8
    assert WSTRING(7).dtype.itemsize == 16


@given(st.binary(min_size=9, max_size=9))
def test_every_sequence_of_bytes_is_a_text(raw: bytes) -> None:
    kind = STRING(8)
    text = kind.unpack_from(raw)
    assert kind.check(text) == text
    memory = bytearray(9)
    kind.pack_into(text, memory)
    used = raw[:8].partition(b"\0")[0]
    assert memory == used.ljust(9, b"\0")


@given(st.binary(min_size=18, max_size=18))
def test_every_sequence_of_units_is_a_wide_text(raw: bytes) -> None:
    kind = WSTRING(8)
    text = kind.unpack_from(raw)
    assert kind.check(text) == text
    memory = bytearray(18)
    kind.pack_into(text, memory)
    units = [raw[at : at + 2] for at in range(0, 16, 2)]
    used = units[: units.index(b"\0\0")] if b"\0\0" in units else units
    assert memory == b"".join(used).ljust(18, b"\0")


def test_characters_of_windows() -> None:
    memory = bytearray(4)
    STRING(3).pack_into("€äß", memory)
    assert memory == b"\x80\xe4\xdf\0"
    assert STRING(3).unpack_from(memory) == "€äß"


def test_texts_that_do_not_fit() -> None:
    with pytest.raises(ValueError, match=r"sName: 4 characters, at most 3 fit \(STRING\(3\)\)"):
        STRING(3).check("abcd", "sName")
    with pytest.raises(ValueError, match=r"sName: 'Ж' is no character of Windows-1252"):
        STRING(3).check("aЖ", "sName")
    with pytest.raises(ValueError, match="must not contain the character 0"):
        STRING(3).check("a\0", "sName")
    with pytest.raises(ValueError, match="4 characters, at most 3 fit"):
        WSTRING(3).check("😀😀")
    with pytest.raises(TypeError, match=r"b'a' must be text"):
        STRING(3).check(b"a")


@pytest.mark.parametrize("length", [0, -1, 65536, 1.0, "8"])
def test_lengths_out_of_range(length: object) -> None:
    for kind in (STRING, WSTRING):
        with pytest.raises(ValueError, match=r"must be a whole number from 1 to 65535 \(characters\)"):
            kind(length)
