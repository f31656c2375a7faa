"""Machine file → checked description, or every problem at once."""

import os
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from pydantic import ValidationError

from motionlayer.machine._description import Description
from motionlayer.machine._doubts import doubts
from motionlayer.machine._errors import Finding, MachineError, OldName
from motionlayer.machine._fragment import Fragment, Origin, Report, in_order
from motionlayer.machine._modules import flattened
from motionlayer.machine._names import SECTIONS
from motionlayer.machine._problem import Problem
from motionlayer.machine._read import parse, read_text
from motionlayer.machine._relations import format_problem, relation_problems
from motionlayer.machine._units import in_units
from motionlayer.machine._words import model_problems

_MODULE_HINT: Final = (
    "a module has no name, and is checked together with the machine that includes it: motionlayer check MACHINE"
)


def load_description(path: str | os.PathLike[str]) -> Description:
    """Read and check a machine file, with the modules that it includes.

    Args:
        path: the TOML file; program and module files in it are relative to its folder.

    Returns:
        The description, with all defaults filled in, without modules: what they hold is part of it.

    Raises:
        MachineError: a file cannot be read, is not TOML, or describes no valid machine; names every problem
            with its line.

    Warns:
        OldName: a key has another name now, and the next version does not read the old one.
    """
    file = os.fspath(path)
    text = read_text(file)
    return _checked(Fragment(file, parse(text, file), text))


def check_description(data: dict[str, Any], *, file: str | os.PathLike[str] | None = None) -> Description:
    """Check a machine description given as data, such as `tomllib` would read it.

    Args:
        data: the top table.
        file: the machine file to name in messages; program and module files are relative to its folder, without a
            file to the working directory.

    Returns:
        The description, with all defaults filled in, without modules: what they hold is part of it.

    Raises:
        MachineError: the data describes no valid machine; names every problem, without lines.

    Warns:
        OldName: a key has another name now, and the next version does not read the old one.
    """
    return _checked(Fragment(None if file is None else os.fspath(file), data))


def doubtful(path: str | os.PathLike[str]) -> list[Finding]:
    """Return what a machine file may say, and what can hardly be meant, in the order of the files.

    Args:
        path: a machine file that `load_description` takes.

    Raises:
        MachineError: it does not.
    """
    file = os.fspath(path)
    text = read_text(file)
    fragment, report = Fragment(file, parse(text, file), text), Report()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OldName)  # said when the file was loaded
        description = _checked(fragment)
    flat = flattened(fragment, report)
    found = [in_units(one, flat.data) for one in doubts(description)]
    return in_order([flat.origin(one.path).finding(one) for one in found], file)


def _checked(fragment: Fragment) -> Description:
    """Return the description; raise all problems, in the order of the files."""
    report = Report()
    wrong_format = format_problem(fragment.data)
    description = None
    if wrong_format is not None:
        report.findings.append(Origin(fragment, wrong_format.path).finding(wrong_format))
    # Of another format nothing else can be said.
    if wrong_format is None or wrong_format.value is None:
        flat = flattened(fragment, report)
        if not report.unread:
            problems, description = _check(flat.data, fragment.folder)
            problems = [in_units(one, flat.data) for one in problems]
            report.findings += [flat.origin(one.path).finding(one) for one in problems]
    if report.findings or description is None:
        raise MachineError(in_order(report.findings, fragment.file))
    for one in in_order(report.warnings, fragment.file):
        warnings.warn(str(one), OldName, stacklevel=4)
    return description


def _check(data: dict[str, Any], folder: Path) -> tuple[list[Problem], Description | None]:
    """Return all problems of flat tables but those of the format, and the description if the models take it."""
    problems: list[Problem] = []
    description = None
    try:
        description = Description.model_validate(data)
    except ValidationError as error:
        errors = error.errors(include_url=False)
        problems += model_problems(one for one in errors if one["loc"] != ("format",))
    problems += relation_problems(data, folder)
    return [replace(one, hint=_MODULE_HINT) if _of_a_module(one, data) else one for one in problems], description


def _of_a_module(problem: Problem, data: dict[str, Any]) -> bool:
    """Tell whether a name is missing because the file may be a module: it holds nothing but what a module may."""
    return problem.path == ("name",) and problem.problem == "missing" and {*data} <= {"format", *SECTIONS}
