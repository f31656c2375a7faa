"""Run a campaign, or one case of it: `make campaign NAME=life COUNT=1e7 SEED=1 [CASE=1234] [FRESH=1]`."""

import sys
from pathlib import Path

import click

from motionlayer.bench.campaign import CAMPAIGNS, Campaign, State, StateError, pursue, repeat, resume

FOLDER = Path(__file__).resolve().parent.parent / "out" / "campaign"
FAILED, USAGE, INTERRUPTED = 1, 2, 130
MOST_SHOWN = 10


class Whole(click.ParamType):
    """A whole number above zero, as 1000000 or 1e6."""

    name = "number"

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the number."""
        try:
            number = float(value)
            whole = int(number)
        except (ValueError, OverflowError):
            whole = number = 0
        if whole < 1 or whole != number:
            self.fail(f"{value!r} is no whole number above zero", param, ctx)
        return whole


@click.command(context_settings={"help_option_names": ["-h", "--help"]})
@click.option("--name", type=click.Choice(list(CAMPAIGNS)), required=True, help="What is run.")
@click.option("--count", type=Whole(), help="Of what the campaign counts; that of a full one where left out.")
@click.option("--seed", type=click.IntRange(min=0), default=1, show_default=True, help="Of all cases.")
@click.option("--case", type=click.IntRange(min=0), help="Run this case alone, and show its input.")
@click.option("--fresh", is_flag=True, help="Forget the earlier state.")
@click.option("--folder", type=click.Path(path_type=Path, file_okay=False), default=FOLDER, help="Of the state files.")
def main(name: str, count: int | None, seed: int, case: int | None, fresh: bool, folder: Path) -> None:
    """Run a campaign up to COUNT, from where it was stopped; Ctrl-C stops it."""
    campaign = CAMPAIGNS[name]
    if case is not None:
        sys.exit(_one(campaign, seed, case))
    file = folder / f"{name}-{seed}.json"
    try:
        if fresh:
            file.unlink(missing_ok=True)
        sys.exit(_all(campaign, seed, count or campaign.full, file))
    except StateError as error:
        click.echo(f"campaign: {error}", err=True)
        sys.exit(USAGE)


def _one(campaign: Campaign, seed: int, case: int) -> int:
    click.echo(campaign.describe(seed, case))
    failures = repeat(campaign, seed, case)
    for failure in failures:
        click.echo(f"FAILED: {failure.text}")
    if not failures:
        click.echo("fine")
    return FAILED if failures else 0


def _all(campaign: Campaign, seed: int, count: int, file: Path) -> int:
    state, anew = resume(campaign, seed, file)
    told = f"goes on at {state.cases * campaign.size}" if not anew else f"starts at 0: {anew}"
    click.echo(f"{campaign.name}, seed {seed}: {told}")
    length = -(-count // campaign.size)
    try:
        with click.progressbar(length=length, label=campaign.name, file=sys.stderr) as bar:
            bar.update(min(state.cases, length))
            pursue(campaign, state, count, file, lambda cases: bar.update(cases - bar.pos))
    except KeyboardInterrupt:
        _report(campaign, state, file)
        click.echo("interrupted; the same command goes on from here", err=True)
        return INTERRUPTED
    _report(campaign, state, file)
    return FAILED if state.failures else 0


def _report(campaign: Campaign, state: State, file: Path) -> None:
    reached = f"{state.cases * campaign.size} {campaign.unit}, seed {state.seed}"
    click.echo(f"{campaign.name}: {reached}: {len(state.failures)} failures; {file}")
    for failure in state.failures[:MOST_SHOWN]:
        click.echo(f"\nmake campaign NAME={campaign.name} SEED={state.seed} CASE={failure.case}\n{failure.text}")
    if len(state.failures) > MOST_SHOWN:
        click.echo(f"\n... and {len(state.failures) - MOST_SHOWN} more in the file")


if __name__ == "__main__":
    main()
