"""`motionlayer run`: its options."""

from pathlib import Path

import click

from motionlayer.cli._options import (
    LEVELS,
    Options,
    machine_argument,
    page,
    program_option,
    realtime_option,
    seconds,
    seed_option,
    speed_option,
)


@click.command(short_help="Run a machine, in simulation or in real time.")
@machine_argument
@program_option
@click.option(
    "--time", type=float, callback=seconds, metavar="S", help="End after S seconds of the run, at the latest."
)
@seed_option
@click.option("--trace", type=click.Path(path_type=Path), metavar="FILE", help="Record the run to FILE.")
@click.option("--hash", is_flag=True, help="Take the hash of the run, also without a trace.")
@click.option(
    "--plot",
    type=click.Path(path_type=Path),
    callback=page,
    metavar="FILE",
    help="Draw the run into the page FILE (.html).",
)
@click.option(
    "--patience",
    type=float,
    callback=seconds,
    metavar="S",
    help="Seconds of wall time after which a program that does not yield ends the run.  [10], in real time [1]",
)
@click.option(
    "--log",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="DIR",
    help="Write message files into DIR, in the place of the one of MACHINE.",
)
@click.option(
    "--log-level",
    type=click.Choice(LEVELS),
    help="What is written beside errors, in the place of the level of MACHINE.  [info]",
)
@click.option(
    "--ads",
    is_flag=False,
    flag_value="",
    metavar="[HOST:PORT]",
    help="Let ADS clients reach the run there.  [127.0.0.1:48898]",
)
@realtime_option
@speed_option
@click.option("--statistics", is_flag=True, help="Measure what the ticks cost; --realtime always does.")
@click.pass_context
def run(ctx: click.Context, /, **options: object) -> None:
    """Run the programs of MACHINE, as fast as the computer allows, or with --realtime in the time of a clock.

    The run ends when all programs have ended and no axis brakes, or when its time is over; one with an ADS server and
    without programs, in real time, when it is interrupted. With --trace or --hash the
    last line is the hash of the run: the same machine, program and seed give the same hash.
    """
    from motionlayer.cli._simulate import simulate  # noqa: PLC0415 - help does without it

    ctx.exit(simulate(Options(**options)))  # type: ignore[arg-type]
