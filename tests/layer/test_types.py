"""Structures of the interface against the tables of motion-layer 3: offsets, formats, start values, examples."""

import dataclasses
import struct
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer import nc
from motionlayer.iec import Array, Boolean, Enumeration, Integer, Real, Scalar, String, Struct
from motionlayer.layer import types
from motionlayer.layer.types import AxisCommand, Progress
from tests.effort import examples

from .layouts import TABLES

STRUCTS: dict[str, Any] = {
    cls.type.name: cls for cls in vars(types).values() if isinstance(cls, type) and issubclass(cls, Struct)
}
ROWS = [
    (name, row.strip()) for name, told in TABLES.items() for row in told.rows.strip().splitlines()
]  # one per member of every table
BOUNDS = {
    "MAX_R_PARA": "10",
    "MAX_MOTION_FUNCTION_POINTS": "10",
    "MAX_TRIGGER_COUNT": "4",
    "e_MessageType": "E_MessageType",
}


@dataclasses.dataclass(frozen=True)
class Leaf:
    """A value that is one item of a format: where it is in Python, its place and its type."""

    path: tuple[str | int, ...]
    offset: int
    bit: int | None
    type: Any

    def put(self, root: Any, value: object) -> None:
        for step in self.path[:-1]:
            root = root[step] if isinstance(step, int) else getattr(root, step)
        last = self.path[-1]
        if isinstance(last, int):
            root[last] = value
        else:
            setattr(root, last, value)


def leaves(kind: Any, path: tuple[str | int, ...] = (), offset: int = 0) -> Iterator[Leaf]:
    """Yield the leaves of a structure in the order of memory."""
    for one in kind.fields:
        yield from leaf_of(one.type, (*path, one.attribute), offset + one.offset, one.bit)


def leaf_of(kind: Any, path: tuple[str | int, ...], offset: int, bit: int | None) -> Iterator[Leaf]:
    if isinstance(kind, Array):
        ((low, high),) = kind.bounds.pairs
        for at in range(low, high + 1):
            yield from leaf_of(kind.of, (*path, at), offset + (at - low) * kind.of.size, None)
    elif hasattr(kind, "fields"):
        yield from leaves(kind, path, offset)
    else:
        yield Leaf(path, offset, bit, kind)


def values(kind: Any) -> st.SearchStrategy[Any]:
    """Return values of a scalar type."""
    if isinstance(kind, Boolean):
        return st.booleans()
    if isinstance(kind, Enumeration):
        kind = kind.base
    if isinstance(kind, Integer):
        return st.integers(kind.low, kind.high)
    if isinstance(kind, Real):
        return st.floats(width=32 if kind.size == 4 else 64, allow_nan=False)
    assert isinstance(kind, String)
    return st.text(st.characters(codec="cp1252", exclude_characters="\0"), max_size=kind.length)


def test_every_structure_of_the_tables_exists_and_no_other() -> None:
    images = {"AXIS_REF", "NCTOPLC_AXIS_REF", "PLCTONC_AXIS_REF"}
    assert set(STRUCTS) == set(TABLES) | images


@pytest.mark.parametrize("name", TABLES)
def test_size_and_pack_mode(name: str) -> None:
    kind, told = STRUCTS[name].type, TABLES[name]
    assert (kind.size, kind.pack) == (told.size, told.pack)
    assert kind.size == struct.calcsize(told.format)
    assert len(kind.fields) == len(told.rows.strip().splitlines())


@pytest.mark.parametrize(("name", "row"), ROWS, ids=[f"{name}.{row.split(' | ')[1]}" for name, row in ROWS])
def test_place_type_and_start_value_of_a_member(name: str, row: str) -> None:
    place, declared, of, *default = row.split(" | ")
    member = STRUCTS[name].type.field(declared)
    assert member.name == declared
    assert place == (f"{member.offset}" if member.bit is None else f"{member.offset}.{member.bit}")
    told = of.replace("ARRAY[", "ARRAY [")
    for constant, number in BOUNDS.items():
        told = told.replace(constant, number)
    assert member.type.name.lower() == told.lower()
    start = getattr(STRUCTS[name](), member.attribute)
    if default:
        assert start == told_value(member.type, default[0])
    elif isinstance(member.type, Scalar):
        assert start == member.type.initial()
        assert not start


def told_value(kind: Any, text: str) -> object:
    """Return the start value that a table tells."""
    if isinstance(kind, Enumeration):
        named = [value for declared, value in kind.items if declared.removeprefix("NCI_") == text]
        return named[0]
    if text in ("TRUE", "FALSE"):
        return text == "TRUE"
    if isinstance(kind, Real):
        return pytest.approx(float(text), rel=1e-7)
    return int(text)


@pytest.mark.parametrize("name", TABLES)
@given(data=st.data())
@settings(max_examples=examples(12), deadline=None)
def test_bytes_are_those_of_the_format(name: str, data: st.DataObject) -> None:
    """An object written member by member has the bytes that `struct` packs from the same values."""
    written = STRUCTS[name]()
    items: dict[int, Any] = {}
    for leaf in leaves(written.type):
        value = data.draw(values(leaf.type), label=".".join(map(str, leaf.path)))
        leaf.put(written, value)
        if leaf.bit is not None:
            value = items.get(leaf.offset, 0) | value << leaf.bit
        items[leaf.offset] = value.encode("cp1252") if isinstance(value, str) else value
    packed = struct.pack(TABLES[name].format, *items.values())
    assert bytes(written) == packed
    assert bytes(STRUCTS[name].from_bytes(packed)) == packed
    assert bytes(STRUCTS[name].view(bytearray(packed))) == packed


AXIS_CTRL, AXIS_STATE = types.AxisCtrl, types.AxisState
SENSOR = types.TriggerBits(enable=True, no_feedback=True)
EXAMPLES = [
    (AXIS_CTRL(cmd=AxisCommand.MOVE_POS), "0C 00 00 00"),
    (AXIS_CTRL(cmd=AxisCommand.MOVE_BUFFER_VELO, progress=Progress.DONE), "1F 00 10 27"),
    (AXIS_STATE(state=10012, encoder=types.AxisEncoderType.Simulation_Encoder), "1C 27 01 00 00 00"),
    (AXIS_STATE(state=6003, encoder=types.AxisEncoderType.SERCOS_EtherCAT_SoE_Pos), "73 17 08 00 00 00"),
    (types.MoveData(), "00" * 16 + "00 00 00 00 00 00 59 40" + "00" * 26),
    (types.NciCtrl(), "01 00 A4 70 3C 42" + "00" * 256),
    (SENSOR, "05"),
]


@pytest.mark.parametrize(("written", "told"), EXAMPLES, ids=[one.type.name for one, _ in EXAMPLES])
def test_worked_examples(written: Struct, told: str) -> None:
    """Motion-layer 3.10."""
    assert bytes(written) == bytes.fromhex(told)
    assert type(written).from_bytes(bytes.fromhex(told)) == written


def test_worked_examples_of_single_bytes() -> None:
    """Motion-layer 3.10: bits of Info, and the flags of a homing as declared."""
    info = types.AxisInfo(enabled=True, ready=True, in_target=True, standstill=True)
    assert bytes(info)[0] == 0xC5
    assert bytes(types.HomeParams())[56] == 0x24
    assert bytes(types.Homing())[2 + 56] == 0x24


@pytest.mark.parametrize(("of", "dtype"), [(types.NcToPlc, nc.NCTOPLC_AXIS_REF), (types.PlcToNc, nc.PLCTONC_AXIS_REF)])
def test_images_of_an_axis_are_those_of_the_nc(of: Any, dtype: np.dtype[Any]) -> None:
    assert of.type.size == dtype.itemsize
    assert dtype.fields is not None
    told = {name: (entry[0], entry[1]) for name, entry in dtype.fields.items()}
    shown = {name: (entry[0], entry[1]) for name, entry in of.dtype.fields.items() if not name.startswith("_")}
    assert {name: at for name, (_, at) in shown.items()} == {name: at for name, (_, at) in told.items()}
    assert all(kind.str == told[name][0].str and kind.shape == told[name][0].shape for name, (kind, _) in shown.items())


def test_an_axis_reference_has_the_size_of_the_library() -> None:
    assert types.AxisRef.type.size == 1136
    images = [(one.name, one.offset) for one in types.AxisRef.type.fields if not one.name.startswith("_")]
    assert images == [("PlcToNc", 8), ("NcToPlc", 8 + 128)]


@pytest.mark.parametrize(
    ("base", "attribute", "high", "size"),
    [
        (types.RParameters, "values", 0, 16),
        (types.RParameters, "values", 20, 8 + 21 * 8),
        (types.TriggerCtrl, "positions", 1, 24),
        (types.TriggerState, "positions", 7, 64),
        (types.MotionFunction, "points", 100, 4804),
    ],
)
def test_sizes_of_the_machine_file(base: Any, attribute: str, high: int, size: int) -> None:
    made = types.resized(base, attribute, high)
    assert made.type.size == size
    assert made is types.resized(base, attribute, high)
    assert [one.name for one in made.type.fields] == [one.name for one in base.type.fields]
    assert [one.default for one in made.type.fields] == [one.default for one in base.type.fields]


def test_the_delivered_size_is_the_class_itself() -> None:
    assert types.resized(types.RParameters, "values", types.MAX_R_PARA) is types.RParameters
