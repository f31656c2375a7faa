"""Files that commands read and write; each error becomes a `Stop` with its exit code."""

import warnings
from collections.abc import Iterable
from pathlib import Path

import click

from motionlayer.cli._exit import ExitCode, Stop
from motionlayer.machine import Machine, MachineError, OldName
from motionlayer.record import Trace, TraceError


def load_machine(path: Path) -> Machine:
    """Read and check a machine file; names that it should not use any more are warnings."""
    try:
        with warnings.catch_warnings(record=True) as old:
            warnings.simplefilter("always", OldName)
            machine = Machine.load(path)
    except MachineError as error:
        count = len(error.findings)
        problems = f"{count} problems" if count > 1 else "a problem"
        raise Stop(ExitCode.FAILED, f"{problems} in the machine file\n{error}") from error
    for one in old:
        click.echo(f"Warning: {one.message}", err=True)
    return machine


def load_trace(path: Path) -> Trace:
    """Read a trace."""
    try:
        return Trace.load(path)
    except TraceError as error:
        raise Stop(ExitCode.OUTPUT, str(error)) from error


def draw(trace: Trace, page: Path) -> None:
    """Draw a trace into a page."""
    from motionlayer.record.plot import write_page  # noqa: PLC0415 - only those who draw pay for it

    try:
        write_page(trace, page)
    except TraceError as error:
        raise Stop(ExitCode.OUTPUT, str(error)) from error


def refuse_overwriting(outputs: Iterable[Path | None], inputs: Iterable[Path]) -> None:
    """Refuse to write to a file that is read, or twice to the same one, or a page where there is no folder."""
    taken = {path.resolve() for path in inputs}
    for output in outputs:
        if output is None:
            continue
        if output.resolve() in taken:
            raise click.UsageError(f"{output} would be overwritten; name another file")
        taken.add(output.resolve())
        if not output.parent.is_dir():
            raise Stop(ExitCode.OUTPUT, f"{output} cannot be written: there is no folder {output.parent}")
        if output.is_dir():
            raise Stop(ExitCode.OUTPUT, f"{output} cannot be written: it is a folder")
