"""`motionlayer plot`."""

from pathlib import Path

import click

from motionlayer.cli._exit import say
from motionlayer.cli._options import page


@click.command(short_help="Draw a trace.")
@click.argument("trace", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    callback=page,
    metavar="FILE",
    help="The page; default: TRACE with .html.",
)
def plot(trace: Path, output: Path | None) -> None:
    """Draw the file TRACE into one HTML page that needs nothing from outside."""
    from motionlayer.cli._files import draw, load_trace, refuse_overwriting  # noqa: PLC0415 - help does without them

    target = output or trace.with_suffix(".html")
    refuse_overwriting([target], [trace])
    loaded = load_trace(trace)
    draw(loaded, target)
    say(f"plot        {target}")
    if not loaded.complete:
        what = f"damaged: {loaded.damage}" if loaded.damage else "incomplete, its writer was cut short"
        click.echo(f"Warning: {trace} is {what}; the page shows what was read", err=True)
    if loaded.gaps:
        missing = sum(gap.ticks for gap in loaded.gaps)
        click.echo(f"Warning: {trace} lacks {missing} ticks from tick {loaded.gaps[0].first} on", err=True)
