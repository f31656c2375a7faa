"""`motionlayer verify`."""

from pathlib import Path

import click

from motionlayer.cli._exit import ExitCode


@click.command(short_help="Judge a trace.")
@click.argument("trace", type=click.Path(path_type=Path))
@click.pass_context
def verify(ctx: click.Context, trace: Path) -> None:
    """Judge the file TRACE on its own: limits, continuity, states, commands."""
    from motionlayer.cli._files import load_trace  # noqa: PLC0415 - help does without them
    from motionlayer.verify import verify as judge  # noqa: PLC0415

    report = judge(load_trace(trace))
    click.echo(str(report))
    if report.findings:
        ctx.exit(ExitCode.FAILED)
    if report.refused:
        ctx.exit(ExitCode.TRACE)
