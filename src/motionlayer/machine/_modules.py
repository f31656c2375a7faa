"""Modules: files that are put into a machine file, several times if need be, each time with a prefix.

The outcome is one description in which nothing tells of modules any more; it is what is checked, built, and kept in
the header of a trace. `Flat` remembers for every part of it which line of which file it came from.
"""

import difflib
import os
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from motionlayer.machine._data import table
from motionlayer.machine._description import Description
from motionlayer.machine._errors import MachineError
from motionlayer.machine._fragment import Flat, Fragment, Origin, Report
from motionlayer.machine._merge import merge
from motionlayer.machine._module_description import ModuleDescription
from motionlayer.machine._names import SECTIONS, prefixed
from motionlayer.machine._overrides import override
from motionlayer.machine._problem import KeyPath, Problem, value_text
from motionlayer.machine._read import parse, read_text
from motionlayer.machine._relations import format_problem
from motionlayer.machine._renamed import modern
from motionlayer.machine._words import table_problems


def flattened(fragment: Fragment, report: Report, chain: tuple[str, ...] = ()) -> Flat:
    """Return the tables of a file with those of its modules put in.

    Args:
        fragment: the file.
        report: gets every problem and warning.
        chain: the files that are being included, to find one that includes itself.
    """
    flat = modern(fragment, report)
    if "module" not in flat.data:
        return flat
    entries = flat.data["module"]
    flat.data = {key: value for key, value in flat.data.items() if key != "module"}
    if not isinstance(entries, list | tuple):
        problem = Problem(("module",), value_text(entries), "a list of tables, each under [[module]]")
        report.findings.append(flat.origin(("module",)).finding(problem))
        report.unread = True
        return flat
    for index, entry in enumerate(entries):
        module = _module(flat.origin(("module", index)), entry, report, (*chain, _identity(fragment)))
        if module is not None:
            merge(flat, module, report)
    return flat


def _module(origin: Origin, entry: object, report: Report, chain: tuple[str, ...]) -> Flat | None:
    """Return the tables of one `[[module]]`, or None if there is no reading it."""
    try:
        asked = ModuleDescription.model_validate(entry)
    except ValidationError as error:
        for problem in table_problems(error, ("module", 0)):
            _refuse(origin, report, replace(problem, path=problem.path[2:]))
        report.unread = True
        return None
    fragment = _read(origin, asked, report, chain)
    if fragment is None:
        report.unread = True
        return None
    flat = flattened(fragment, report, chain)
    for problem in _foreign(flat.data):
        report.findings.append(flat.origin(problem.path).finding(problem))
    for key, value in asked.set.items():
        override(flat, key, value, Origin(origin.fragment, (*origin.path, "set", key)), report)
    _relocate(flat, Path(asked.file).parent)
    return prefixed(flat, asked.prefix)


def _read(origin: Origin, asked: ModuleDescription, report: Report, chain: tuple[str, ...]) -> Fragment | None:
    """Return a module file; what is wrong with its place is reported there, what is wrong in it, in itself."""
    at = f'{origin.place} as "{asked.prefix}"' if asked.prefix else origin.place
    file = str(origin.fragment.folder / asked.file)
    empty = Fragment(file, {}, included=(at, *origin.fragment.included), prefix=origin.fragment.prefix + asked.prefix)
    problem = _place_problem(empty, chain)
    if problem:
        _refuse(origin, report, Problem(("file",), value_text(asked.file), problem=problem))
        return None
    try:
        text = read_text(file)
        fragment = replace(empty, data=parse(text, file), text=text)
    except MachineError as error:
        report.findings += [replace(one, included=empty.chain) for one in error.findings]
        return None
    wrong_format = format_problem(fragment.data)
    if wrong_format is not None:
        report.findings.append(Origin(fragment, wrong_format.path).finding(wrong_format))
    return fragment if wrong_format is None or wrong_format.value is None else None


def _place_problem(fragment: Fragment, chain: tuple[str, ...]) -> str:
    """Return why a file cannot be a module here, empty if nothing is known against it."""
    assert fragment.file is not None
    if not os.path.isfile(fragment.file):  # noqa: PTH113 - pathlib raises for a name that is too long
        return f"no such file in the folder {value_text(str(fragment.folder))}"
    identity = _identity(fragment)
    if identity in chain:
        names = [Path(one).name for one in (*chain[chain.index(identity) :], identity)]
        return "includes itself: " + " → ".join(names)
    return ""


def _refuse(origin: Origin, report: Report, problem: Problem) -> None:
    """Report a problem whose path begins at `[[module]]`."""
    report.findings.append(Origin(origin.fragment, (*origin.path, *problem.path)).finding(problem))


def _identity(fragment: Fragment) -> str:
    return os.path.realpath(fragment.file) if fragment.file is not None else ""


def _foreign(data: dict[str, Any]) -> Iterator[Problem]:
    """Yield what a module may not hold."""
    known = [*SECTIONS, "format", "module"]
    for key in data:
        path: KeyPath = (key,)
        if key in Description.model_fields and key not in known:
            yield Problem(path, problem="not in a module", hint="the machine file says this once for all")
        elif key not in known:
            near = difflib.get_close_matches(str(key), known, n=1)
            hint = f"did you mean {near[0]}?" if near else "known keys: " + ", ".join(known)
            yield Problem(path, problem="unknown key", hint=hint)


def _relocate(flat: Flat, folder: Path) -> None:
    """Let program files start from the folder of the file that includes; `folder` is seen from there."""
    programs: dict[str, object] = table(flat.data, "program")
    for name, entry in programs.items():
        if isinstance(entry, dict) and isinstance(entry.get("file"), str) and entry["file"]:
            programs[name] = {**entry, "file": (folder / entry["file"]).as_posix()}
    if programs:
        flat.data = {**flat.data, "program": programs}
