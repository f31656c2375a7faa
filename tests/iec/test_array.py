"""Arrays: bounds, elements, bytes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.iec import INT, LREAL, STRING, UINT, Array, ArrayValue, Bounds
from tests.iec.declared import E_AXIS_CTRL, AxisCommand, AxisCtrl

PAIR = st.tuples(st.integers(-4, 4), st.integers(0, 3)).map(lambda one: (one[0], one[0] + one[1]))
BOUNDS = st.lists(PAIR, min_size=1, max_size=3)


@given(BOUNDS)
def test_indices_run_as_in_numpy(pairs: list[tuple[int, int]]) -> None:
    kind = Array(INT, *pairs)
    numbers = np.arange(kind.bounds.count, dtype="<i2").reshape(kind.bounds.shape)
    value = kind.unpack_from(numbers.tobytes())
    lows = [low for low, _ in pairs]
    for at in np.ndindex(*kind.bounds.shape):
        index = tuple(int(one) + low for one, low in zip(at, lows, strict=True))
        assert value[index] == numbers[at]
    assert list(value) == [value[index] for index in kind.bounds.indices()] == list(range(len(value)))
    assert kind.dtype.shape == kind.bounds.shape
    memory = bytearray(kind.size)
    kind.pack_into(value, memory)
    assert memory == bytes(value) == numbers.tobytes()


@given(BOUNDS, st.lists(st.integers(-9, 9), min_size=1, max_size=3))
def test_an_index_is_within_the_bounds_or_refused(pairs: list[tuple[int, int]], index: list[int]) -> None:
    bounds = Bounds(pairs)
    if len(index) != len(pairs):
        with pytest.raises(TypeError, match="one for each of"):
            bounds.place(tuple(index))
    elif all(low <= one <= high for one, (low, high) in zip(index, pairs, strict=True)):
        assert bounds.text(bounds.place(tuple(index))) == ", ".join(map(str, index))
    else:
        with pytest.raises(IndexError, match="is out of"):
            bounds.place(tuple(index))


def test_names() -> None:
    assert Array(UINT, (1, 6)).name == "ARRAY [1..6] OF UINT"
    assert Array(AxisCtrl, (-1, 1), (0, 3)).name == "ARRAY [-1..1, 0..3] OF ST_AXIS_CTRL"
    assert Array(AxisCtrl, (1, 6)).alignment == 2


def test_elements() -> None:
    value = Array(E_AXIS_CTRL, (1, 3)).initial()
    value[2] = 12
    assert value[2] is AxisCommand.MOVE_POS
    assert (list(value), len(value)) == ([0, 12, 0], 3)
    assert value == [0, 12, 0]
    assert value != Array(E_AXIS_CTRL, (0, 2)).check([0, 12, 0])
    assert value == Array(E_AXIS_CTRL, (1, 3)).check([0, 12, 0])
    texts = Array(STRING(3), (1, 2)).check(["ab", "c"])
    assert bytes(texts) == b"ab\0\0c\0\0\0"
    with pytest.raises(TypeError, match="unhashable"):
        hash(value)


def test_an_element_is_copied_in() -> None:
    value = Array(AxisCtrl, (1, 2)).initial()
    kept, given_one = value[1], AxisCtrl(cmd=12)
    value[1] = given_one
    given_one.cmd = 0
    assert value[1] is kept
    assert kept.cmd == 12


def test_bad_elements() -> None:
    value = Array(UINT, (1, 3)).initial()
    with pytest.raises(IndexError, match=r"index 0 is out of \[1..3\]"):
        value[0] = 1
    with pytest.raises(IndexError, match=r"index 4 is out of \[1..3\]"):
        _ = value[4]
    with pytest.raises(TypeError, match=r"index '1' must be a whole number within \[1..3\]"):
        _ = value["1"]  # type: ignore[index]
    with pytest.raises(TypeError, match=r"index True must be a whole number"):
        _ = value[True]
    with pytest.raises(ValueError, match=r"UINT\[3\]: -1 must be 0 to 65535"):
        value[3] = -1
    assert list(value) == [0, 0, 0]


def test_elements_of_numpy_are_taken() -> None:
    value = Array(LREAL, (1, 3)).check(np.array([1.0, 2.0, 3.0]))
    assert isinstance(value, ArrayValue)
    assert [type(one) for one in value] == [float] * 3


def test_memory_that_is_too_short() -> None:
    kind = Array(UINT, (1, 3))
    for size, offset in ((5, 0), (6, 1), (6, -1)):
        with pytest.raises(ValueError, match=r"ARRAY \[1..3\] OF UINT: 6 bytes at offset"):
            kind.unpack_from(bytes(size), offset)
        with pytest.raises(ValueError, match=r"ARRAY \[1..3\] OF UINT: 6 bytes at offset"):
            kind.pack_into(kind.initial(), bytearray(size), offset)


@pytest.mark.parametrize("bounds", [[], [(2, 1)], [(1,)], [(1.0, 2.0)], [(1, 2), (True, 2)]])
def test_wrong_bounds(bounds: list[tuple[int, int]]) -> None:
    with pytest.raises(ValueError, match="lower and upper, as \\(1, 6\\)"):
        Array(UINT, *bounds)
