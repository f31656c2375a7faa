"""`motionlayer watch`."""

import itertools
import math
import time
from typing import TYPE_CHECKING

import click

from motionlayer.cli._exit import ExitCode, Stop, say
from motionlayer.cli._options import seconds

if TYPE_CHECKING:
    from motionlayer.connect.ads import Sample, Watcher

    Place = tuple[str, int, str]

SHOWN = 1000
"""Values at most; whoever wants more wants another client."""

PAUSE = 0.5
"""Seconds until it is seen that the time is over, and until a device that has gone is looked for again."""


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

    A structure or an array is shown value by value. A device that goes is waited for. Any ADS device is taken, not only
    a run of motionlayer.
    """
    from motionlayer.cli._ads import address  # noqa: PLC0415 - help does without it
    from motionlayer.connect.ads import WatchError  # noqa: PLC0415

    host, port = address(ads)
    place = host or "127.0.0.1", 48898 if port is None else port, net_id
    end = math.inf if duration is None else time.monotonic() + duration
    try:
        _follow(place, names, cycle, end)
    except (WatchError, ValueError) as error:
        raise Stop(ExitCode.FAILED, str(error)) from error


def _follow(place: "Place", names: tuple[str, ...], cycle: float, end: float) -> None:
    """Show values until the time is over; a device that goes is waited for.

    Raises:
        WatchError: nobody is there at first, or the device refuses.
    """
    from motionlayer.connect.ads import Absent, Lost, Watcher  # noqa: PLC0415

    again = False
    while time.monotonic() < end:
        try:
            with Watcher(*place) as watcher:
                _subscribe(watcher, names, cycle)
                if again:
                    click.echo("the device is there again", err=True)
                again = True
                _show(watcher, end)
        except Lost as error:
            click.echo(f"{error}; waiting for the device to come back, Ctrl-C ends it", err=True)
        except Absent:
            if not again:
                raise
        time.sleep(max(0.0, min(PAUSE, end - time.monotonic())))


def _subscribe(watcher: "Watcher", names: tuple[str, ...], cycle: float) -> None:
    count = 0
    for name in names:
        count += sum(1 for _ in itertools.islice(watcher.values(name), SHOWN + 1 - count))
        if count > SHOWN:
            raise click.UsageError(f"{name}: more than {SHOWN} values are not shown; name members")
        watcher.watch(name, cycle)


def _show(watcher: "Watcher", end: float) -> None:
    """Print what comes."""
    while (left := end - time.monotonic()) > 0.0:
        for sample in watcher.samples(min(PAUSE, left)):
            moment = time.strftime("%H:%M:%S", time.localtime(sample.time))
            say(f"{moment}.{int(sample.time % 1 * 1000):03d} {sample.leaf.name} = {_said(sample)}")


def _said(sample: "Sample") -> str:
    """Return a value as text; a state of the motion layer, which is no member of its enumeration, in its two parts."""
    from motionlayer.layer import Progress, split  # noqa: PLC0415

    value, names = sample.value, sample.leaf.kind.values
    if not names or not isinstance(value, int):
        return str(value)
    command, progress = split(value)
    name = names.get(int(command))
    if name is None or not isinstance(progress, Progress):
        return str(value)
    return f"{value} {name} + PROGRESS_{progress.name}"
