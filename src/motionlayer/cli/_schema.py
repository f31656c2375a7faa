"""`motionlayer schema`."""

import json
from pathlib import Path

import click

from motionlayer.cli._exit import ExitCode, Stop, say
from motionlayer.cli._options import json_file


@click.command(short_help="Write the JSON schema of the machine file, for editors.")
@click.option("--module", is_flag=True, help="The schema of a module file.")
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    callback=json_file("a schema"),
    metavar="FILE",
    help="Write it to FILE (.json).",
)
def schema(module: bool, out: Path | None) -> None:
    """Print the JSON schema (draft 2020-12) of the machine file.

    An editor that knows it completes keys, shows units and ranges, and marks mistakes while you type.
    """
    from motionlayer.cli._files import refuse_overwriting  # noqa: PLC0415 - help does without them
    from motionlayer.machine import machine_schema, module_schema  # noqa: PLC0415

    refuse_overwriting([out], [])

    text = json.dumps(module_schema() if module else machine_schema(), indent=2, ensure_ascii=False)
    if out is None:
        say(text)
        return
    try:
        out.write_text(text + "\n", encoding="utf-8")
    except OSError as error:
        raise Stop(ExitCode.OUTPUT, f"{out} cannot be written: {error.strerror}") from error
    say(f"schema      {out}")
