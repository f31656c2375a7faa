"""`motionlayer new`."""

import re
from pathlib import Path
from typing import Final

import click

from motionlayer.cli._exit import ExitCode, Stop, say

FILES: Final = ("machine.toml", "program.py")
"""What a new machine consists of; the templates have the same names."""

NAME_MARK: Final = "@NAME@"
"""What stands for the name in a template."""


def _plain(_context: click.Context, _argument: click.Parameter, name: str) -> str:
    """Return a name that is good for a folder everywhere."""
    if not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_-]*", name):
        raise click.BadParameter(f"{name!r} must be letters, digits, - and _; where it goes is said by --folder")
    return name


@click.command(short_help="Begin a machine: a machine file and a program, with comments.")
@click.argument("name", callback=_plain)
@click.option(
    "--folder",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path(),
    metavar="FOLDER",
    help="Where the folder NAME is put.  [default: here]",
)
def new(name: str, folder: Path) -> None:
    """Make a folder NAME with a machine that runs at once; nothing is overwritten."""
    from importlib.resources import files  # noqa: PLC0415 - help does without it

    templates = files("motionlayer.cli") / "templates"
    target = folder / name
    taken = [target / file for file in FILES if (target / file).exists()]
    if taken:
        raise Stop(ExitCode.USAGE, f"{taken[0]} is there already and stays as it is; take another name or --folder")
    try:
        target.mkdir(parents=True, exist_ok=True)
        for file in FILES:
            text = (templates / file).read_text(encoding="utf-8").replace(NAME_MARK, name)
            with (target / file).open("x", encoding="utf-8") as stream:
                stream.write(text)
            say(f"created {target / file}")
    except OSError as error:
        raise Stop(ExitCode.OUTPUT, f"{error.filename or target} cannot be written: {error.strerror}") from error
    say(f"run it with: motionlayer run {target / FILES[0]}")
