"""How a command ends: `ExitCode`, `Stop` to end with one, and what it says on stdout and stderr."""

import enum
from typing import Self

import click


class ExitCode(enum.IntEnum):
    """Exit codes of all commands; `meaning` is what `motionlayer --help` says about each."""

    meaning: str

    def __new__(cls, value: int, meaning: str) -> Self:
        member = int.__new__(cls, value)
        member._value_ = value
        member.meaning = meaning
        return member

    OK = 0, "fine"
    FAILED = 1, "a program failed or cannot be loaded; the machine or the trace is not valid"
    USAGE = 2, "the command line or an environment variable is wrong"
    STUCK = 3, "a program did not yield; the run was ended"
    FAULT = 4, "a fault of motionlayer itself; please report it"
    OUTPUT = 5, "a trace, a page or another output cannot be read, judged or written; a server cannot begin"
    HUNG_UP = 129, "the terminal was closed (SIGHUP)"
    INTERRUPTED = 130, "interrupted (Ctrl-C)"
    TERMINATED = 143, "terminated (SIGTERM)"


class Stop(Exception):  # noqa: N818 - not every end is an error
    """End the command with an exit code, and with a message on stderr."""

    def __init__(self, code: ExitCode, message: str) -> None:
        super().__init__(message)
        self.code = code


def say(text: str) -> None:
    """Write a result to stdout.

    Raises:
        Stop: stdout is a file that cannot be written, on a full disk for one.
        BrokenPipeError: nobody reads it any more; click ends the command without a word.
    """
    try:
        click.echo(text)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise Stop(ExitCode.OUTPUT, f"stdout cannot be written: {error.strerror}; redirect it elsewhere") from error


def complain(message: str) -> None:
    """Write an error to stderr."""
    click.echo(f"Error: {message}", err=True)


def exit_codes() -> str:
    """Return the table for the help, kept from being wrapped."""
    return "\b\nExit codes:\n" + "\n".join(f"  {code:>3}  {code.meaning}" for code in ExitCode)
