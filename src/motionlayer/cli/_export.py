"""`motionlayer export`."""

from collections import Counter
from pathlib import Path

import click

from motionlayer.cli._exit import ExitCode, Stop, say
from motionlayer.cli._options import machine_argument


@click.command(short_help="Write the declarations of Ctrl and State for the control side.")
@machine_argument
@click.option("--st", is_flag=True, help="Structured Text; with --out a TwinCAT 3 object per file.")
@click.option("--c", is_flag=True, help="A header for C11 and C++20.")
@click.option("--csharp", is_flag=True, help="C#.")
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    metavar="FOLDER",
    help="Put the files into FOLDER, which is made where it is missing.  [default: print them]",
)
def export(machine: Path, st: bool, c: bool, csharp: bool, out: Path | None) -> None:
    """Write the interface of the motion layer of MACHINE for the program that commands it.

    These are types with their pack modes, constants, and variables with the sizes of this machine. The programs of
    MACHINE run for one tick, in which they may declare namespaces of their own; these are declared too.
    """
    if not (st or c or csharp):
        raise click.UsageError("say which language: --st, --c, --csharp; with --out more than one of them")
    if out is None and st + c + csharp > 1:
        raise click.UsageError("several languages cannot be printed as one: choose one, or give --out FOLDER")
    from motionlayer.cli._first_tick import first_tick  # noqa: PLC0415 - help does without them
    from motionlayer.iec import export as languages  # noqa: PLC0415
    from motionlayer.machine import interface  # noqa: PLC0415

    structured = languages.structured_text if out is None else languages.twincat
    writers = [(st, structured), (c, languages.c_header), (csharp, languages.csharp)]
    try:
        with first_tick(machine) as run:
            told = interface(run)
            files = {name: text for asked, write in writers if asked for name, text in write(told).items()}
    except ValueError as error:
        raise Stop(ExitCode.FAILED, str(error)) from error
    if out is None:
        say("\n".join(files.values()).rstrip())
        return
    for name, text in files.items():
        _write(out / name, text)
    for folder, count in Counter((out / name).parent for name in files).items():
        say(f"written {folder}: {count} file{'s' if count > 1 else ''}")


def _write(path: Path, text: str) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise Stop(ExitCode.OUTPUT, f"{path} cannot be written: {error.strerror}") from error
