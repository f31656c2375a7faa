"""Machine file → checked description, or every problem at once."""

import os
import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NoReturn

from pydantic import ValidationError

from motionlayer.machine._description import Description
from motionlayer.machine._errors import Finding, MachineError
from motionlayer.machine._locate import line_of, locate, statement_start
from motionlayer.machine._problem import KeyPath, Problem, field_text
from motionlayer.machine._relations import format_problem, relation_problems
from motionlayer.machine._words import model_problems

_POSITION = re.compile(r"(?P<message>.*?) \(at (?:line (?P<line>\d+), column \d+|end of document)\)", re.DOTALL)
_TWICE = ("Cannot declare", "Cannot overwrite", "Cannot mutate", "Duplicate inline table key")


def load_description(path: str | os.PathLike[str]) -> Description:
    """Read and check a machine file.

    Args:
        path: the TOML file; program files in it are relative to its folder.

    Returns:
        The description, with all defaults filled in.

    Raises:
        MachineError: the file cannot be read, is not TOML, or describes no valid machine; names every problem
            with its line.
    """
    file = os.fspath(path)
    text = _read(file)
    data = _parse(text, file)
    problems, description = _check(data, Path(file).parent)
    if description is None:
        _refuse(problems, file, locate(text))
    return description


def check_description(data: dict[str, Any], *, file: str | os.PathLike[str] | None = None) -> Description:
    """Check a machine description given as data, such as `tomllib` would read it.

    Args:
        data: the top table.
        file: the machine file to name in messages; program files are relative to its folder, without a file
            to the working directory.

    Returns:
        The description, with all defaults filled in.

    Raises:
        MachineError: the data describes no valid machine; names every problem, without lines.
    """
    name = None if file is None else os.fspath(file)
    problems, description = _check(data, Path(name or "").parent)
    if description is None:
        _refuse(problems, name, {})
    return description


def _check(data: dict[str, Any], folder: Path) -> tuple[list[Problem], Description | None]:
    """Return all problems, or none and the description."""
    wrong_format = format_problem(data)
    if wrong_format and wrong_format.value is not None:
        # Of another format nothing else can be said.
        return [wrong_format], None
    problems = [wrong_format] if wrong_format else []
    description = None
    try:
        description = Description.model_validate(data)
    except ValidationError as error:
        errors = error.errors(include_url=False)
        problems += model_problems(one for one in errors if one["loc"] != ("format",))
    problems += relation_problems(data, folder)
    return problems, None if problems else description


def _refuse(problems: Iterable[Problem], file: str | None, lines: Mapping[KeyPath, int]) -> NoReturn:
    """Raise all problems, in the order of the file."""
    findings = [
        Finding(
            file=file,
            line=line_of(one.path, lines),
            field=field_text(one.path),
            value=one.value,
            allowed=one.allowed,
            hint=one.hint,
            problem=one.problem,
        )
        for one in problems
    ]
    raise MachineError(sorted(findings, key=lambda finding: finding.line or 0))


def _read(file: str) -> str:
    try:
        content = Path(file).read_bytes()
    except FileNotFoundError:
        _refuse_file(file, "no such file")
    except IsADirectoryError:
        _refuse_file(file, "a folder, not a machine file")
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else None
        _refuse_file(file, f"cannot be read: {(reason or str(error)).lower()}")
    try:
        return content.decode("utf-8-sig")  # editors on Windows like to put a mark first
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        _refuse_file(file, "not UTF-8 text, as TOML must be", line, "save the file as UTF-8")


def _parse(text: str, file: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except RecursionError:
        _refuse_file(file, "not valid TOML: nested too deeply")
    except ValueError as error:  # TOMLDecodeError, and from int() for too many digits
        found = _POSITION.fullmatch(str(error))
        message = found["message"] if found else str(error)
        known = int(found["line"]) if found and found["line"] else None
        if message.startswith(_TWICE):
            line = statement_start(text, known or 1)
            _refuse_file(file, "this key or table is already defined above", line)
        # At the end of the text only the begin of what was never closed tells where to look.
        line = known or statement_start(text, text.count("\n") + 1)
        _refuse_file(file, f"not valid TOML: {message[:1].lower()}{message[1:]}", line)


def _refuse_file(file: str, problem: str, line: int | None = None, hint: str = "") -> NoReturn:
    raise MachineError([Finding(file, line, "", None, "", hint, problem)]) from None
