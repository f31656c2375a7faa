"""pydantic's errors in our words.

What a field allows is read from the JSON schema of the models, so that messages, editors and checks cannot
say different things.
"""

import difflib
import functools
import json
from collections.abc import Iterable
from typing import Any, cast

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from motionlayer.machine._problem import KeyPath, Problem, value_text
from motionlayer.machine._schema import MachineFile

_KINDS = {
    "number": "a finite number",
    "integer": "a whole number",
    "boolean": "true or false",
    "string": "a text",
    "array": "a list",
    "object": "a table",
}

# Error types that say the kind is right and the value is not: then the range alone is named.
_RANGE_ONLY = frozenset({"greater_than", "greater_than_equal", "less_than", "less_than_equal"})

# What other controllers and papers call it.
_OTHER_NAMES = {
    "max_torque": "max_acceleration",
    "torque_limit": "max_acceleration",
    "kv": "position_gain",
    "kv_factor": "position_gain",
    "following_error": "lag",
    "position_lag": "lag",
}

# Follows from another error that is reported itself.
_CONSEQUENCES = frozenset({"default_factory_not_called"})


def model_problems(errors: Iterable[ErrorDetails]) -> list[Problem]:
    """Return one problem for each error of the models that a person has to mend."""
    own = [error for error in errors if error["type"] not in _CONSEQUENCES]
    # A misspelt required key is one mistake, not two.
    meant = {_meant(error["loc"]) for error in own if error["type"] == "extra_forbidden"}
    return [_problem(error) for error in own if not (error["type"] == "missing" and error["loc"] in meant)]


def table_problems(error: ValidationError, at: KeyPath) -> list[Problem]:
    """Return one problem for each error of the model of a single table, which stands at a path."""
    errors = [{**one, "loc": (*at, *one["loc"])} for one in error.errors(include_url=False)]
    return model_problems(cast("list[ErrorDetails]", errors))


def _problem(error: ErrorDetails) -> Problem:
    path, context, field = error["loc"], error.get("ctx", {}), _schema(error["loc"])
    value = value_text(error["input"])
    match error["type"]:
        case "missing":
            return Problem(path, problem="missing", allowed=_allowed(field), hint=context.get("hint", ""))
        case "extra_forbidden":
            return Problem(path, problem="unknown key", hint=_known_keys_hint(path))
        case "invalid_key":
            return Problem(path, problem="unknown key", hint="a key is a text")
        case "string_type" if path[-1] == "[key]":  # so pydantic marks the key of a dict
            return Problem(path[:-1], problem="unknown key", hint="a key is a text")
        case "relation":
            return Problem(path, value, context["allowed"] + _unit(field))
        case kind:
            allowed = _range(field) + _unit(field) if kind in _RANGE_ONLY else _allowed(field)
            return Problem(path, value, allowed)


def _allowed(field: dict[str, Any]) -> str:
    """Return kind, range and unit: `a finite number greater than 0 (u/s)`."""
    if "const" in field:
        return json.dumps(field["const"])
    if "enum" in field:
        return "one of " + ", ".join(json.dumps(value) for value in field["enum"])
    text = " ".join(part for part in (_KINDS.get(field.get("type", ""), "something else"), _range(field)) if part)
    return text + _unit(field)


def _range(field: dict[str, Any]) -> str:
    if "minimum" in field and "maximum" in field:
        return f"from {field['minimum']:_} to {field['maximum']:_}"
    if "minimum" in field:
        return f"at least {field['minimum']:_}"
    if "exclusiveMinimum" in field:
        return f"greater than {field['exclusiveMinimum']}"
    if "minLength" in field:
        return "that is not empty"
    return "with at least one entry" if {"minProperties", "minItems"} & field.keys() else ""


def _unit(field: dict[str, Any]) -> str:
    return f" ({field['x-unit']})" if "x-unit" in field else ""


def _meant(path: KeyPath) -> KeyPath:
    """Return the path of the known key that an unknown one means or resembles most, or the path itself."""
    key = str(path[-1])
    other = _OTHER_NAMES.get(key.lower())
    if other in _known_keys(path):
        return (*path[:-1], other)
    near = difflib.get_close_matches(key.lower(), _known_keys(path), n=1)
    return (*path[:-1], near[0]) if near else path


def _known_keys_hint(path: KeyPath) -> str:
    meant = _meant(path)
    return f"did you mean {meant[-1]}?" if meant != path else "known keys: " + ", ".join(_known_keys(path))


def _known_keys(path: KeyPath) -> list[str]:
    return list(_schema(path[:-1]).get("properties", {}))


def _schema(path: KeyPath) -> dict[str, Any]:
    """Return the JSON schema of the value at a path; empty where the models know none."""
    root = _root_schema()
    node = root
    for key in path:
        inside = node.get("items") if isinstance(key, int) else node.get("properties", {}).get(key)
        node = _resolved(inside or node.get("additionalProperties") or {}, root)
    return node


def _resolved(node: dict[str, Any], root: dict[str, Any]) -> dict[str, Any]:
    """Follow a reference; of "this or null" take this, since TOML has no null."""
    if "anyOf" in node:
        node = node["anyOf"][0]
    if "$ref" in node:
        found: dict[str, Any] = root["$defs"][node["$ref"].rpartition("/")[2]]
        return found
    return node


@functools.cache
def _root_schema() -> dict[str, Any]:
    return MachineFile.model_json_schema()
