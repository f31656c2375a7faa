"""What values of options must be, where click has no type for it."""

import math
from pathlib import Path
from typing import Final

import click

PAGE_SUFFIXES: Final = (".html", ".htm")


def seconds(_context: click.Context, _option: click.Parameter, value: float | None) -> float | None:
    """Return a time that is finite and more than nothing."""
    if value is not None and not 0.0 < value < math.inf:
        raise click.BadParameter(f"{value:g} must be finite and greater than 0 (s)")
    return value


def page(_context: click.Context, _option: click.Parameter, value: Path | None) -> Path | None:
    """Return a file for a page; its name is checked before a long run, not after it."""
    if value is not None and value.suffix.lower() not in PAGE_SUFFIXES:
        raise click.BadParameter(f"{value}: a page is written as .html; save pictures from it in a browser")
    return value
