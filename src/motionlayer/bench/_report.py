"""Results as a table and as JSON."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Final, NamedTuple

from motionlayer.bench._environment import PINS
from motionlayer.bench._row import Row

HEADING: Final = ("name", "value", "unit", "goal", "peer", "peer value")
RIGHT: Final = (1, 5)
"""Columns of numbers."""


class Result(NamedTuple):
    """A row and what came of it; None stands for what could not be measured."""

    row: Row
    value: float | None
    note: str = ""
    failed: bool = False
    peer_value: float | None = None


def rounded(value: float | None) -> float | None:
    """Return three significant digits: more do not repeat."""
    return None if value is None else float(f"{value:.3g}")


def peer_label(row: Row) -> str:
    """Say who the peer is, in which version, and what of it is measured; "" without one."""
    peer = row.peer
    return "" if peer is None else f"{peer.package} {PINS[peer.package]}, {peer.what}"


def table(results: Sequence[Result], notes: Sequence[str]) -> str:
    """Return a table for people: a line per row, then the notes."""
    lines = [HEADING, *(_cells(result) for result in results)]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    text = [
        "  ".join(
            cell.rjust(width) if number in RIGHT else cell.ljust(width)
            for number, (cell, width) in enumerate(zip(line, widths, strict=True))
        ).rstrip()
        for line in lines
    ]
    own = [f"{result.row.name}: {result.note}" for result in results if result.note]
    return "\n".join([*text, *([""] if own or notes else []), *own, *notes])


def write(results: Sequence[Result], file: Path) -> None:
    """Write the results as a JSON list of objects.

    Raises:
        OSError: the file cannot be written.
    """
    rows = [
        {
            "name": result.row.name,
            "value": rounded(result.value),
            "unit": result.row.unit,
            "peer": peer_label(result.row) or None,
            "peer_value": rounded(result.peer_value),
        }
        for result in results
    ]
    file.write_text(json.dumps(rows, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _cells(result: Result) -> tuple[str, ...]:
    row = result.row
    missed = result.value is not None and not row.goal.met(result.value)
    goal = f"{row.goal}{' missed' if missed else ''}"
    return (row.name, _number(result.value), row.unit, goal, peer_label(row), _number(result.peer_value))


def _number(value: float | None) -> str:
    return "" if value is None else f"{rounded(value):g}"
