"""`motionlayer bench`."""

from pathlib import Path

import click


@click.command(short_help="Measure motionlayer, beside its peers.")
@click.argument("group", required=False)
@click.option("--json", type=click.Path(path_type=Path, dir_okay=False), metavar="FILE", help="Write the rows as JSON.")
@click.pass_context
def bench(ctx: click.Context, group: str | None, json: Path | None) -> None:
    """Measure the rows of GROUP, or of all groups, and print them beside their goals and peers."""
    from motionlayer.bench import run  # noqa: PLC0415 - help does without it

    ctx.exit(run(group, json))
