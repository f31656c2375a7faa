"""What is uploaded: the tree is read back by a reader of its own, and its places are those of a C compiler."""

import ctypes
import enum
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.connect.ads import AdsError, Code, Tree, placed, tree_of
from motionlayer.connect.ads._entries import LONGEST, symbol_entry, type_entry
from motionlayer.connect.ads._nodes import Root, TypeNode
from motionlayer.iec import (
    DINT,
    INT,
    LREAL,
    UDINT,
    UINT,
    WSTRING,
    Array,
    Enumeration,
    Field,
    InputArray,
    Method,
    OutputArray,
    Parameter,
    Struct,
    SymbolTable,
)
from tests.connect.entries import BIT_VALUE, READ_ONLY, Entry, read_symbols, read_types
from tests.effort import examples
from tests.iec.declared import RANDOM, AxisCommand, AxisCtrl, Everything, Overlay, Pair


def uploaded(table: SymbolTable) -> tuple[Tree, dict[str, Entry], dict[str, Entry]]:
    """Return the tree of a table, and what a client reads of it: symbols and types by name."""
    tree = tree_of(placed(table))
    nodes = {node.name: node for node in tree.types}
    symbols = read_symbols(b"".join(symbol_entry(tree.find(root.name)) for root in tree.roots))
    types = read_types(b"".join(type_entry(node, nodes) for node in nodes.values()))
    return tree, {one.name: one for one in symbols}, {one.name: one for one in types}


def leaves(entry: Entry, types: dict[str, Entry], offset: int = 0) -> list[tuple[int, int]]:
    """Return first bit and number of bits of all that has no parts, by the entries alone."""
    if entry.dimensions:
        count = 1
        for _, length in entry.dimensions:
            count *= length
        step = entry.size // count * 8
        return [leaf for at in range(count) for leaf in leaves(types[entry.type], types, offset + at * step)]
    if not entry.members:
        return [(offset, entry.size * 8)]
    found = []
    for member in entry.members:
        if member.flags & 0x20:
            found.append((offset + member.offset, member.size))
        else:
            assert member.size == types[member.type].size
            found += leaves(types[member.type], types, offset + member.offset * 8)
    return found


def compiled(c: Any, offset: int = 0) -> list[tuple[int, int]]:
    """Return the same by the layout that ctypes has."""
    if issubclass(c, ctypes.Structure):
        found: list[tuple[int, int]] = []
        for name, kind, *width in c._fields_:
            place = getattr(c, name)
            if width:
                found.append((offset + place.offset * 8 + (place.size & 0xFFFF), 1))
            else:
                found += compiled(kind, offset + place.offset * 8)
        return found
    text = issubclass(c, ctypes.Array) and c._type_ is ctypes.c_uint8
    if issubclass(c, ctypes.Array) and not text:
        step = ctypes.sizeof(c._type_) * 8
        return [leaf for at in range(c._length_) for leaf in compiled(c._type_, offset + at * step)]
    return [(offset, ctypes.sizeof(c) * 8)]


def bytes_of(found: list[tuple[int, int]]) -> list[int]:
    """Return all bits: elements of arrays of bytes count one by one in one reading, and together in the other."""
    return sorted(bit for start, count in found for bit in range(start, start + count))


@settings(max_examples=examples(200), deadline=None)
@given(RANDOM)
def test_every_part_lies_where_a_compiler_puts_it(pair: Pair) -> None:
    table = SymbolTable()
    table.add("GVL.Value", OutputArray(pair.iec, None, None, "GVL.Value"))
    _, symbols, types = uploaded(table)
    symbol = symbols["GVL.Value"]
    assert symbol.size == ctypes.sizeof(pair.c)
    assert symbol.adst == types[symbol.type].adst == 65
    found = leaves(types[symbol.type], types)
    expected = compiled(pair.c)
    assert bytes_of(found) == bytes_of(expected)
    assert len(set(bytes_of(found))) == len(bytes_of(found))


@settings(max_examples=examples(100), deadline=None)
@given(RANDOM, st.data())
def test_a_path_leads_where_the_entries_say(pair: Pair, data: st.DataObject) -> None:
    table = SymbolTable()
    table.add("GVL.Other", OutputArray(LREAL, None, None, "GVL.Other"))
    table.add("GVL.Value", InputArray(pair.iec, 1, 2, "GVL.Value"))
    tree, symbols, types = uploaded(table)
    path, entry = "GVL.Value", types[symbols["GVL.Value"].type]
    offset, bit = symbols["GVL.Value"].offset * 8, False
    while entry.dimensions or entry.members:
        if entry.dimensions:
            indices = [data.draw(st.integers(low, low + count - 1)) for low, count in entry.dimensions]
            number = 0
            for index, (low, count) in zip(indices, entry.dimensions, strict=True):
                number = number * count + index - low
            path, entry = f"{path}[{','.join(map(str, indices))}]", types[entry.type]
            offset += number * entry.size * 8
        else:
            member = data.draw(st.sampled_from(entry.members))
            path, bit = f"{path}.{member.name}", bool(member.flags & 0x20)
            offset += member.offset if bit else member.offset * 8
            entry = types[member.type]
    place = tree.find(path.lower())
    assert place.name == path
    assert place.offset * 8 + (place.bit or 0) == offset
    assert (place.bit is not None) == bit
    (told,) = read_symbols(symbol_entry(place))
    assert (told.group, told.offset) == ((0x4041, offset) if bit else (0x4040, offset // 8))
    assert bool(told.flags & BIT_VALUE) == bit
    assert not told.flags & READ_ONLY


def declared() -> SymbolTable:
    table = SymbolTable()
    table.add("GVL.All", InputArray(Everything, None, None, "GVL.All"), comment="größe", attributes={"unit": "mm/s²"})
    table.add("GVL.Over", OutputArray(Overlay, None, None, "GVL.Over"))
    table.add("GVL.Grid", OutputArray(Array(DINT, (-1, 1), (0, 2)), None, None, "GVL.Grid"), aliases=["MAIN.Grid"])
    table.add("GVL.Text", OutputArray(WSTRING(5), 1, 2, "GVL.Text"))
    return table


def test_kinds_of_types_appear_as_clients_expect_them() -> None:
    _, symbols, types = uploaded(declared())
    assert symbols["GVL.All"].comment == "größe"
    assert symbols["GVL.All"].attributes == {"unit": "mm/s²"}
    assert symbols["GVL.Over"].flags & READ_ONLY
    everything = {one.name: one for one in types["ST_EVERYTHING"].members}
    assert everything["bFirst"].flags & types["BIT"].flags & 0x20
    assert everything["bSecond"].offset == 1
    assert everything["bFirst"].comment == "bit 0"
    assert [one.offset for one in types["U_OVERLAY"].members] == [0, 0, 0]
    grid = types[symbols["GVL.Grid"].type]
    assert grid.name == "ARRAY [-1..1,0..2] OF DINT"
    assert (grid.type, grid.dimensions, grid.adst, grid.size) == ("DINT", [(-1, 3), (0, 3)], 3, 36)
    assert types["WSTRING(5)"].size == 12
    assert types["WSTRING(5)"].adst == 31
    assert types["STRING(7)"].size == 8
    command = types["E_AXIS_CTRL"]
    assert (command.type, command.adst, command.size) == ("UINT", 18, 2)
    assert command.values["AXIS_MOVE_POS"] == AxisCommand.MOVE_POS
    assert {one.type for one in types["ST_EVERYTHING"].members} <= types.keys()


def test_every_type_that_is_named_is_there_and_no_type_twice() -> None:
    _, symbols, types = uploaded(declared())
    named = {one.type for one in symbols.values()}
    for entry in types.values():
        assert entry.flags & 1
        named |= {member.type for member in entry.members} | ({entry.type} if entry.type else set())
        assert all(member.flags & 2 for member in entry.members)
    assert named == types.keys()


def test_an_enumeration_with_negative_values_keeps_them() -> None:
    class Way(enum.IntEnum):
        BACK = -1
        FORTH = 1

    table = SymbolTable()
    table.add("GVL.Way", OutputArray(Enumeration("E_WAY", INT, Way), None, None, "GVL.Way"))
    _, _, types = uploaded(table)
    assert types["E_WAY"].values == {"BACK": -1, "FORTH": 1}


def test_a_comment_is_cut_before_a_client_cannot_take_the_entry() -> None:
    table = SymbolTable()
    table.add("GVL.Value", OutputArray(LREAL, None, None, "GVL.Value"), comment="x" * 5000)
    tree, symbols, _ = uploaded(table)
    assert len(symbol_entry(tree.find("GVL.Value"))) == LONGEST
    assert symbols["GVL.Value"].comment == "x" * len(symbols["GVL.Value"].comment)


class Thing(Struct, iec="FB_THING", pack=8):
    """Something with methods."""

    value = Field("nValue", UDINT)


ADD = Method(
    "Add",
    lambda _index, *_inputs: (0, 0.0),
    (Parameter("nCount", UINT), Parameter("stCtrl", AxisCtrl.type)),
    (Parameter("rSum", LREAL),),
    DINT,
    "adds",
)


def test_methods_stand_in_the_entry_of_their_type() -> None:
    table = SymbolTable()
    table.add("GVL.Things", OutputArray(Thing, 3, 5, "GVL.Things"), methods=[Method("Go", lambda _index: ()), ADD])
    tree, _, types = uploaded(table)
    go, add = types["FB_THING"].methods
    assert (go.name, go.returns, go.return_size, go.parameters) == ("Go", "", 0, [])
    assert (add.name, add.number, add.returns, add.return_size) == ("Add", 1, "DINT", 4)
    assert [(one.name, one.type, one.size, one.flags) for one in add.parameters] == [
        ("nCount", "UINT", 2, 1),
        ("stCtrl", "ST_AXIS_CTRL", 4, 1),
        ("rSum", "LREAL", 8, 2),
    ]
    assert {"DINT", "UINT", "ST_AXIS_CTRL", "LREAL"} <= types.keys()
    method = tree.find_method("gvl.things[4]#add")
    assert (method.number, method.sent, method.returned) == (1, 6, 12)
    assert method.place.offset == Thing.type.size


def test_methods_of_nothing_are_refused() -> None:
    table = SymbolTable()
    with pytest.raises(ValueError, match="LREAL has no methods"):
        table.add("GVL.Value", OutputArray(LREAL, None, None, "GVL.Value"), methods=[ADD])
    table.add("GVL.One", OutputArray(Thing, None, None, "GVL.One"), methods=[ADD])
    tree = tree_of(placed(table))
    for path in ("GVL.One#Sub", "GVL.Two#Add", "GVL.One.nValue#Add"):
        with pytest.raises(AdsError) as error:
            tree.find_method(path)
        assert error.value.code == Code.SYMBOL_NOT_FOUND
    table.add("GVL.Two", OutputArray(Thing, None, None, "GVL.Two"), methods=[Method("Add", lambda _index: ())])
    with pytest.raises(ValueError, match=r"GVL\.Two: another variable of type FB_THING has other methods"):
        tree_of(placed(table))


@pytest.mark.parametrize(
    ("path", "code"),
    [
        ("GVL.Nothing", Code.SYMBOL_NOT_FOUND),
        ("GVL.All.bThird", Code.SYMBOL_NOT_FOUND),
        ("GVL.Grid[2,0]", Code.INVALID_ARRAY_INDEX),
        ("GVL.Grid[0]", Code.INVALID_ARRAY_INDEX),
        ("GVL.All[0]", Code.INVALID_ARRAY_INDEX),
        ("GVL.Grid[x,0]", Code.SYNTAX),
        ("GVL.Grid[0,0", Code.SYNTAX),
        ("GVL.All..bFirst", Code.SYNTAX),
    ],
)
def test_paths_that_lead_nowhere(path: str, code: Code) -> None:
    with pytest.raises(AdsError) as error:
        tree_of(placed(declared())).find(path)
    assert error.value.code == code


def test_an_alias_is_found_under_the_name_of_the_symbol() -> None:
    tree = tree_of(placed(declared()))
    assert tree.find("main.grid[0,1]").name == "GVL.Grid[0,1]"


def test_hidden_symbols_are_published_and_not_shown() -> None:
    shown, hidden = SymbolTable(), SymbolTable()
    shown.add("GVL.Value", OutputArray(UINT, None, None, "GVL.Value"))
    secret = hidden.add("NC.Axis", OutputArray(LREAL, 1, 2, "NC.Axis"))
    places = placed(shown, [secret])
    assert [one.start for one in places] == [0, 8]
    tree = tree_of(places)
    assert [root.name for root in tree.roots] == ["GVL.Value"]
    with pytest.raises(AdsError):
        tree.find("NC.Axis")


def test_a_type_without_an_entry_is_told() -> None:
    tree = Tree([Root("GVL.Value", "LREAL", 0)], [TypeNode("LREAL", 8, 5)])
    with pytest.raises(AdsError) as error:
        tree.type_named("REAL")
    assert error.value.code == Code.SYMBOL_NOT_FOUND
