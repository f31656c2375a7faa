"""Elementary types: sizes, ranges, and what is refused."""

import math
import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.iec import (
    BIT,
    BOOL,
    BYTE,
    DATE,
    DINT,
    DT,
    DWORD,
    INT,
    LINT,
    LREAL,
    LTIME,
    LWORD,
    REAL,
    SINT,
    TIME,
    TOD,
    UDINT,
    UINT,
    ULINT,
    USINT,
    WORD,
    Integer,
)

SIZES: dict[Any, tuple[str, int]] = {
    BOOL: ("BOOL", 1), BIT: ("BIT", 1), BYTE: ("BYTE", 1), WORD: ("WORD", 2), DWORD: ("DWORD", 4), LWORD: ("LWORD", 8),
    SINT: ("SINT", 1), USINT: ("USINT", 1), INT: ("INT", 2), UINT: ("UINT", 2), DINT: ("DINT", 4), UDINT: ("UDINT", 4),
    LINT: ("LINT", 8), ULINT: ("ULINT", 8), REAL: ("REAL", 4), LREAL: ("LREAL", 8), TIME: ("TIME", 4),
    LTIME: ("LTIME", 8), DATE: ("DATE", 4), TOD: ("TOD", 4), DT: ("DT", 4),
}  # fmt: skip
INTEGERS = [kind for kind in SIZES if isinstance(kind, Integer)]


@pytest.mark.parametrize("kind", SIZES, ids=str)
def test_size_and_alignment_are_natural(kind: Any) -> None:
    name, size = SIZES[kind]
    assert (kind.name, repr(kind), kind.size, kind.alignment) == (name, name, size, size)
    assert kind.dtype.itemsize == struct.calcsize("<" + kind.code) == size
    memory = bytearray(size)
    kind.pack_into(kind.initial(), memory)
    assert memory == bytes(size)


@pytest.mark.parametrize("kind", INTEGERS, ids=str)
def test_whole_numbers_within_the_range(kind: Integer) -> None:
    info = np.iinfo(kind.dtype)
    for number in (int(info.min), 0, 1, int(info.max)):
        assert kind.check(number) == number
        assert type(kind.check(kind.dtype.type(number))) is int
        memory = bytearray(kind.size)
        kind.pack_into(number, memory)
        assert memory == np.array(number, kind.dtype).tobytes()
        assert kind.unpack_from(memory) == number
    for number in (int(info.min) - 1, int(info.max) + 1):
        with pytest.raises(ValueError, match=f"x: {number} must be {info.min} to {info.max}.* \\({kind.name}\\)"):
            kind.check(number, "x")


def test_a_range_of_a_time_has_its_unit() -> None:
    with pytest.raises(ValueError, match=r"tWait: -1 must be 0 to 4294967295 ms \(TIME\)"):
        TIME.check(-1, "tWait")


@pytest.mark.parametrize("value", [True, np.True_, 1.0, np.float64(1.0), "1", None, 1j], ids=repr)
def test_no_whole_number(value: object) -> None:
    for kind in INTEGERS:
        with pytest.raises(TypeError, match="must be a whole number"):
            kind.check(value)


@pytest.mark.parametrize("value", [True, "1.0", None, 1j, [1.0]], ids=repr)
def test_no_number(value: object) -> None:
    for kind in (REAL, LREAL):
        with pytest.raises(TypeError, match=r"must be a number \(L?REAL\)"):
            kind.check(value)


@pytest.mark.parametrize("value", [0, 1, 1.0, "TRUE", None], ids=repr)
def test_no_truth(value: object) -> None:
    with pytest.raises(TypeError, match=r"must be True or False \(BOOL\)"):
        BOOL.check(value)


def test_truths_of_numpy_are_taken() -> None:
    assert BOOL.check(np.True_) is True
    assert BOOL.unpack_from(b"\x02") is True


@given(st.floats())
def test_a_long_real_takes_every_float(value: float) -> None:
    assert struct.pack("<d", LREAL.check(value)) == struct.pack("<d", value)


@given(st.floats(width=32) | st.floats(-3.4e38, 3.4e38) | st.integers(-(10**30), 10**30))
def test_a_real_tells_what_is_sent(value: float) -> None:
    kept = REAL.check(value)
    assert kept == np.float32(value) or math.isnan(kept)
    memory = bytearray(4)
    REAL.pack_into(kept, memory)
    assert repr(REAL.unpack_from(memory)) == repr(kept)


def test_numbers_too_large_for_a_real() -> None:
    with pytest.raises(ValueError, match=r"rValue: 1e\+39 must be -3.4e38 to 3.4e38 \(REAL\)"):
        REAL.check(1e39, "rValue")
    with pytest.raises(ValueError, match=r"must be -1.8e308 to 1.8e308 \(LREAL\)"):
        LREAL.check(10**400)
    assert math.isinf(REAL.check(math.inf))
    assert LREAL.check(np.float32(0.5)) == LREAL.check(np.int16(1)) / 2 == 0.5
