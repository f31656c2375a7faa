"""What spans several tables or lies outside the file: axis names, patterns, search velocity, programs.

The checks read the data as it came, beside the models and not after them, so that one wrong number does not
hide the other problems. What has the wrong type is left to the models.
"""

import difflib
import re
from collections.abc import Iterable, Iterator
from fnmatch import fnmatchcase
from pathlib import Path

from motionlayer.machine._data import number, table
from motionlayer.machine._description import FORMATS, IDENTIFIER, SIGNALS
from motionlayer.machine._drive_relations import drive_problems
from motionlayer.machine._layer_relations import layer_problems
from motionlayer.machine._problem import Problem, field_text, value_text
from motionlayer.machine._program_file import function_problem
from motionlayer.machine._task_relations import task_problems

_FORMATS = ", ".join(str(number) for number in FORMATS)


def format_problem(data: object) -> Problem | None:
    """Return what is wrong with the format number."""
    hint = f"formats understood: {_FORMATS}"
    if not isinstance(data, dict):
        return None
    if "format" not in data:
        return Problem(("format",), problem="missing", hint=hint)
    number = data["format"]
    # Not `in FORMATS` alone: true and 1.0 equal 1.
    if type(number) is int and number in FORMATS:
        return None
    return Problem(("format",), value_text(number), problem="not a format this version understands", hint=hint)


def relation_problems(data: object, folder: Path) -> Iterator[Problem]:
    """Yield what is wrong between tables; program files are looked for in `folder`."""
    axes = table(data, "axis")
    yield from _name_problems(axes)
    for name, axis in axes.items():
        yield from _search_velocity_problems(name, axis)
    yield from drive_problems(data)
    yield from layer_problems(data)
    yield from task_problems(data)
    yield from _pattern_problems(table(data, "trace"), axes)
    for name, program in table(data, "program").items():
        yield from _file_problems(name, program, folder)


def _name_problems(names: Iterable[str]) -> Iterator[Problem]:
    first: dict[str, str] = {}
    for name in names:
        if not re.fullmatch(IDENTIFIER, name):
            allowed = "letters, digits and single underscores, not beginning with a digit"
            yield Problem(("axis", name), problem="not a name of an axis", allowed=allowed)
        other = first.setdefault(name.upper(), name)
        if other != name:
            yield Problem(
                ("axis", name),
                problem=f"differs from {field_text(('axis', other))} only in upper and lower case",
            )


def _search_velocity_problems(name: str, axis: object) -> Iterator[Problem]:
    velocity = number(table(axis, "home"), "velocity")
    maximum = number(axis, "max_velocity")
    if velocity is not None and maximum is not None and velocity > maximum > 0:
        allowed = f"at most max_velocity = {value_text(maximum)} (u/s)"
        yield Problem(("axis", name, "home", "velocity"), value_text(velocity), allowed)


def _pattern_problems(trace: dict[str, object], axes: Iterable[str]) -> Iterator[Problem]:
    names = [f"{axis}.{signal}" for axis in axes for signal in SIGNALS]
    if not names:  # then the missing axis is the problem
        return
    signals = trace.get("signals")
    for index, pattern in enumerate(signals if isinstance(signals, list | tuple) else []):
        if isinstance(pattern, str) and not _matches(pattern, names):
            yield Problem(
                ("trace", "signals", index),
                value_text(pattern),
                problem="matches no signal",
                hint=_pattern_hint(pattern, names),
            )
    for pattern in table(trace, "resolution"):
        if not _matches(pattern, names):
            path = ("trace", "resolution", pattern)
            yield Problem(path, problem="matches no signal", hint=_pattern_hint(pattern, names))


def _matches(pattern: str, names: list[str]) -> bool:
    return any(fnmatchcase(name, pattern) for name in names)


def _pattern_hint(pattern: str, names: list[str]) -> str:
    near = difflib.get_close_matches(pattern, names, n=1)
    if near:
        return f"did you mean {near[0]}?"
    return "signals are <axis>.<signal>, with " + ", ".join(SIGNALS)


def _file_problems(name: str, program: object, folder: Path) -> Iterator[Problem]:
    file = program.get("file") if isinstance(program, dict) else None
    if not isinstance(program, dict) or not isinstance(file, str) or not file:
        return
    try:
        exists, is_file = (folder / file).exists(), (folder / file).is_file()
    except (OSError, ValueError):  # no right to look, too long, a NUL inside
        exists = is_file = False
    if not is_file:
        problem = "not a file" if exists else f"no such file in the folder {value_text(str((folder / file).parent))}"
        yield Problem(("program", name, "file"), value_text(file), problem=problem)
        return
    function = program.get("function", "main")
    if isinstance(function, str) and function.isidentifier():
        found = function_problem(folder / file, function, cyclic_only="task" in program)
        if found is not None:
            field, problem, hint = found
            value = value_text(program.get(field, function))
            yield Problem(("program", name, field), value, problem=problem, hint=hint)
