"""`motionlayer verify`."""

from pathlib import Path

import click

from motionlayer.cli._exit import ExitCode, complain, say


@click.command(short_help="Judge a trace.")
@click.argument("trace", type=click.Path(path_type=Path))
@click.option("--partial", is_flag=True, help="Accept an incomplete trace if it is valid up to where it ends.")
@click.pass_context
def verify(ctx: click.Context, trace: Path, *, partial: bool) -> None:
    """Judge the file TRACE on its own: limits, continuity, states, commands.

    A trace whose writer was killed is judged up to where it ends, a damaged one is refused.
    """
    from motionlayer.cli._files import load_trace  # noqa: PLC0415 - help does without them
    from motionlayer.verify import verify as judge  # noqa: PLC0415

    report = judge(load_trace(trace))
    say(str(report))
    if report.findings:
        ctx.exit(ExitCode.FAILED)
    if report.refused:
        ctx.exit(ExitCode.OUTPUT)
    if not (report.complete or partial):
        complain(f"{trace} is incomplete; --partial accepts the part that was judged")
        ctx.exit(ExitCode.OUTPUT)
