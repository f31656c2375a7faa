"""Programs in files: from `FILE:NAME` to something that can be started."""

import functools
import hashlib
import importlib.util
import inspect
import sys
from collections.abc import Callable, Coroutine
from importlib.machinery import SOURCE_SUFFIXES, SourceFileLoader
from pathlib import Path
from types import CodeType
from typing import Any, NamedTuple, cast

from motionlayer.machine._machine import Machine
from motionlayer.runtime import MAIN, Program, Run, takes_memory


class ProgramError(ValueError):
    """A program cannot be loaded; the message says which and why."""


class Source(NamedTuple):
    """A program on disk, before it is loaded."""

    name: str
    file: Path
    function: str
    task: str | None = None
    prefix: str = ""


class Loaded(NamedTuple):
    """A program that can be started.

    Attributes:
        name: for messages.
        function: `async def f(run)`, or of a cyclic program `def f(run)` or `def f(run, memory)`.
        file: name of the file, without its folder.
        sha256: of the file.
        task: what calls a cyclic program, None of a coroutine.
        source: where it comes from.
    """

    name: str
    function: Callable[..., Coroutine[Any, Any, Any] | None]
    file: str
    sha256: str
    task: str | None = None
    source: Source | None = None

    def start(self, run: Run) -> Program:
        """Start it in a run.

        Raises:
            KeyError: the run has no such task.
        """
        if self.task is not None:
            return run.cyclic(cast("Callable[..., None]", self.function), task=self.task, name=self.name)
        return run.start(cast("Coroutine[Any, Any, Any]", self.function(run)), self.name)


def sources_of(machine: Machine) -> list[Source]:
    """Return the programs that the machine description names, in order."""
    programs = machine.description.program
    return [
        Source(name, machine.folder / entry.file, entry.function, entry.task, entry.prefix)
        for name, entry in programs.items()
    ]


def parse_source(text: str) -> Source:
    """Read `FILE[:NAME]` of the command line; NAME defaults to `main`."""
    file, colon, function = text.rpartition(":")
    if not colon or not function.isidentifier():
        file, function = text, "main"
    return Source(function if function != "main" else Path(file).stem, Path(file), function)


def load_program(source: Source) -> Loaded:
    """Import the file and find the function.

    Raises:
        ProgramError: no such file or function, not a function that can be a program, or an error while it was imported.
    """
    try:
        text = source.file.read_bytes()
    except OSError as error:
        raise ProgramError(f"program {source.name}: {source.file} cannot be read: {error.strerror}") from error
    module = _import(source, text)
    function = getattr(module, source.function, None)
    if function is None:
        known = [name for name, value in vars(module).items() if inspect.iscoroutinefunction(value)]
        offer = f"; it has {', '.join(known)}" if known else ""
        raise ProgramError(f"program {source.name}: {source.file} has no function {source.function!r}{offer}")
    function = _told(function, source.prefix)
    digest = hashlib.sha256(text).hexdigest()
    return Loaded(source.name, function, source.file.name, digest, _task(source, function), source)


def _told(function: Callable[..., Any], prefix: str) -> Callable[..., Any]:
    """Return a function that knows the prefix of its axes, if it asks for it."""
    try:
        asks = "prefix" in inspect.signature(function).parameters
    except (TypeError, ValueError):  # no function, or something built in: said when its task is looked for
        return function
    return functools.partial(function, prefix=prefix) if asks else function


def _task(source: Source, function: Callable[..., object]) -> str | None:
    """Return the task that calls a function, None of a coroutine function."""
    name, where = source.function, f"program {source.name}: {source.function!r} in {source.file}"
    coroutine = inspect.iscoroutinefunction(function)
    try:
        if coroutine:
            inspect.signature(function).bind(None)
        else:
            takes_memory(function)
    except (TypeError, ValueError) as error:  # ValueError: something built in, which shows no parameters
        forms = f"`async def {name}(run)`, `def {name}(run)` or `def {name}(run, memory)`"
        raise ProgramError(f"{where} must be {forms}") from error
    if coroutine and source.task is not None:
        raise ProgramError(f"{where} is a coroutine function, which no task calls; leave out task = {source.task!r}")
    return None if coroutine else source.task or MAIN


class _Loader(SourceFileLoader):
    """Loads the very text whose SHA-256 is recorded: cached bytecode may be that of a file changed within its second.

    Args:
        name: of the module.
        path: of the file.
        text: that it holds.
    """

    def __init__(self, name: str, path: str, text: bytes) -> None:
        super().__init__(name, path)
        self._text = text

    def get_code(self, fullname: str) -> CodeType:
        """Return what the module executes."""
        return self.source_to_code(self._text, self.get_filename(fullname))


def _import(source: Source, text: bytes) -> object:
    folder = str(source.file.resolve().parent)
    if folder not in sys.path:  # so that a program can import what lies beside it, as a script can
        sys.path.insert(0, folder)
    if source.file.suffix not in SOURCE_SUFFIXES:
        raise ProgramError(f"program {source.name}: {source.file} is not a Python file; its name must end in .py")
    name = f"motionlayer_program_{source.name}"
    loader = _Loader(name, str(source.file.absolute()), text)
    spec = importlib.util.spec_from_file_location(name, source.file, loader=loader)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    try:
        loader.exec_module(module)
    except (Exception, SystemExit) as error:
        raise ProgramError(f"program {source.name}: {source.file}: {type(error).__name__}: {error}") from error
    return module
