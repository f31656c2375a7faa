"""`motionlayer check`."""

from pathlib import Path

import click

from motionlayer.cli._exit import say
from motionlayer.cli._options import machine_argument


@click.command(short_help="Check a machine file.")
@machine_argument
def check(machine: Path) -> None:
    """Check the file MACHINE completely; nothing runs.

    Every problem is named with file, line, field, value and what is allowed. What is valid and can hardly be meant is a
    warning.
    """
    from motionlayer.cli._files import load_machine  # noqa: PLC0415 - help does without it
    from motionlayer.machine import doubtful  # noqa: PLC0415

    description = load_machine(machine).description
    for one in doubtful(machine):
        click.echo(f"Warning: {one}", err=True)
    axes, programs = list(description.axis), list(description.program)
    say(f"{machine}: valid: {description.name}, axes: {_names(axes)}; programs: {_names(programs)}")


def _names(names: list[str]) -> str:
    return ", ".join(names) or "none"
