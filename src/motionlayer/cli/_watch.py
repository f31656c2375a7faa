"""`motionlayer watch`."""

import time
from typing import TYPE_CHECKING

import click

from motionlayer.cli._exit import ExitCode, Stop, say
from motionlayer.cli._options import seconds

if TYPE_CHECKING:
    from motionlayer.connect.ads import Watcher

SHOWN = 200
"""Values at most; whoever wants more wants another client."""

PAUSE = 0.5
"""Seconds after which a quiet device is asked again whether the time is over."""


@click.command(short_help="Show live values of a running machine.")
@click.argument("names", nargs=-1, required=True, metavar="SYMBOL...")
@click.option("--ads", default="", metavar="HOST:PORT", help="Where the run is.  [127.0.0.1:48898]")
@click.option("--net-id", default="127.0.0.1.1.1", show_default=True, help="Its AMS NetId.")
@click.option(
    "--cycle", type=float, default=0.1, show_default=True, callback=seconds, help="How often values are looked at (s)."
)
@click.option("--time", "duration", type=float, callback=seconds, metavar="S", help="End after S seconds of wall time.")
def watch(names: tuple[str, ...], ads: str, net_id: str, cycle: float, duration: float | None) -> None:
    """Show each SYMBOL now and whenever it changes, by ADS; Ctrl-C ends it.

    A structure or an array is shown value by value. Any ADS device is taken, not only a run of motionlayer.
    """
    from motionlayer.cli._ads import address  # noqa: PLC0415 - help does without it
    from motionlayer.connect.ads import Watcher, WatchError  # noqa: PLC0415

    host, port = address(ads)
    try:
        with Watcher(host or "127.0.0.1", 48898 if port is None else port, net_id) as watcher:
            _subscribe(watcher, names, cycle)
            _show(watcher, duration)
    except (WatchError, ValueError) as error:
        raise Stop(ExitCode.FAILED, str(error)) from error


def _subscribe(watcher: "Watcher", names: tuple[str, ...], cycle: float) -> None:
    count = 0
    for name in names:
        count += len(watcher.watch(name, cycle))
        if count > SHOWN:
            raise click.UsageError(f"{name}: {count} values, at most {SHOWN} are shown; name members")


def _show(watcher: "Watcher", duration: float | None) -> None:
    """Print what comes."""
    end = None if duration is None else time.monotonic() + duration
    while end is None or time.monotonic() < end:
        for sample in watcher.samples(PAUSE):
            moment = time.strftime("%H:%M:%S", time.localtime(sample.time))
            say(f"{moment}.{int(sample.time % 1 * 1000):03d} {sample.leaf.name} = {sample.value}")
