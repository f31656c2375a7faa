"""`motionlayer bench`."""

from pathlib import Path

import click

FILE = click.Path(path_type=Path, dir_okay=False)


@click.command(short_help="Measure motionlayer, beside its peers.")
@click.argument("group", required=False)
@click.option("--json", type=FILE, metavar="FILE", help="Write the rows as JSON.")
@click.option("--plot", type=FILE, metavar="FILE.html", help="Draw the cost of a cycle against the number of axes.")
@click.option("--history", is_flag=True, help="Measure nothing; show how the rows have changed on this computer.")
@click.option("--history-file", type=FILE, metavar="FILE", help="Append the values here instead of the user's history.")
@click.pass_context
def bench(
    ctx: click.Context,
    group: str | None,
    json: Path | None,
    plot: Path | None,
    history: bool,
    history_file: Path | None,
) -> None:
    """Measure the rows of GROUP, or of all groups, and print them beside their goals and peers."""
    from motionlayer.bench import run, show_history  # noqa: PLC0415 - help does without it

    if history:
        ctx.exit(show_history(group, history_file))
    ctx.exit(run(group, json, plot=plot, history=history_file))
