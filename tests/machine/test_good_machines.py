import json
from collections.abc import Callable
from pathlib import Path

import pytest

from motionlayer.machine import Description, check_description, load_description

GOOD = (Path(__file__).parent / "good.toml").read_text(encoding="utf-8")  # sets every field
MINIMAL = (Path(__file__).parent / "minimal.toml").read_text(encoding="utf-8")
Write = Callable[[str], Path]


def test_defaults_are_filled_in(write: Write) -> None:
    description = load_description(write(MINIMAL))
    x = description.axis["X"]
    assert (description.base_cycle_ns, description.seed, description.program) == (1_000_000, 0, {})
    assert (x.unit, x.max_deceleration, x.start_position) == ("mm", 10000.0, 0.0)
    assert (x.velocity, x.acceleration, x.deceleration, x.jerk) == (1500.0, 10000.0, 10000.0, 200000.0)
    assert (x.software_limit_min, x.software_limit_max) == (None, None)
    assert (x.home.mode, x.home.position, x.home.switch, x.home.velocity) == ("direct", 0.0, None, 150.0)
    assert (x.home.direction, x.drive.kind) == ("negative", "ideal")
    assert (description.trace.signals, description.trace.resolution) == (("*",), {})
    assert isinstance(x.max_velocity, float)


def test_everything_set_is_kept(write: Write) -> None:
    description = load_description(write(GOOD))
    x = description.axis["X"]
    assert (x.max_deceleration, x.velocity, x.home.switch, x.home.velocity) == (12000.0, 1000.0, -5.0, 50.0)
    assert (description.program["pick"].function, description.program["pick"].task) == ("pick_and_place", "fast")
    assert dict(description.task["fast"]) == {"every": 4, "phase": 1, "budget": 0.0002}
    assert description.trace.resolution == {"X.set_position": 1e-6}


def test_default_deceleration_follows_max_deceleration() -> None:
    axis = {"max_velocity": 1, "max_acceleration": 2, "max_deceleration": 3, "max_jerk": 4}
    description = check_description({"format": 1, "name": "a", "axis": {"X": axis}})
    assert description.axis["X"].deceleration == 3.0


def test_order_of_tables_is_order_of_axes() -> None:
    axis = {"max_velocity": 1, "max_acceleration": 1, "max_jerk": 1}
    names = ["Z", "a", "X", "_9"]
    description = check_description({"format": 1, "name": "a", "axis": dict.fromkeys(names, axis)})
    assert list(description.axis) == names


def test_dump_is_json_and_describes_the_same_machine(write: Write) -> None:
    path = write(GOOD)
    description = load_description(path)
    dump = json.loads(json.dumps(description.model_dump(mode="json"), allow_nan=False))
    assert check_description(dump, file=path) == description
    assert dump["axis"]["Y"]["software_limit_min"] is None
    assert dump["axis"]["X"]["drive"] == {"kind": "ideal"}


def test_byte_order_mark_and_windows_lines_are_fine(write: Write) -> None:
    text = "\ufeff" + GOOD.replace("\n", "\r\n")
    assert load_description(write(text)) == load_description(write(GOOD))


def test_description_is_frozen(write: Write) -> None:
    description = load_description(write(MINIMAL))
    with pytest.raises(ValueError, match="frozen"):
        description.axis["X"].max_velocity = 1.0


def test_schema_describes_every_field_and_asks_only_for_what_has_no_default() -> None:
    schema = Description.model_json_schema()
    tables = {"Description": schema, **schema["$defs"]}
    undescribed = [
        f"{name}.{key}"
        for name, table in tables.items()
        for key, field in table["properties"].items()
        if "description" not in field
    ]
    assert undescribed == []
    assert {name: table.get("required", []) for name, table in tables.items()} == {
        "Description": ["format", "name"],
        "AdsDescription": [],
        "AdsLimitsDescription": [],
        "AxisDescription": ["max_velocity", "max_acceleration", "max_jerk"],
        "HomeDescription": [],
        "ControlDescription": ["axes"],
        "DivisorDescription": [],
        "DriveDescription": [],
        "FaultDescription": ["axis", "kind"],
        "GroupDescription": ["axes"],
        "LayerDescription": [],
        "LogDescription": ["folder"],
        "ManualDescription": [],
        "MapDescription": ["group"],
        "ModuloDescription": [],
        "MonitorDescription": [],
        "MqttDescription": [],
        "PhaseDescription": [],
        "ProgramDescription": ["file"],
        "RealTimeDescription": [],
        "TaskDescription": [],
        "TraceDescription": [],
    }


def test_tasks_that_never_meet_share_no_budget() -> None:
    """The task without a budget takes phase 0, so the other two meet neither it nor each other."""
    axis = {"max_velocity": 1, "max_acceleration": 1, "max_jerk": 1}
    tasks = {
        "none": {"every": 3},
        "a": {"every": 3, "budget": 0.0009},
        "b": {"every": 3, "budget": 0.0009},
    }
    description = check_description({"format": 1, "name": "a", "axis": {"X": axis}, "task": tasks})
    assert description.task["a"].budget == 0.0009
