"""The JSON schema for editors: it takes what is valid, and refuses what a schema can refuse."""

import tomllib
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from tests.machine.test_bad_machines import BAD

from motionlayer.machine import Description, check_description, machine_schema, module_schema
from motionlayer.machine._names import SECTIONS

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*/machine.toml"))
TEMPLATE = ROOT / "src" / "motionlayer" / "cli" / "templates" / "machine.toml"

SCHEMAS = {"machine": machine_schema(), "module": module_schema()}
MACHINE, MODULE = map(Draft202012Validator, SCHEMAS.values())

RELATION_ONLY = {
    # the ranges of planning: in the schema they would stand behind every key, where nobody comes near them
    "axis.X.start_position: = 1e+61: must be from -1e+60 to 1e+60 (mm)",
    "axis.X.jerk: = 1e-61: must be from 1e-60 to 1e+60 (mm/s³)",
    # a value beside another one
    "axis.X.velocity: = 11: must be at most max_velocity = 10.0 (mm/s)",
    "axis.X.acceleration: at most max_acceleration = 10.0",
    "axis.X.deceleration: at most max_deceleration = 10.0",
    "axis.X.jerk: at most max_jerk = 10.0 (mm/s³)",
    "axis.X.software_limit_max: must be greater than software_limit_min = 5.0 (mm)",
    "axis.X.home.velocity: at most max_velocity = 10.0",
    "axis.X.home.switch: missing; must be a finite",
    'axis.X.home.turn: mode = "software_sync" needs it',
    'axis.X.home.latch: mode = "soft_latch_negative" needs it',
    "axis.X.home.latch_width: left out without latch",
    'axis.X.drive.position_gain: kind = "servo" needs it',
    "axis.X.drive.backlash: an ideal drive has no such thing",
    "axis.X.drive.dead_time: a whole number of base cycles of 0.001",
    "axis.X.drive.ready_delay: at most 1000 base cycles = 1 (s)",
    "axis.X.drive.position_gain: must be less than 2000, where",
    "axis.X.monitor.target_timeout: without target_window",
    "task.a.phase: = 4: must be from 0 to every - 1 = 3",
    "task.a.budget: = 0.0011: must be at most the base cycle = 0.001 (s)",
    "task.b.budget: = 0.0005: 0.0011 s in one tick together with a, and the base cycle is 0.001 s",
    "fault[0]: no tick or time",
    "fault[0]: one of tick and time",
    "fault[0].axis: its drive is ideal",
    "fault[0].value: only an encoder_jump takes one",
    "fault[0].value: missing",
    # names of other tables, of files and of what is in them
    'group.all.axes[1]: = "Y": no such axis',
    "fault[0].axis: no such axis",
    'program.a.task: = "fats": no such task; did you mean fast?',
    "program.a.task: tasks are main",
    "axis.x: differs from axis.X",
    'program.a.file: = "no.py": no such file',
    "program.a.file: not a file",
    'program.a.file: "\\u0000"',
    "program.a.function: Python function",
    "trace.signals[1]: mean X.set_position?",
    'trace.resolution."Y.*": matches no signal',
    # JSON knows neither inf nor the difference between 1e6 and 1000000; `$` of its patterns may stand before a line end
    "axis.X.start_position: = inf: must be a finite number (mm)",
    "axis.X.home.velocity: = inf: must be a finite number",
    "base_cycle_ns: must be a whole number from 50_000",
    'axis."X\\n": not a name of an axis',
}  # fmt: skip


def tables(text: str) -> dict[str, Any] | None:
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError):
        return None


@pytest.mark.parametrize("schema", SCHEMAS.values(), ids=SCHEMAS)
def test_it_is_a_schema_of_the_draft_it_names(schema: dict[str, Any]) -> None:
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    Draft202012Validator.check_schema(schema)
    assert "'null'" not in str(schema)


@pytest.mark.parametrize("path", [*EXAMPLES, TEMPLATE], ids=lambda path: path.parent.name)
def test_examples_are_valid(path: Path) -> None:
    MACHINE.validate(tomllib.loads(path.read_text(encoding="utf-8")))


@pytest.mark.parametrize("name", ["good.toml", "minimal.toml"])
def test_valid_machines_are_valid(name: str) -> None:
    MACHINE.validate(tomllib.loads((Path(__file__).parent / name).read_text(encoding="utf-8")))


CASES = {f"{field}: {said.splitlines()[0]}": data for text, _, field, said in BAD if (data := tables(text)) is not None}


@pytest.mark.parametrize("case", CASES)
def test_what_check_refuses_is_refused_or_listed(case: str) -> None:
    assert MACHINE.is_valid(CASES[case]) == (case in RELATION_ONLY), "what the schema does not say is listed above"


def test_the_list_names_nothing_that_is_gone() -> None:
    assert set(CASES) >= RELATION_ONLY


def test_a_machine_may_have_its_axes_in_modules_alone() -> None:
    head = {"format": 1, "name": "m"}
    assert not MACHINE.is_valid(head)
    assert MACHINE.is_valid({**head, "module": [{"file": "a.toml"}]})
    assert not MACHINE.is_valid({**head, "module": [{"prefix": "A_"}]})
    assert not MACHINE.is_valid({**head, "module": [{"file": "a.toml", "prefix": "1"}]})


def test_a_module_holds_nothing_that_concerns_the_whole_machine() -> None:
    assert MODULE.is_valid({"format": 1})
    assert set(SCHEMAS["module"]["properties"]) == {"format", "module", *SECTIONS}
    for key in set(Description.model_fields) - {"format", *SECTIONS}:
        assert not MODULE.is_valid({"format": 1, key: 1}), key


def test_ranges_and_units_are_those_of_the_messages() -> None:
    axis = machine_schema()["$defs"]["AxisDescription"]["properties"]
    assert axis["max_velocity"].items() >= {"exclusiveMinimum": 0, "x-unit": "u/s", "type": "number"}.items()
    assert axis["software_limit_min"].items() >= {"type": "number", "x-unit": "u"}.items()


def test_every_text_of_a_number_with_unit_names_it() -> None:
    for name, node in machine_schema()["$defs"].items():
        for key, field in node["properties"].items():
            unit = field.get("x-unit")
            assert unit is None or unit in field["description"].lower(), f"{name}.{key}"


def test_a_described_machine_is_valid_again() -> None:
    axis = {"max_velocity": 1, "max_acceleration": 1, "max_jerk": 1}
    dump = check_description({"format": 1, "name": "m", "axis": {"X": axis}}).model_dump(mode="json", exclude_none=True)
    MACHINE.validate(dump)
