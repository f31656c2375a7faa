"""Write the reference pages that stand in the code as tables: states, errors, machine file, command line.

`--check` writes nothing and fails if a page in docs/ is not what the code says.
"""

import json
import re
import sys
from collections.abc import Iterable, Iterator
from typing import Any, Final

import click
from _generated import ROOT, current

from motionlayer.cli._main import group
from motionlayer.command import ERRORS, RANGES, ErrorId, ErrorText
from motionlayer.machine import MachineFile
from motionlayer.nc import TRANSITIONS, AxisEvent, AxisState

DOCS: Final = ROOT / "docs"
NOTE: Final = "<!-- Written by scripts/reference.py from the code; do not edit. -->"
WIDTH: Final = 100
KINDS: Final = {"string": "text", "integer": "whole number", "boolean": "true or false"}

STATES: Final = {
    AxisState.UNDEFINED: "not used",
    AxisState.DISABLED: "the drive is off",
    AxisState.STANDSTILL: "the drive is on, nothing moves",
    AxisState.ERRORSTOP: "in error, braking or at rest; only `reset()` leads out",
    AxisState.STOPPING: "braking, or locked by a `stop()` that is held; no other motion is taken",
    AxisState.HOMING: "`home()` is under way",
    AxisState.DISCRETE_MOTION: "a move to a position, or a `halt()`",
    AxisState.CONTINUOUS_MOTION: "a motion without end, or a jog",
    AxisState.SYNCHRONIZED_MOTION: "coupled to another axis; not yet",
}

EVENTS: Final = {
    AxisEvent.ENABLE: "`enable()`",
    AxisEvent.READY: "the drive became ready",
    AxisEvent.DISABLE: "`disable()`",
    AxisEvent.OFF: "the drive is off, the axis at rest",
    AxisEvent.RESET: "`reset()`, drive ready",
    AxisEvent.RESET_OFF: "`reset()`, drive off",
    AxisEvent.MOVE: "`move_absolute()`, `move_relative()`, `move_additive()`, `move_modulo()`, inching",
    AxisEvent.MOVE_ENDLESS: "`move_velocity()`, `move_continuous_absolute()`, `move_continuous_relative()`, `jog()`",
    AxisEvent.HALT: "`halt()`",
    AxisEvent.STOP: "`stop()`",
    AxisEvent.EMERGENCY_STOP: "`emergency_stop()`",
    AxisEvent.FEED_LOST: "`enable()` without the direction of the motion",
    AxisEvent.HOME: "`home()`",
    AxisEvent.AT_REST: "the motion came to its end",
    AxisEvent.FAULT: "an error of the axis",
}
"""Who brings an event, for a reader."""


def pages() -> dict[str, str]:
    """Return every generated page by its name below docs/."""
    made = {"states.md": states(), "errors.md": errors(), "machine-keys.md": keys(), "cli.md": command_line()}
    return {name: "\n".join([NOTE, "", *lines]).rstrip() + "\n" for name, lines in made.items()}


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> Iterator[str]:
    """Yield the lines of a Markdown table."""
    names = list(head)
    yield "| " + " | ".join(names) + " |"
    yield "|" + "---|" * len(names)
    for row in rows:
        yield "| " + " | ".join(cell.replace("|", r"\|") for cell in row) + " |"


def states() -> Iterator[str]:
    """Yield the page of the axis states: names, table, diagram."""
    yield from ["# States of an axis", ""]
    yield "The states of PLCopen with the numbers of `MC_AxisStates`, from the table that the code runs on"
    yield from ["(`motionlayer.nc.TRANSITIONS`). `axis.state` is an `AxisState`; a trace holds its number.", ""]
    rows = ((str(int(s)), str(s), f"`AxisState.{s.name}`", STATES.get(s, "")) for s in AxisState)
    yield from table(["number", "state", "in Python", "meaning"], rows)
    yield from ["", "## What leads where", ""]
    yield "Per event and present state: the next state, or the [error](errors.md) that refuses the command and changes"
    yield from ["nothing. = is the same state; an empty cell cannot happen.", ""]
    yield from table(["event", *map(str, TRANSITIONS)], _transition_rows())
    yield from ["", "A command that needs power is refused with 0x4260 as soon as `disable()` was called, even while"]
    yield from ["the state is still StandStill.", "", "```mermaid", "stateDiagram-v2", *_edges(), "```"]


def _transition_rows() -> Iterator[list[str]]:
    for event in AxisEvent:
        yield [EVENTS.get(event, event.value), *(_cell(state, row.get(event)) for state, row in TRANSITIONS.items())]


def _cell(state: AxisState, to: AxisState | ErrorId | None) -> str:
    if to is None:
        return ""
    if isinstance(to, ErrorId):
        return f"0x{to:04X}"
    return "=" if to is state else str(to)


def _edges() -> Iterator[str]:
    yield f"    [*] --> {AxisState.DISABLED}"
    for state, row in TRANSITIONS.items():
        for to in sorted({to for to in row.values() if isinstance(to, AxisState) and to is not state}):
            why = ", ".join(event.value for event, target in row.items() if target is to)
            yield f"    {state} --> {to}: {why}"


def errors() -> Iterator[str]:
    """Yield the page of the error ids."""
    yield from ["# Errors", ""]
    yield "`command.error` and `axis.error` are a `MotionError` with `id`, `source`, `detail`; printed, it gives text,"
    yield "numbers and advice. The ids are those of TwinCAT NC, where it has one; in Python they are"
    yield "`motionlayer.command.ErrorId`, an integer enum. Errors without *answered by* are not raised by this version;"
    yield "they are listed so that what another controller reports can be looked up. `motionlayer error 0x4225`"
    yield from ["explains one in the terminal.", ""]
    for kin in RANGES:
        chosen = {error: entry for error, entry in ERRORS.items() if kin.first <= error <= kin.last}
        if chosen:
            yield from [f"## 0x{kin.first:04X}: {kin.title}", "", *_errors(chosen), ""]


def _errors(chosen: dict[ErrorId, ErrorText]) -> Iterator[str]:
    rows = ([f"0x{one:04X}", str(int(one)), f"`{one.name}`", *entry] for one, entry in chosen.items())
    yield from table(["id", "decimal", "name", "meaning", "what to do", "answered by"], rows)


def keys() -> Iterator[str]:
    """Yield the page of every key of the machine file."""
    root = MachineFile.model_json_schema()
    yield from ["# Every key of the machine file", ""]
    yield "With examples and explanations: [the machine file](machine-file.md). u is the unit of the axis. A key"
    yield from ["without default is required; *see meaning*: the default depends on other keys.", ""]
    yield from _section("The top", root)
    for name in _order(root, root["$defs"]):
        node = root["$defs"][name]
        yield from ["", *_section(_sentence(node.get("description", name)), node)]


def _section(text: str, node: dict[str, Any]) -> Iterator[str]:
    title, _, more = text.partition(". ")
    yield from [f"## {title}", "", *([f"{more}.", ""] if more else [])]
    required = node.get("required", [])
    rows = ([f"`{key}`", *_columns(field, required=key in required)] for key, field in node["properties"].items())
    yield from table(["key", "value", "default", "meaning"], rows)


def _columns(field: dict[str, Any], *, required: bool) -> list[str]:
    return [_value(field), _default(field, required=required), _sentence(field.get("description", ""))]


def _default(field: dict[str, Any], *, required: bool) -> str:
    if "default" in field:
        return "none" if field["default"] is None else f"`{json.dumps(field['default'], ensure_ascii=False)}`"
    if required:
        return ""
    return "empty" if "$ref" in field or field.get("type") == "object" else "*see meaning*"


def _value(field: dict[str, Any]) -> str:
    """Return what a key takes: kind, range and unit."""
    options = [one for one in field.get("anyOf", field.get("oneOf", [])) if one.get("type") != "null"]
    if options:
        return " or ".join(dict.fromkeys(_value({**one, "x-unit": field.get("x-unit", "")}) for one in options))
    if "$ref" in field:
        return "table"
    if "const" in field or "enum" in field:
        return ", ".join(f"`{json.dumps(value)}`" for value in field.get("enum", [field.get("const")]))
    if field.get("type") == "array":
        return f"list, each: {_value(field['items'])}"
    if field.get("type") == "object":
        each = field["additionalProperties"]
        return "table" if each is True else f"table, each: {_value(each)}"
    unit = f" ({field['x-unit']})" if field.get("x-unit") else ""
    return KINDS.get(field.get("type", ""), "number") + _range(field) + unit


def _range(field: dict[str, Any]) -> str:
    low, high = field.get("minimum"), field.get("maximum")
    if low is not None and high is not None:
        return f" from {low} to {high}"
    marks = {"exclusiveMinimum": ">", "minimum": "≥", "exclusiveMaximum": "<", "maximum": "≤"}
    return "".join(f" {mark} {field[key]}" for key, mark in marks.items() if key in field)


def _sentence(text: str) -> str:
    return " ".join(text.split()).rstrip(".")


def _order(node: object, known: dict[str, Any], seen: tuple[str, ...] = ()) -> list[str]:
    """Return the names of the tables in the order in which the description mentions them."""
    found = list(seen)
    inside = {key: value for key, value in node.items() if key != "$defs"} if isinstance(node, dict) else node
    for name in re.findall(r'"#/\$defs/(\w+)"', json.dumps(inside)):
        if name not in found:
            found = _order(known[name], known, (*found, name))
    return found


def command_line() -> Iterator[str]:
    """Yield the page of the command line: its own help."""
    yield from ["# The command line", ""]
    yield "What `motionlayer --help` says. Results go to stdout, with what programs print; errors, notes and the"
    yield "progress bar go to stderr. `--program FILE[:NAME]` names a Python file and, after a colon, which"
    yield "function in it is to run, `async def NAME(run)` or `def NAME(run)`; without `:NAME` it is `main`. So one"
    yield from ["file may hold several programs.", ""]
    size = {"max_content_width": WIDTH, "terminal_width": WIDTH}
    whole = click.Context(group, info_name="motionlayer", **size, **group.context_settings)
    yield from _help(whole)
    for name in group.list_commands(whole):
        yield from _help(click.Context(group.commands[name], parent=whole, info_name=name, **size))


def _help(context: click.Context) -> Iterator[str]:
    text = "\n".join(line.rstrip() for line in context.get_help().splitlines())
    yield from [f"## `{context.command_path}`", "", "```text", text, "```", ""]


if __name__ == "__main__":
    sys.exit(current(__doc__ or "", "scripts/reference.py", DOCS, pages()))
