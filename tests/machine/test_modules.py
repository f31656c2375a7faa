"""Modules: what they put into a machine, and how what is wrong in them is found."""

import json
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from motionlayer import Machine, Simulation
from motionlayer.machine import Description, MachineError, check_description, load_description
from motionlayer.machine._names import SECTIONS
from motionlayer.verify import assert_valid

Folder = Callable[..., Path]

GOOD = (Path(__file__).parent / "good.toml").read_text(encoding="utf-8")  # sets every field

HEAD = 'format = 1\nname = "cell"\n'
LIMITS = "max_velocity = 100.0\nmax_acceleration = 1000.0\nmax_jerk = 10000.0\n"
AXIS = "[axis.X]\n" + LIMITS
SERVO = '[axis.X.drive]\nkind = "servo"\nposition_gain = 50\n'
TWICE = '[[module]]\nfile = "m.toml"\nprefix = "A_"\n[[module]]\nfile = "m.toml"\nprefix = "B_"\n'
ONCE = TWICE[: TWICE.rindex("[[")]


@pytest.fixture
def folder(tmp_path: Path) -> Folder:
    """Write files by name and text; `cell` is the machine file, whose path is returned."""

    def folder(cell: str, **files: str) -> Path:
        for name, text in {"cell": cell, **files}.items():
            path = tmp_path / (name.replace("__", "/") + ".toml")
            path.parent.mkdir(exist_ok=True)
            path.write_text(text if text.startswith("format") else "format = 1\n" + text, encoding="utf-8")
        return tmp_path / "cell.toml"

    return folder


def loaded(path: Path) -> dict[str, Any]:
    return load_description(path).model_dump(mode="json")


def complaints(path: Path) -> list[str]:
    """Return what is said about a machine, with files by name."""
    with pytest.raises(MachineError) as caught:
        load_description(path)
    return str(caught.value).replace(f"{path.parent}/", "").splitlines()


def test_every_name_of_a_module_gets_the_prefix_wherever_the_module_uses_it(folder: Folder) -> None:
    module = (
        AXIS + SERVO + "[axis.Y]\n" + LIMITS
        + '[group.both]\naxes = ["X", "Y"]\n[[fault]]\naxis = "X"\nkind = "blocked"\ntick = 5\n'
        + '[trace]\nsignals = ["X.*", "*.set_position"]\nresolution = { "?.set_position" = 0.5 }\n'
    )  # fmt: skip
    data = loaded(folder(HEAD + TWICE, m=module))
    assert list(data["axis"]) == ["A_X", "A_Y", "B_X", "B_Y"]
    assert {name: group["axes"] for name, group in data["group"].items()} == {
        "A_both": ["A_X", "A_Y"],
        "B_both": ["B_X", "B_Y"],
    }
    assert [fault["axis"] for fault in data["fault"]] == ["A_X", "B_X"]
    assert data["trace"]["signals"] == ["A_X.*", "A_*.set_position", "B_X.*", "B_*.set_position"]
    assert data["trace"]["resolution"] == {"A_?.set_position": 0.5, "B_?.set_position": 0.5}
    assert "module" not in data


def test_own_tables_come_before_those_of_modules(folder: Folder) -> None:
    assert list(loaded(folder(HEAD + ONCE + "[axis.Z]\n" + LIMITS, m=AXIS))["axis"]) == ["Z", "A_X"]


def test_a_name_that_the_module_does_not_define_is_that_of_the_machine(folder: Folder) -> None:
    cell = HEAD + "[axis.Z]\n" + LIMITS + ONCE
    data = loaded(folder(cell, m=AXIS + '[group.both]\naxes = ["X", "Z"]\n'))
    assert data["group"]["A_both"]["axes"] == ["A_X", "Z"]


def test_who_names_no_signals_beside_one_that_does_is_traced_whole(folder: Folder) -> None:
    cell = HEAD + "[axis.Z]\n" + LIMITS + TWICE.replace('"m.toml"\nprefix = "B_"', '"n.toml"\nprefix = "B_"')
    path = folder(cell, m=AXIS + '[trace]\nsignals = ["X.set_position"]\n', n=AXIS)
    assert loaded(path)["trace"]["signals"] == ["Z.*", "A_X.set_position", "B_X.*"]


def test_the_resolution_of_the_machine_decides_over_that_of_a_module(folder: Folder) -> None:
    cell = HEAD + '[trace]\nresolution = { "*" = 0.25 }\n' + ONCE
    path = folder(cell, m=AXIS + '[trace]\nresolution = { "X.*" = 0.5 }\n')
    assert list(loaded(path)["trace"]["resolution"].items()) == [("A_X.*", 0.5), ("*", 0.25)]


def test_set_replaces_and_adds_values_for_one_inclusion(folder: Folder) -> None:
    values = {"axis.X.max_velocity": "7.0", "axis.X.start_position": "3", "axis.X.monitor.lag": "1.5"}
    lines = "[module.set]\n" + "".join(f'"{key}" = {value}\n' for key, value in values.items())
    cell = HEAD + ONCE + lines + TWICE[len(ONCE) :] + '[module.set]\n"axis.X.home" = { position = 2.0 }\n'
    axes = loaded(folder(cell, m=AXIS))["axis"]
    assert (axes["A_X"]["max_velocity"], axes["A_X"]["start_position"], axes["A_X"]["monitor"]["lag"]) == (
        7.0,
        3.0,
        1.5,
    )
    assert (axes["B_X"]["max_velocity"], axes["B_X"]["home"]["position"]) == (100.0, 2.0)


def test_modules_in_modules_and_set_reaches_through(folder: Folder) -> None:
    line = '[[module]]\nfile = "../m.toml"\nprefix = "IN_"\n'
    cell = HEAD + '[[module]]\nfile = "parts/line.toml"\nprefix = "L_"\nset = { "axis.IN_X.max_velocity" = 5.0 }\n'
    data = loaded(folder(cell, parts__line=line + '[group.all]\naxes = ["IN_X"]\n', m=AXIS))
    assert {name: axis["max_velocity"] for name, axis in data["axis"].items()} == {"L_IN_X": 5.0}
    assert data["group"]["L_all"]["axes"] == ["L_IN_X"]


def test_a_program_is_found_beside_its_module_and_told_the_prefix(folder: Folder, tmp_path: Path) -> None:
    cell = HEAD + TWICE.replace("m.toml", "parts/m.toml")
    path = folder(
        cell, parts__m=AXIS + '[program.go]\nfile = "go.py"\n[program.count]\nfile = "go.py"\nfunction = "count"\n'
    )
    (tmp_path / "parts" / "go.py").write_text(
        "async def main(run, prefix):\n"
        "    axis = run.axes[prefix + 'X']\n"
        "    await axis.enable()\n"
        "    await axis.move_absolute(10.0 if prefix == 'A_' else 20.0)\n"
        "def count(run, memory, *, prefix):\n"
        "    memory.names = prefix\n",
        encoding="utf-8",
    )
    machine = Machine.load(path)
    assert list(machine.description.program) == ["A_go", "A_count", "B_go", "B_count"]
    with Simulation(machine) as run:
        run.run(time=2.0)
        assert run.failures == []
        assert {name: axis.set_position for name, axis in run.axes.items()} == {"A_X": 10.0, "B_X": 20.0}
        assert list(run.trace.header["machine"]["axis"]) == ["A_X", "B_X"]
        assert_valid(run.trace)


def test_a_program_file_beside_the_module_that_is_missing(folder: Folder) -> None:
    path = folder(HEAD + ONCE.replace("m.toml", "parts/m.toml"), parts__m=AXIS + '[program.go]\nfile = "go.py"\n')
    (line, *_) = complaints(path)
    assert line.startswith('parts/m.toml:7: program.go.file = "go.py": no such file in the folder "')


def test_the_same_description_as_written_by_hand(folder: Folder) -> None:
    whole = HEAD + AXIS.replace("X", "A_X") + AXIS.replace("X", "B_X")
    assert loaded(folder(HEAD + TWICE, m=AXIS)) == loaded(folder(whole, m=""))


# What is wrong in a module: machine file, module m.toml → what is said.
IN_THE_MODULE = [
    (
        TWICE,
        AXIS.replace("100.0", "-1.0"),
        [
            "m.toml:3: axis.X.max_velocity = -1.0: must be greater than 0 (mm/s)",
            '    included at cell.toml:3 as "A_"',
            '    included at cell.toml:6 as "B_"',
        ],
    ),
    (
        TWICE,
        AXIS + '[group.all]\naxes = ["Y"]\n',
        [
            'm.toml:7: group.all.axes[0] = "Y": no such axis; axes: A_X, B_X',
            '    included at cell.toml:3 as "A_"',
            '    included at cell.toml:6 as "B_"',
        ],
    ),
    (
        ONCE,
        AXIS + '[trace]\nsignals = ["X.foo"]\n',
        [
            'm.toml:7: trace.signals[0] = "X.foo": matches no signal',
            "    signals are <axis>.<signal>, with set_position",
        ],
    ),
    (
        TWICE,
        AXIS + '[trace]\nsignals = ["X.set_positon"]\n',
        [
            'm.toml:7: trace.signals[0] = "X.set_positon": matches no signal; did you mean X.set_position?',
            '    included at cell.toml:3 as "A_"',
            '    included at cell.toml:6 as "B_"',
        ],
    ),
    (
        ONCE,
        AXIS + '[trace.resolution]\n"X.set_positon" = 0.1\n',
        ['m.toml:7: trace.resolution."X.set_positon": matches no signal; did you mean X.set_position?'],
    ),
    (
        ONCE,
        AXIS + 'unit = "°"\nvelocity = 0\n',
        ["m.toml:7: axis.X.velocity = 0: must be greater than 0 (°/s)"],
    ),
    (ONCE, AXIS + "seed = 3\n", ["m.toml:6: axis.X.seed: unknown key"]),
    (ONCE, "seed = 3\n" + AXIS, ["m.toml:2: seed: not in a module; the machine file says this once for all"]),
    (ONCE, "axs = 3\n" + AXIS, ["m.toml:2: axs: unknown key; did you mean axis?"]),
    (ONCE, "axis = 3\n", ["m.toml:2: axis = 3: must be a table"]),
    (ONCE, AXIS + "[trace]\nsignal = 1\n", ["m.toml:7: trace.signal: unknown key; did you mean signals?"]),
    (ONCE, AXIS + '[trace]\nsignals = "*"\n', ['m.toml:7: trace.signals = "*": must be a list']),
    (ONCE, AXIS + '[trace.resolution]\n"*" = 0\n', ['m.toml:7: trace.resolution."*" = 0: must be greater than 0']),
    (ONCE, "trace = 3\n" + AXIS, ["m.toml:2: trace = 3: must be a table"]),
    (ONCE, "fault = 3\n" + AXIS, ["m.toml:2: fault = 3: must be a list"]),
    (ONCE, AXIS + "[[module]]\nfile = 3\n", ["m.toml:7: module[0].file = 3: must be a text that is not empty"]),
    (ONCE, "[axis.X\n", ["m.toml:2: not valid TOML", '    included at cell.toml:3 as "A_"']),
    (ONCE, "format = 2\n", ["m.toml:1: format = 2: not a format this version understands; formats understood: 1"]),
]

# What is wrong with the inclusion.
INCLUSIONS = [
    ('[[module]]\nfile = "n.toml"\n', 'cell.toml:4: module[0].file = "n.toml": no such file in the folder "'),
    ('[[module]]\nfile = "."\n', 'cell.toml:4: module[0].file = ".": no such file in the folder "'),
    ('[[module]]\nfile = "\\u0000"\n', 'cell.toml:4: module[0].file = "\\u0000": no such file'),
    ("[[module]]\nfile = '" + "x" * 300 + "'\n", "cell.toml:4: module[0].file = "),
    ('[[module]]\nfile = "cell.toml"\n', "includes itself: cell.toml → cell.toml"),
    ("[[module]]\n", "cell.toml:3: module[0].file: missing; must be a text that is not empty"),
    ('[[module]]\nfile = "m.toml"\nprefx = "A"\n', "cell.toml:5: module[0].prefx: unknown key; did you mean prefix?"),
    (
        '[[module]]\nfile = "m.toml"\nprefix = "1-"\n',
        'cell.toml:5: module[0].prefix = "1-": must be letters, digits and underscores, not beginning with a digit',
    ),
    ("module = 3\n", "cell.toml:3: module = 3: must be a list of tables, each under [[module]]"),
    ("module = [3]\n", "cell.toml:3: module[0] = 3: must be"),
    (
        ONCE + '[module.set]\n"axis.X.max_velocity" = -2\n',
        'cell.toml:7: module[0].set."axis.X.max_velocity" = -2: must be greater than 0 (mm/s)',
    ),
    (
        ONCE + '[module.set]\n"axis.X.max_velocty" = 2\n',
        'cell.toml:7: module[0].set."axis.X.max_velocty": unknown key; did you mean max_velocity?',
    ),
    (
        ONCE + '[module.set]\n"axis.Y.max_velocity" = 2\n',
        'cell.toml:7: module[0].set."axis.Y.max_velocity": the module has no axis Y; it has: X',
    ),
    (ONCE + "[module.set]\naxis.X.max_velocity = 2\n", "cell.toml:7: module[0].set.axis: not a key that can be set"),
    (ONCE + '[module.set]\n"seed" = 2\n', "cell.toml:7: module[0].set.seed: not a key that can be set"),
    (ONCE + '[module.set]\n"a b" = 2\n', 'cell.toml:7: module[0].set."a b": not a key that can be set'),
    (ONCE + '[module.set]\n"axis.X.unit.a" = 2\n', 'cell.toml:7: module[0].set."axis.X.unit.a"'),
    (
        "[axis.A_X]\n" + LIMITS + ONCE,
        "m.toml:2: axis.X: axis A_X is already defined at cell.toml:3; include one of them with another prefix",
    ),
    (
        TWICE.replace("B_", "A_"),
        "m.toml:2: axis.X: axis A_X is already defined at m.toml:2; include one of them with another prefix",
    ),
]


@pytest.mark.parametrize(("cell", "module", "said"), IN_THE_MODULE, ids=[case[2][0] for case in IN_THE_MODULE])
def test_what_is_wrong_in_a_module_is_said_there_once(folder: Folder, cell: str, module: str, said: list[str]) -> None:
    lines = complaints(folder(HEAD + cell, m=module))
    assert [line[: len(start)] for line, start in zip(lines, said, strict=False)] == said
    assert lines[-1].startswith("    included at cell.toml:")
    assert sum(not line.startswith(" ") for line in lines) == 1


@pytest.mark.parametrize(("cell", "said"), INCLUSIONS, ids=[case[1] for case in INCLUSIONS])
def test_what_is_wrong_with_an_inclusion_is_said_at_its_line(folder: Folder, cell: str, said: str) -> None:
    lines = complaints(folder(HEAD + cell, m=AXIS.replace("[axis.X]", "[axis.X]\nunit = 'mm'")))
    assert said in lines[0]
    assert sum(not line.startswith(" ") for line in lines) == 1


WHOLE = tomllib.loads(GOOD)
FIELDS = [(table, name, key) for table in ("axis", "program") for name in WHOLE[table] for key in WHOLE[table][name]]


@pytest.mark.parametrize(("table", "name", "key"), FIELDS)
def test_a_wrong_value_of_any_field_is_found_where_the_module_has_it(
    folder: Folder, tmp_path: Path, table: str, name: str, key: str
) -> None:
    parts: dict[str, Any] = {section: WHOLE[section] for section in SECTIONS if section in WHOLE}
    (tmp_path / "pick.py").write_text("pick_and_place = main = None\n", encoding="utf-8")
    parts[table] = {**parts[table], name: {**parts[table][name], key: [1979]}}
    lines = [f"{table}.{name}.{one} = {toml(value)}" for one, value in parts[table][name].items()]
    rest = _lines({section: one for section, one in parts.items() if section != table})
    others = [f"{table}.{other} = {toml(one)}" for other, one in parts[table].items() if other != name]
    with pytest.raises(MachineError) as caught:
        load_description(folder(HEAD + ONCE, m="\n".join(lines) + "\n" + "\n".join(others) + "\n" + rest))
    (finding,) = caught.value.findings
    expected = (2 + list(parts[table][name]).index(key), f"{table}.{name}.{key}", str(tmp_path / "m.toml"))
    assert (finding.line, finding.field, finding.file) == expected


def test_a_circle_is_named_with_its_files(folder: Folder) -> None:
    back = '[[module]]\nfile = "{}.toml"\n'
    lines = complaints(folder(HEAD + back.format("a"), a=back.format("b"), b=back.format("a")))
    assert lines == [
        'b.toml:3: module[0].file = "a.toml": includes itself: a.toml → b.toml → a.toml',
        "    included at a.toml:2 from cell.toml:3",
    ]


def test_findings_come_in_the_order_of_the_files(folder: Folder) -> None:
    cell = HEAD + "sed = 1\n" + ONCE + "[axis.Z]\n" + LIMITS.replace("100.0", "0")
    lines = [line for line in complaints(folder(cell, m=AXIS.replace("100.0", "0") + "q = 1\n")) if line[0] != " "]
    assert [line.split(": ")[0] for line in lines] == ["cell.toml:3", "cell.toml:8", "m.toml:3", "m.toml:6"]


def test_a_module_without_format(folder: Folder) -> None:
    path = folder(HEAD + ONCE)
    (path.parent / "m.toml").write_text(AXIS, encoding="utf-8")
    assert complaints(path) == [
        "m.toml:1: format: missing; formats understood: 1",
        '    included at cell.toml:3 as "A_"',
    ]


def test_data_without_a_file_includes_modules_from_the_working_directory(
    folder: Folder, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder(HEAD, m=AXIS.replace("100.0", "0")).parent)
    data = {"format": 1, "name": "m", "module": [{"file": "m.toml", "prefix": "A_"}]}
    with pytest.raises(MachineError) as caught:
        Machine.from_dict(data)
    assert str(caught.value).splitlines() == [
        "m.toml:3: axis.X.max_velocity = 0: must be greater than 0 (mm/s)",
        '    included at module[0] as "A_"',
    ]
    good = {**data["module"][0], "set": {"axis.X.max_velocity": 2.0}}  # type: ignore[index]
    assert Machine.from_dict({**data, "module": [good]}).description.axis["A_X"].max_velocity == 2.0


def test_every_section_is_of_modules_or_of_the_machine_alone() -> None:
    alone = {"format", "name", "base_cycle_ns", "seed", "realtime", "log", "persistent_file", "layer", "control", "ads"}
    assert set(Description.model_fields) <= alone | set(SECTIONS), "say in machine/_names.py what a module may hold"
    assert not alone & (set(SECTIONS) - {"format"})


_JUNK: st.SearchStrategy[Any] = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(0, 3), st.sampled_from(["X", "axis.X.unit", "m.toml", ""])),
    lambda inner: st.one_of(
        st.lists(inner, max_size=2),
        st.dictionaries(st.sampled_from([*SECTIONS, "module", "file", "prefix", "set", "X", "axes", "signals"]), inner),
    ),
    max_leaves=12,
)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(data=st.dictionaries(st.sampled_from([*SECTIONS, "module"]), _JUNK), entry=_JUNK)
def test_any_data_with_modules_is_checked_or_refused_in_order(
    folder: Folder, data: dict[str, Any], entry: object
) -> None:
    path = folder(HEAD, m=AXIS)
    file = {"file": str(path.parent / "m.toml"), "prefix": "A_", "set": {"axis.X.unit": entry}}
    for module in ([file, entry], data.get("module")):
        with pytest.raises(MachineError):
            Machine.from_dict({**data, "format": 1, "name": 3, "module": module})


_AXES = st.lists(st.sampled_from(["X", "Y", "Z", "X_1"]), min_size=1, unique=True)
_PREFIXES = st.lists(st.sampled_from(["A_", "B_", "X", "Y9"]), min_size=1, max_size=3, unique=True)


def toml(value: Any) -> str:
    """Write data as a TOML value."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(one)}" for key, one in value.items()) + " }"
    return "[" + ", ".join(map(toml, value)) + "]" if isinstance(value, list) else json.dumps(value)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(axes=_AXES, prefixes=_PREFIXES, data=st.data())
def test_a_machine_of_modules_is_the_machine_written_by_hand(
    folder: Folder, axes: list[str], prefixes: list[str], data: st.DataObject
) -> None:
    limits = {"max_velocity": 1, "max_acceleration": 1, "max_jerk": 1, "drive": {"kind": "servo", "position_gain": 9}}
    members = data.draw(st.lists(st.sampled_from([*axes, "Main"]), min_size=1))
    signals = [f"{name}.{data.draw(st.sampled_from(['*', 'set_*']))}" for name in axes]
    broken = data.draw(st.sampled_from(axes))

    def part(prefix: str) -> dict[str, Any]:
        def own(name: str) -> str:
            return name if name == "Main" else prefix + name

        return {
            "axis": {own(name): limits for name in axes},
            "group": {prefix + "g": {"axes": [own(name) for name in members]}},
            "fault": [{"axis": own(broken), "kind": "blocked", "tick": 1}],
            "trace": {"signals": [prefix + pattern for pattern in signals]},
        }

    whole: dict[str, Any] = {"axis": {"Main": limits}, "group": {}, "fault": [], "trace": {"signals": ["Main.*"]}}
    for one in map(part, prefixes):
        whole["axis"] |= one["axis"]
        whole["group"] |= one["group"]
        whole["fault"] += one["fault"]
        whole["trace"]["signals"] += one["trace"]["signals"]
    modules = [{"file": "m.toml", "prefix": prefix} for prefix in prefixes]
    cell = {"axis": {"Main": limits}, "module": modules}
    path = folder(HEAD + _lines(cell), m=_lines(part("")))
    assert loaded(path) == check_description({"format": 1, "name": "cell", **whole}).model_dump(mode="json")


def _lines(tables: dict[str, Any]) -> str:
    return "".join(f"{key} = {toml(value)}\n" for key, value in tables.items())
