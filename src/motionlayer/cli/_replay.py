"""`motionlayer replay`."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from motionlayer.cli._exit import ExitCode, Stop, complain, say

if TYPE_CHECKING:
    from motionlayer.machine import Source
    from motionlayer.record import Trace


@click.command(short_help="Run a recorded run again, and compare.")
@click.argument("trace", type=click.Path(path_type=Path))
@click.option(
    "--program",
    "programs",
    metavar="FILE[:NAME]",
    multiple=True,
    help="A program file in the place of the recorded one of the same name, or of the only one; may be repeated.",
)
@click.pass_context
def replay(ctx: click.Context, trace: Path, programs: tuple[str, ...]) -> None:
    """Run what the file TRACE has recorded again, and compare bit for bit.

    The machine and all that came from outside are in the trace; the programs are loaded from where they were, or from
    the folder of the trace. Exit code 0: the same; 1: not the same, with the first difference.
    """
    from motionlayer.cli._files import load_trace  # noqa: PLC0415 - help does without them
    from motionlayer.machine import parse_source  # noqa: PLC0415

    recorded = load_trace(trace)
    if recorded.damage:
        click.echo(f"Warning: {trace} is damaged: {recorded.damage}", err=True)
    ctx.exit(_replayed(recorded, trace, [parse_source(text) for text in programs]))


def _replayed(recorded: "Trace", path: Path, instead: "list[Source]") -> ExitCode:
    """Replay and say how it went."""
    from motionlayer.cli._failure import place  # noqa: PLC0415 - help does without them
    from motionlayer.cli._progress import Progress  # noqa: PLC0415
    from motionlayer.machine import ProgramError, ReplayError  # noqa: PLC0415
    from motionlayer.machine import replay as run_again  # noqa: PLC0415

    count = recorded.end.tick if recorded.end is not None else len(recorded.ticks)
    try:
        with Progress(count, recorded.base_cycle, sys.stderr) as progress:
            done = run_again(recorded, folder=path.parent, instead=instead, watch=progress)
    except ReplayError as error:
        raise Stop(ExitCode.OUTPUT, f"{path} cannot be replayed: {error}") from error
    except ProgramError as error:
        raise Stop(ExitCode.FAILED, f"{error}{place(error.__cause__)}") from error
    for note in done.notes:
        click.echo(f"Warning: {note}", err=True)
    seconds = done.ticks * recorded.base_cycle
    say(f"replayed    {seconds:.9g} s in {done.ticks} ticks of {recorded.base_cycle * 1e3:.9g} ms")
    say(f"compared    {done.compared}")
    if not done.same:
        complain(f"{path}: the replay is another run: {done.difference}")
        return ExitCode.FAILED
    say("same        yes")
    return ExitCode.OK
