"""`motionlayer export`."""

from pathlib import Path

import click

from motionlayer.cli._exit import ExitCode, Stop, say
from motionlayer.cli._options import machine_argument


@click.command(short_help="Write the declarations of Ctrl and State for the control side.")
@machine_argument
@click.option("--st", is_flag=True, help="Structured Text, as TwinCAT reads it.")
@click.option("--c", is_flag=True, help="A header for C11 and C++20.")
@click.option("--csharp", is_flag=True, help="C#.")
@click.option(
    "--out", type=click.Path(path_type=Path), metavar="FOLDER", help="Put the files into FOLDER.  [default: print them]"
)
def export(machine: Path, st: bool, c: bool, csharp: bool, out: Path | None) -> None:
    """Write the interface of the motion layer of MACHINE for the program that commands it.

    These are types with their pack modes, constants, and variables with the sizes of this machine.
    """
    if st + c + csharp != 1:
        raise click.UsageError("say which language: one of --st, --c, --csharp")
    if out is not None and not out.is_dir():
        raise Stop(ExitCode.OUTPUT, f"{out}: there is no such folder")
    from motionlayer.cli._files import load_machine  # noqa: PLC0415 - help does without them
    from motionlayer.iec import export as languages  # noqa: PLC0415
    from motionlayer.machine import interface  # noqa: PLC0415

    writer = languages.structured_text if st else languages.c_header if c else languages.csharp
    try:
        files = writer(interface(load_machine(machine)))
    except ValueError as error:
        raise Stop(ExitCode.FAILED, str(error)) from error
    if out is None:
        say("\n".join(files.values()).rstrip())
        return
    for name, text in files.items():
        _write(out / name, text)


def _write(path: Path, text: str) -> None:
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise Stop(ExitCode.OUTPUT, f"{path} cannot be written: {error.strerror}") from error
    say(f"written {path}")
