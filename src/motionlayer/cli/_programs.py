"""Programs of a command line: which they are, and the end of those that do not let themselves be ended."""

import contextlib
import os
import sys
from collections.abc import Sequence
from typing import NoReturn

from motionlayer.cli._exit import ExitCode, Stop, complain
from motionlayer.cli._failure import place
from motionlayer.machine import Loaded, Machine, ProgramError, Source, load_program, parse_source, sources_of


def chosen(machine: Machine, program: str | None) -> list[Source]:
    """Return the program that `--program` names, or those of the machine file where it names none."""
    return [parse_source(program)] if program else sources_of(machine)


def load(sources: Sequence[Source]) -> list[Loaded]:
    """Return the functions.

    Raises:
        Stop: one cannot be loaded; the message says where.
    """
    try:
        return [load_program(source) for source in sources]
    except ProgramError as error:
        raise Stop(ExitCode.FAILED, f"{error}{place(error.__cause__)}") from error


def give_up() -> NoReturn:
    """End the process: a program swallows every interrupt, so that nothing else ends it."""
    complain("a program does not yield and swallows interrupts (`except:` or `except BaseException`); ended here")
    with contextlib.suppress(OSError):
        sys.stdout.flush()
    os._exit(ExitCode.STUCK)
