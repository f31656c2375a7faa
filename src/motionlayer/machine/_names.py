"""The names that a module brings, and the prefix they get where it is included.

Scopes are those of a programming language: a name that the module defines means its own thing wherever the module
uses it, any other name is looked up where the module is included. So a group of a module may hold an axis of the
machine, and a program of it may run in a task of the machine.
"""

from typing import Any, Final

from motionlayer.machine._data import table
from motionlayer.machine._fragment import Flat, Origin
from motionlayer.machine._problem import KeyPath

NAMED: Final = ("axis", "group", "task", "program")
"""Sections that are tables by name."""

LISTS: Final = ("fault",)
"""Sections that are arrays of tables."""

SECTIONS: Final = (*NAMED, *LISTS, "trace")
"""What a module may hold, beside its format and modules of its own; all else is said once, in the machine file."""

REFERENCES: Final = (("group", "axes", "axis"), ("program", "task", "task"), ("fault", "axis", "axis"))
"""Section and key of each value that is a name, or a list of names, and the section it names something of."""


def prefixed(flat: Flat, prefix: str) -> Flat:
    """Return the tables of a module with a prefix before every name that it defines."""
    names = {section: list(table(flat.data, section)) for section in NAMED}
    data = dict(flat.data)
    for section in NAMED:
        if isinstance(data.get(section), dict):
            data[section] = {
                _named(name, prefix): _referring(section, entry, names, prefix) for name, entry in data[section].items()
            }
    for section in LISTS:
        if isinstance(data.get(section), list | tuple):
            data[section] = [_referring(section, entry, names, prefix) for entry in data[section]]
    if isinstance(data.get("program"), dict):
        data["program"] = {name: _knowing(entry, prefix) for name, entry in data["program"].items()}
    if isinstance(data.get("trace"), dict):
        data["trace"] = _patterns(data["trace"], prefix)
    return Flat(data, {_renamed(path, prefix): origin for path, origin in _rooted(flat).items()})


def _referring(section: str, entry: Any, names: dict[str, list[str]], prefix: str) -> Any:  # noqa: ANN401 - unchecked
    """Return a table with a prefix before the names that the module defines."""
    if not isinstance(entry, dict):
        return entry
    changed = dict(entry)
    for where, key, kind in REFERENCES:
        if where == section and key in entry:
            value, known = entry[key], names[kind]
            if isinstance(value, list | tuple):
                changed[key] = [prefix + one if one in known else one for one in value]
            elif value in known:
                changed[key] = prefix + value
    return changed


def _knowing(entry: Any, prefix: str) -> Any:  # noqa: ANN401 - unchecked
    """Return the table of a program that is told its prefix."""
    if not (prefix and isinstance(entry, dict) and isinstance(entry.get("prefix", ""), str)):
        return entry
    return {**entry, "prefix": prefix + entry.get("prefix", "")}


def _patterns(trace: dict[str, Any], prefix: str) -> dict[str, Any]:
    """Return `[trace]` with patterns that match the signals of the module alone."""
    changed = dict(trace)
    if isinstance(trace.get("signals"), list | tuple):
        changed["signals"] = [_named(one, prefix) for one in trace["signals"]]
    if isinstance(trace.get("resolution"), dict):
        changed["resolution"] = {_named(one, prefix): value for one, value in trace["resolution"].items()}
    return changed


def _named(name: Any, prefix: str) -> Any:  # noqa: ANN401 - unchecked
    return prefix + name if isinstance(name, str) else name


def _rooted(flat: Flat) -> dict[KeyPath, Origin]:
    """Return origins that name everything which gets another path, not only what is above it."""
    paths: list[KeyPath] = [(section, name) for section in NAMED for name in table(flat.data, section)]
    paths += [("trace", "resolution", name) for name in table(table(flat.data, "trace"), "resolution")]
    return {path: flat.origin(path) for path in paths} | flat.origins


def _renamed(path: KeyPath, prefix: str) -> KeyPath:
    match path:
        case (section, str(name), *rest) if section in NAMED:
            return (section, prefix + name, *rest)
        case ("trace", "resolution", str(pattern), *rest):
            return ("trace", "resolution", prefix + pattern, *rest)
    return path
