"""`motionlayer soak`: its options."""

from pathlib import Path

import click

from motionlayer.cli._options import (
    json_file,
    machine_argument,
    program_option,
    realtime_option,
    seed_option,
    speed_option,
)
from motionlayer.cli._soak_options import SoakOptions


@click.command(short_help="Run a machine for long; report memory, drift, lateness.")
@machine_argument
@click.option("--cycles", type=click.IntRange(1), required=True, metavar="N", help="Run N cycles.")
@click.option(
    "--warm-up",
    type=click.IntRange(0),
    metavar="N",
    help="Cycles after which memory counts.  [a tenth, at most 1000000]",
)
@program_option
@seed_option
@realtime_option
@speed_option
@click.option(
    "--trace",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Record the run to FILE, and judge the last 100000 cycles in the end.",
)
@click.option(
    "--report",
    type=click.Path(path_type=Path),
    callback=json_file("a report"),
    metavar="FILE",
    help="Write the report to FILE (.json).",
)
@click.pass_context
def soak(ctx: click.Context, /, **options: object) -> None:
    """Run the programs of MACHINE for a number of cycles, and report what that did to the process.

    A program that ends is started again; one that fails ends the command. No message files are written, and without
    --trace nothing is recorded: what grows is the run itself. Ctrl-C ends it with the report so far.
    """
    from motionlayer.cli._soaking import soaked  # noqa: PLC0415 - help does without it

    ctx.exit(soaked(SoakOptions(**options)))  # type: ignore[arg-type]
