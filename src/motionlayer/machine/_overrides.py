"""`set` of a module: values in the place of those that the module file has."""

import difflib
import tomllib
from typing import Any, Final

from motionlayer.machine._data import table
from motionlayer.machine._fragment import Flat, Origin, Report
from motionlayer.machine._names import NAMED
from motionlayer.machine._problem import KeyPath, Problem, field_text
from motionlayer.machine._renamed import modern_path, warning

_EXAMPLE: Final = 'write a key of the module in quotes, such as "axis.X.max_velocity" = 300.0'


def override(flat: Flat, key: str, value: object, origin: Origin, report: Report) -> None:
    """Put a value in the place that a key of `set` names; what is wrong with the key is reported at it.

    The value is checked later, like any other, and found at the line of `set`.
    """
    path, rename = modern_path(_path(key))
    if rename is not None:
        report.warnings.append(warning(origin, path, rename))
    problem = _key_problem(flat, path)
    if problem is None:
        problem = _put(flat, path, value)
    if problem is not None:
        report.findings.append(origin.finding(problem))
        return
    for below in [known for known in flat.origins if known[: len(path)] == path]:
        del flat.origins[below]
    flat.origins[path] = origin


def _path(key: str) -> KeyPath:
    """Return the path that a key written as in TOML names; empty if it is no key."""
    try:
        node: Any = tomllib.loads(f"{key} = true")
    except (ValueError, RecursionError):
        return ()
    path: KeyPath = ()
    while isinstance(node, dict) and len(node) == 1:
        ((name, node),) = node.items()
        path = (*path, name)
    return path if node is True else ()


def _key_problem(flat: Flat, path: KeyPath) -> Problem | None:
    """Return what is wrong with a key before its value is put in."""
    if len(path) < (3 if path[:1] and path[0] in NAMED else 2) or path[0] not in (*NAMED, "trace"):
        return Problem(path, problem="not a key that can be set", hint=_EXAMPLE)
    names = list(table(flat.data, str(path[0])))
    if path[0] in NAMED and path[1] not in names:
        near = difflib.get_close_matches(str(path[1]), names, n=1)
        hint = f"did you mean {near[0]}?" if near else f"it has: {', '.join(names) or 'none'}"
        return Problem(path, problem=f"the module has no {path[0]} {path[1]}", hint=hint)
    return None


def _put(flat: Flat, path: KeyPath, value: object) -> Problem | None:
    """Put a value at a path; tables on the way are copied, so that what the file itself says stays known."""
    node: dict[Any, Any] = dict(flat.data)
    flat.data = node
    for index, key in enumerate(path[:-1], start=1):
        inside = node.get(key, {})
        if not isinstance(inside, dict):
            return Problem(path, problem=f"{field_text(path[:index])} is not a table", hint=_EXAMPLE)
        node[key] = dict(inside)
        node = node[key]
    node[path[-1]] = value
    return None
