"""From the header of a trace back to the machine and the programs that were recorded."""

import hashlib
import inspect
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

from motionlayer.machine._errors import MachineError
from motionlayer.machine._load import check_description
from motionlayer.machine._machine import Machine
from motionlayer.machine._programs import Loaded, Source, load_program
from motionlayer.record import Trace
from motionlayer.runtime import MAIN

_DIGITS: Final = 12
"""Of a SHA-256 that is shown."""


class ReplayError(ValueError):
    """A trace cannot be replayed; the text says why, and the way out."""


class Recorded(NamedTuple):
    """What a trace was recorded with, made anew.

    Attributes:
        machine: checked, without programs.
        programs: in the order in which they were started.
        notes: what may make the replay another one, in words.
    """

    machine: Machine
    programs: list[Loaded]
    notes: list[str]


def machine_of(trace: Trace) -> Machine:
    """Return the machine of a trace, without its programs: their files need not be where they were.

    Raises:
        ReplayError: the header holds no valid machine.
    """
    description = trace.header.get("machine")
    if not isinstance(description, dict):
        raise ReplayError(
            "the header of the trace holds no machine: only a trace of `motionlayer run` or a run can run"
        )
    # A machine file has no null: what is left out there is None in a description.
    given = _without_nulls({**description, "program": {}})
    try:
        return Machine(check_description(given), Path())
    except MachineError as error:
        by = trace.header.get("product", "another version")
        raise ReplayError(
            f"the machine in the trace is none for this version; replay it with {by}:\n{error}"
        ) from error


def _without_nulls(value: Any) -> Any:  # noqa: ANN401 - whatever JSON holds
    if isinstance(value, dict):
        return {key: _without_nulls(one) for key, one in value.items() if one is not None}
    return [_without_nulls(one) for one in value] if isinstance(value, list) else value


def function_program(function: Callable[..., Any]) -> Loaded:
    """Return a program that is a function: `async def f(run)`, `def f(run)` or `def f(run, memory)`."""
    task = None if inspect.iscoroutinefunction(function) else MAIN
    return Loaded(function.__name__, function, "", "", task)


def load_recorded(trace: Trace, folder: Path, instead: Sequence[Source] = ()) -> tuple[list[Loaded], list[str]]:
    """Load the programs that a trace names.

    A file is looked for where it was, and in the folder of the trace; one with the recorded SHA-256 comes first.

    Args:
        trace: names them.
        folder: of the trace.
        instead: files that stand in for the recorded ones of the same name; a single one for a single program,
            whatever its name. Of a trace without programs these are the programs.

    Returns:
        The programs, and what has to be said about them.

    Raises:
        ProgramError: a file is no program.
        ReplayError: a file is not found, or one stands in for nothing.
    """
    entries = trace.header.get("programs", [])
    if not entries:
        return [load_program(source) for source in instead], []
    used = _stand_ins(entries, instead)
    loaded, notes = [], []
    for entry, source in zip(entries, used, strict=True):
        program = load_program(source if source is not None else _found(entry, folder))
        loaded.append(program)
        if program.sha256 != entry["sha256"]:
            where = program.source.file if program.source is not None else program.file
            notes.append(
                f"program {entry['name']}: {where} is not the file that was recorded (SHA-256 "
                f"{program.sha256[:_DIGITS]}…, recorded {entry['sha256'][:_DIGITS]}…); the hash may differ"
            )
        if source is not None and source.function != entry.get("function"):
            notes.append(f"program {entry['name']}: {source.function} runs, recorded was {entry.get('function')}")
    return loaded, notes


def _stand_ins(entries: Sequence[dict[str, Any]], instead: Sequence[Source]) -> list[Source | None]:
    """Return for each recorded program the source that was given for it, if any."""
    single = len(entries) == len(instead) == 1
    found: list[Source | None] = [None] * len(entries)
    for source in instead:
        fitting = [index for index, entry in enumerate(entries) if single or entry["file"] == source.file.name]
        if not fitting:
            names = ", ".join(f"{entry['name']} ({entry['file'] or 'a function'})" for entry in entries)
            raise ReplayError(f"{source.file} stands in for no program of the trace; it has {names}")
        for index in fitting:
            function = source.function if single else entries[index]["function"]
            found[index] = _source(entries[index], source.file, function)
    return found


def _source(entry: dict[str, Any], file: Path, function: str) -> Source:
    return Source(entry["name"], file, function, entry.get("task"), entry.get("prefix", ""))


def _found(entry: dict[str, Any], folder: Path) -> Source:
    """Return where a program is now.

    Raises:
        ReplayError: nowhere.
    """
    if "path" not in entry:
        raise ReplayError(
            f"program {entry['name']} was no file but a function of a script: "
            "give it in `replay(trace, programs=[...])`, or a file that holds it with --program FILE:NAME"
        )
    places = list(dict.fromkeys([Path(entry["path"]), (folder / entry["file"]).resolve()]))
    here = [place for place in places if place.is_file()]
    if not here:
        where = " or ".join(str(place) for place in places)
        raise ReplayError(f"program {entry['name']}: no file {where}; give it with --program FILE")
    same = (place for place in here if hashlib.sha256(place.read_bytes()).hexdigest() == entry["sha256"])
    return _source(entry, next(same, here[0]), entry["function"])


def installation_notes(recorded: dict[str, Any], here: dict[str, Any]) -> Iterable[str]:
    """Yield what is different on this computer, of the headers of two traces."""
    before = {"motionlayer": recorded.get("product"), **recorded.get("installation", {})}
    now = {"motionlayer": here["product"], **here["installation"]}
    other = [f"{name} {before.get(name)} (here {value})" for name, value in now.items() if before.get(name) != value]
    if other:
        yield f"recorded with {', '.join(other)}: the same bits are promised on one installation only"
