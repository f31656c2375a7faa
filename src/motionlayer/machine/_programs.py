"""Programs in files: from `FILE:NAME` to something that can be started."""

import hashlib
import importlib.util
import inspect
import sys
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any, NamedTuple

from motionlayer.machine._machine import Machine


class ProgramError(ValueError):
    """A program cannot be loaded; the message says which and why."""


class Source(NamedTuple):
    """A program on disk, before it is loaded."""

    name: str
    file: Path
    function: str


class Loaded(NamedTuple):
    """A program that can be started: `function(run)` gives the coroutine."""

    name: str
    function: Callable[[Any], Coroutine[Any, Any, Any]]
    file: str
    sha256: str


def sources_of(machine: Machine) -> list[Source]:
    """Return the programs that the machine description names, in order."""
    programs = machine.description.program
    return [Source(name, machine.folder / entry.file, entry.function) for name, entry in programs.items()]


def parse_source(text: str) -> Source:
    """Read `FILE[:NAME]` of the command line; NAME defaults to `main`."""
    file, colon, function = text.rpartition(":")
    if not colon or not function.isidentifier():
        file, function = text, "main"
    return Source(function if function != "main" else Path(file).stem, Path(file), function)


def load_program(source: Source) -> Loaded:
    """Import the file and find the function.

    Raises:
        ProgramError: no such file or function, not a coroutine function, or an error while it was imported.
    """
    try:
        text = source.file.read_bytes()
    except OSError as error:
        raise ProgramError(f"program {source.name}: {source.file} cannot be read: {error.strerror}") from error
    module = _import(source)
    function = getattr(module, source.function, None)
    if function is None:
        known = [name for name, value in vars(module).items() if inspect.iscoroutinefunction(value)]
        offer = f"; it has {', '.join(known)}" if known else ""
        raise ProgramError(f"program {source.name}: {source.file} has no function {source.function!r}{offer}")
    if not inspect.iscoroutinefunction(function) or not _takes_the_run(function):
        raise ProgramError(
            f"program {source.name}: {source.function!r} in {source.file} must be `async def {source.function}(run)`"
        )
    return Loaded(source.name, function, source.file.name, hashlib.sha256(text).hexdigest())


def _takes_the_run(function: Callable[..., object]) -> bool:
    try:
        inspect.signature(function).bind(None)
    except TypeError:
        return False
    return True


def _import(source: Source) -> object:
    folder = str(source.file.resolve().parent)
    if folder not in sys.path:  # so that a program can import what lies beside it, as a script can
        sys.path.insert(0, folder)
    spec = importlib.util.spec_from_file_location(f"motionlayer_program_{source.name}", source.file)
    if spec is None or spec.loader is None:
        raise ProgramError(f"program {source.name}: {source.file} is not a Python file; its name must end in .py")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:
        raise ProgramError(f"program {source.name}: {source.file}: {type(error).__name__}: {error}") from error
    return module
