"""The message files of a run: what the options change, and what is said about them at the end."""

from collections.abc import Iterator

import click

from motionlayer.cli._options import Options
from motionlayer.machine import LogDescription, Machine, MachineRun


def log_of(machine: Machine, options: Options) -> LogDescription | bool:
    """Return the table `[log]` with what the options say in its place."""
    table = machine.description.log
    changes = {"level": options.log_level} if options.log_level else {}
    if options.log is not None:
        changes["folder"] = str(options.log.absolute())
    if table is None and "folder" not in changes:
        if changes:
            raise click.UsageError(f"{options.machine} has no table [log], so nothing is written: give --log DIR")
        return False
    return LogDescription.model_validate({**(table.model_dump() if table is not None else {}), **changes})


def losses(run: MachineRun) -> Iterator[str]:
    """Yield what is missing in the message files."""
    if run.log.missing:
        reason = run.log.trouble or "the writer could not keep up; log less, or run slower"
        yield f"{run.log.missing} messages are missing in {run.log.folder} and are lost: {reason}"


def warn(run: MachineRun) -> None:
    """Tell of trouble that was overcome."""
    if run.log.trouble and not run.log.missing:
        text = f"messages could not be written into {run.log.folder} for a time, and nothing is missing"
        click.echo(f"Warning: {text}: {run.log.trouble}", err=True)
