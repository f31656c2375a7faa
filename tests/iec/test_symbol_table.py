"""Symbols: names down to bits."""

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.iec import (
    LREAL,
    UINT,
    Array,
    Enumeration,
    Field,
    InputArray,
    OutputArray,
    Struct,
    StructType,
    SymbolTable,
)
from tests.effort import examples
from tests.iec.declared import E_AXIS_CTRL, RANDOM, AxisCommand, AxisCtrl, Everything, MoveData, Pair

NO_NAMES = ("", " ", ".A", "A..B", "A.", "A B", "[1]", "A[", "A[x]", "A[1]B", "Ä")


class Setup:
    """A table with one of each."""

    def __init__(self) -> None:
        self.ctrl = InputArray(AxisCtrl, 1, 6, "GVL_AXIS.Ctrl")
        self.all = InputArray(Everything, 0, 1, "GVL_AXIS.All")
        self.data = OutputArray(MoveData, None, None, "GVL_AXIS.Data")
        self.symbols = SymbolTable()
        self.symbols.add("GVL_AXIS.Ctrl", self.ctrl, comment="commands", aliases=("MAIN.stCtrl",))
        self.symbols.add("GVL_AXIS.All", self.all, attributes={"pack_mode": "2"})
        self.symbols.add("GVL_AXIS.Data", self.data)


def test_symbols_and_types_can_be_listed() -> None:
    symbols = Setup().symbols
    assert [symbol.name for symbol in symbols] == ["GVL_AXIS.Ctrl", "GVL_AXIS.All", "GVL_AXIS.Data"]
    assert [kind.name for kind in symbols.types] == ["E_AXIS_CTRL", "ST_AXIS_CTRL", "ST_EVERYTHING", "ST_MOVE_DATA"]
    assert len(symbols) == 3
    assert "main.STCTRL" in symbols
    assert "GVL_AXIS.Ctrl[1]" not in symbols
    first, second, _ = symbols
    assert (first.comment, first.aliases, first.type.name) == (
        "commands",
        ("MAIN.stCtrl",),
        "ARRAY [1..6] OF ST_AXIS_CTRL",
    )
    assert second.attributes == {"pack_mode": "2"}
    assert (first.source.writable, list(symbols)[2].source.writable) == (True, False)


@pytest.mark.parametrize(
    ("name", "offset", "bit", "kind"),
    [
        ("GVL_AXIS.Ctrl", 0, None, "ARRAY [1..6] OF ST_AXIS_CTRL"),
        ("GVL_AXIS.Ctrl[2]", 4, None, "ST_AXIS_CTRL"),
        ("gvl_axis.ctrl[2].EPROGRESS", 6, None, "UINT"),
        (" Main.stCtrl [ 6 ] . eCmd ", 20, None, "E_AXIS_CTRL"),
        ("GVL_AXIS.All[0].bSecond", 0, 1, "BIT"),
        ("GVL_AXIS.All[0].stTable[2, 1].eCmd", 50, None, "E_AXIS_CTRL"),
        ("GVL_AXIS.All[0].eCommands[-1]", 54, None, "E_AXIS_CTRL"),
        ("GVL_AXIS.Data.rOverride", 16, None, "LREAL"),
    ],
)
def test_parts_are_found(name: str, offset: int, bit: int | None, kind: str) -> None:
    place = Setup().symbols.find(name)
    assert (place.offset, place.bit, place.type.name, place.size) == (offset, bit, kind, place.type.size)


def test_the_longest_name_of_a_variable_counts() -> None:
    symbols = SymbolTable()
    whole = symbols.add("A", InputArray(Everything, None, None, "A"))
    part = symbols.add("A.stCtrl", InputArray(AxisCtrl, None, None, "A.stCtrl"))
    assert symbols.find("A.stCtrl.eCmd").symbol is part
    assert symbols.find("A.stTable[1, 0].eCmd").symbol is whole


def leaves(kind: Any, path: str) -> list[tuple[str, Any]]:
    """Return the names of all scalars, and how they are reached in Python."""
    if isinstance(kind, StructType):
        return [
            (name, lambda value, field=field, get=get: get(getattr(value, field.attribute)))
            for field in kind.fields
            for name, get in leaves(field.type, f"{path}.{field.name}")
        ]
    if isinstance(kind, Array):
        return [
            (name, lambda value, index=index, get=get: get(value[index]))
            for index in kind.bounds.indices()
            for name, get in leaves(kind.of, f"{path}[{index}]")
        ]
    return [(path, lambda value: value)]


@settings(max_examples=examples(80), deadline=None)
@given(RANDOM, st.data())
def test_every_part_of_a_structure_is_read_and_written_by_name(pair: Pair, data: st.DataObject) -> None:
    size = pair.iec.type.size
    source = InputArray(pair.iec, None, None, "GVL.X")
    source.value.unpack_from(data.draw(st.binary(min_size=size, max_size=size)))
    other = InputArray(pair.iec, None, None, "GVL.Y")
    symbols = SymbolTable()
    symbols.add("GVL.X", source)
    symbols.add("GVL.Y", other)
    source.write(0, bytes(source.value), "test")
    for name, get in leaves(pair.iec.type, ""):
        value = symbols.read("GVL.X" + name)
        assert repr(value) == repr(get(source.value))
        symbols.write("GVL.Y" + name, value, "test")
    assert bytes(other.value) == bytes(source.value)


def test_values_are_copies_and_writes_are_touches() -> None:
    setup = Setup()
    symbols = setup.symbols
    symbols.write("GVL_AXIS.Ctrl[2].eCmd", 12, "client")
    assert setup.ctrl[2].cmd is AxisCommand.MOVE_POS
    assert setup.ctrl.take() == [2]
    read = symbols.read("GVL_AXIS.Ctrl[2]")
    assert (read, read is setup.ctrl[2]) == (AxisCtrl(cmd=12), False)
    read.cmd = 31
    symbols.write("GVL_AXIS.Ctrl[3]", read, "client")
    assert setup.ctrl[3].cmd == 31
    setup.all[1].first = True
    symbols.write("GVL_AXIS.All[1].bSecond", value=False, by="client")
    assert (setup.all[1].first, setup.all[1].second) == (True, False)
    symbols.write("GVL_AXIS.All[1].rRatios", [4, 3, 2, 1], "client")
    assert list(symbols.read("GVL_AXIS.All[1].rRatios")) == list(setup.all[1].ratios) == [4, 3, 2, 1]
    setup.data.value.position = 3.0
    assert symbols.read("GVL_AXIS.Data.rSetPos") == 3.0


@pytest.mark.parametrize(
    ("name", "error", "text"),
    [
        ("GVL_AXIS.Ctl[1]", KeyError, "no symbol GVL_AXIS.Ctl[1]; did you mean GVL_AXIS.Ctrl?"),
        ("xyz", KeyError, "no symbol xyz"),
        ("GVL_AXIS.Ctrl[7]", IndexError, "GVL_AXIS.Ctrl: index 7 is out of [1..6]"),
        ("GVL_AXIS.Ctrl[0].eCmd", IndexError, "GVL_AXIS.Ctrl: index 0 is out of [1..6]"),
        ("GVL_AXIS.Ctrl[1,2]", IndexError, "GVL_AXIS.Ctrl: index (1, 2): this array takes 1, one for each of [1..6]"),
        ("GVL_AXIS.All[1].stTable[3, 1]", IndexError, "GVL_AXIS.All[1].stTable: index 3 is out of [1..2, 0..1]"),
        ("GVL_AXIS.Ctrl[1].eCmt", KeyError, "GVL_AXIS.Ctrl[1] (ST_AXIS_CTRL) has no member eCmt; did you mean eCmd?"),
        ("GVL_AXIS.Ctrl[1].xyz", KeyError, "has no member xyz; it has eCmd, eProgress"),
        ("GVL_AXIS.Ctrl.eCmd", KeyError, "GVL_AXIS.Ctrl (ARRAY [1..6] OF ST_AXIS_CTRL) has no members, so no eCmd"),
        ("GVL_AXIS.Ctrl[1].eCmd.x", KeyError, "GVL_AXIS.Ctrl[1].eCmd (E_AXIS_CTRL) has no members"),
        ("GVL_AXIS.Ctrl[1][2]", KeyError, "GVL_AXIS.Ctrl[1] (ST_AXIS_CTRL) takes no index"),
        *((name, ValueError, "cannot be read from") for name in NO_NAMES),
    ],
)
def test_names_that_are_none(name: str, error: type[Exception], text: str) -> None:
    with pytest.raises(error) as told:
        Setup().symbols.find(name)
    assert text in str(told.value)


@pytest.mark.parametrize(
    ("name", "value", "error", "text"),
    [
        ("GVL_AXIS.Ctrl[1].eCmd", -1, ValueError, "GVL_AXIS.Ctrl[1].eCmd: -1 must be 0 to 65535 (UINT)"),
        ("GVL_AXIS.Ctrl[1].eCmd", 1.5, TypeError, "GVL_AXIS.Ctrl[1].eCmd: 1.5 must be a whole number"),
        ("GVL_AXIS.Ctrl[1]", 12, TypeError, "GVL_AXIS.Ctrl[1]: 12 must be of class AxisCtrl (ST_AXIS_CTRL)"),
        ("GVL_AXIS.All[1].bFirst", 1, TypeError, "GVL_AXIS.All[1].bFirst: 1 must be True or False (BIT)"),
        (
            "GVL_AXIS.Data.rSetPos",
            1.0,
            PermissionError,
            "GVL_AXIS.Data is written by the layer",
        ),
    ],
)
def test_writes_that_are_refused(name: str, value: object, error: type[Exception], text: str) -> None:
    setup = Setup()
    with pytest.raises(error) as told:
        setup.symbols.write(name, value, "client")
    assert text in str(told.value)
    assert not setup.ctrl.touched
    assert not setup.all.touched


def test_names_and_types_are_unique() -> None:
    symbols = Setup().symbols
    for name, aliases in (("gvl_axis.CTRL", ()), ("A.B", ("main.stctrl",))):
        with pytest.raises(ValueError, match="there is one already"):
            symbols.add(name, OutputArray(UINT, None, None, name), aliases=aliases)
    with pytest.raises(ValueError, match=r"symbol 'A\[1\]': the name of a variable has no index"):
        symbols.add("A[1]", OutputArray(UINT, None, None, "A"))
    again = Enumeration("e_axis_ctrl", UINT, AxisCommand)
    with pytest.raises(ValueError, match="type e_axis_ctrl: there is another one of this name"):
        symbols.add("A", OutputArray(again, None, None, "A"))

    class Again(Struct, iec="ST_MOVE_DATA"):
        """Another."""

        value = Field("rValue", LREAL)

    with pytest.raises(ValueError, match="type ST_MOVE_DATA: there is another one of this name"):
        symbols.add("A", OutputArray(Again, None, None, "A"))
    symbols.add("A", OutputArray(E_AXIS_CTRL, None, None, "A"))
