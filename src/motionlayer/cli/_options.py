"""The options of `run`, those that other commands share with it, and what values must be where click has no type."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Final, NamedTuple

import click

PAGE_SUFFIXES: Final = (".html", ".htm")

SLOWEST: Final = 0.01
FASTEST: Final = 1000.0
"""Bounds of the speed: those of `motionlayer.runtime`, which the help does without."""

LEVELS: Final = ("error", "warning", "info", "verbose", "sentient")
"""Levels of message files."""


class Options(NamedTuple):
    """What `motionlayer run` was asked for.

    Attributes:
        machine: the machine file.
        program: `FILE[:NAME]`, in the place of the programs of the machine file.
        time: s of the run.
        seed: in the place of the seed of the machine file.
        trace: file for the trace.
        hash: take the hash of the run.
        plot: file for the page.
        patience: s of wall time until a program counts as stuck.
        realtime: in the time of a clock.
        speed: times real time; only with `realtime`.
        statistics: measure what the ticks cost.
        log: root folder of the message files, in the place of that of the machine file.
        log_level: in the place of that of the machine file.
        ads: `HOST:PORT` of the ADS server; "" where the option has no value, None without it.
    """

    machine: Path
    program: str | None
    time: float | None
    seed: int | None
    trace: Path | None
    hash: bool
    plot: Path | None
    patience: float | None
    realtime: bool
    speed: float | None
    statistics: bool
    log: Path | None
    log_level: str | None
    ads: str | None


def seconds(_context: click.Context, _option: click.Parameter, value: float | None) -> float | None:
    """Return a time that is finite and more than nothing."""
    if value is not None and not 0.0 < value < math.inf:
        raise click.BadParameter(f"{value:g} must be finite and greater than 0 (s)")
    return value


def speed(_context: click.Context, _option: click.Parameter, value: float | None) -> float | None:
    """Return a speed that a clock can pace."""
    if value is not None and not SLOWEST <= value <= FASTEST:
        raise click.BadParameter(f"{value:g} must be {SLOWEST:g} to {FASTEST:g} (times real time)")
    return value


def require_clock(given: float | None, *, realtime: bool) -> None:
    """Take a speed only in real time.

    Raises:
        UsageError: there is a speed, and no clock that it could be the speed of.
    """
    if given is not None and not realtime:
        raise click.UsageError("--speed is that of a clock: give --realtime as well")


def page(_context: click.Context, _option: click.Parameter, value: Path | None) -> Path | None:
    """Return a file for a page; its name is checked before a long run, not after it."""
    if value is not None and value.suffix.lower() not in PAGE_SUFFIXES:
        raise click.BadParameter(f"{value}: a page is written as .html; save pictures from it in a browser")
    return value


def json_file(what: str) -> Callable[[click.Context, click.Parameter, Path | None], Path | None]:
    """Return what checks the name of a file that is written: its ending keeps a slip from overwriting a machine.

    Args:
        what: is written, for the message.
    """

    def checked(_context: click.Context, _option: click.Parameter, value: Path | None) -> Path | None:
        if value is not None and value.suffix.lower() != ".json":
            raise click.BadParameter(f"{value}: {what} is written as .json")
        return value

    return checked


machine_argument = click.argument("machine", type=click.Path(path_type=Path))

program_option = click.option(
    "--program",
    metavar="FILE[:NAME]",
    help="Run the function NAME of FILE in the place of the programs of MACHINE.  [NAME: main]",
)

seed_option = click.option(
    "--seed", type=click.IntRange(0, 2**63 - 1), metavar="N", help="Seed, in the place of the one of MACHINE."
)

realtime_option = click.option("--realtime", is_flag=True, help="Run in the time of a clock.")

speed_option = click.option(
    "--speed",
    type=float,
    callback=speed,
    metavar="X",
    help="With --realtime: X times as fast as real time, 0.01 to 1000.  [1]",
)
