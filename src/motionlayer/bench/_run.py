"""`run`: the command `motionlayer bench`."""

import os
import platform
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from motionlayer import __version__, _kernel
from motionlayer.bench import _ads, _axis, _core, _history, _layer, _numerics, _peers, _report, _runtime, _scaling
from motionlayer.bench._environment import tell
from motionlayer.bench._report import Result
from motionlayer.bench._row import Effort, Failed, Row, Skipped

GROUPS: Final[dict[str, tuple[Row, ...]]] = {
    "core": _core.ROWS,
    "axis": _axis.ROWS,
    "numerics": _numerics.ROWS,
    "runtime": _runtime.ROWS,
    "layer": _layer.ROWS,
    "ads": _ads.ROWS,
}

FINE: Final = 0
FAILED: Final = 1
USAGE: Final = 2


def run(group: str | None, json: Path | None = None, *, plot: Path | None = None, history: Path | None = None) -> int:
    """Measure, print a table to stdout with progress on stderr, and write the rows to files.

    A missed goal is shown in the table and is no failure: goals hold for one computer.

    Args:
        group: key of `GROUPS`; all of them where left out.
        json: where to write `[{name, value, unit, peer, peer_value}, ...]`; null for what could not be measured.
        plot: page that shows the cost of a cycle against the number of axes, measured in addition.
        history: file to which the values are appended; that of the user where left out.

    Returns:
        Exit code: 0; 1 if something to be measured did not work or a file cannot be written; 2 for an unknown group
        or a page that is not named .html.
    """
    if group is not None and group not in GROUPS:
        return _complain(_unknown(group), USAGE)
    if plot is not None and plot.suffix.lower() not in _scaling.SUFFIXES:
        return _complain(f"{plot}: pages are written as .html only; name it {plot.stem}.html", USAGE)
    results, notes = measure(_rows(group), Effort())
    print(_heading() + "\n")
    print(_report.table(results, notes))
    codes = [FAILED if any(result.failed for result in results) else FINE]
    try:
        _history.append(results, history or _history.default_file())
    except _history.HistoryError as error:
        codes.append(_complain(str(error), FINE if history is None else FAILED))  # a home may be read-only
    try:
        if json is not None:
            _report.write(results, json)
        if plot is not None:
            draw(plot, Effort())
    except OSError as error:
        codes.append(_complain(f"{error.filename}: cannot be written: {error.strerror}", FAILED))
    return max(codes)


def show_history(group: str | None, history: Path | None = None) -> int:
    """Print how the rows have changed on this computer; measure nothing.

    Returns:
        Exit code: 0; 1 if the history cannot be read; 2 for an unknown group.
    """
    if group is not None and group not in GROUPS:
        return _complain(_unknown(group), USAGE)
    try:
        entries = _history.read(history or _history.default_file())
    except _history.HistoryError as error:
        return _complain(str(error), FAILED)
    print(_history.changes(entries, [row.name for row in _rows(group)]))
    return FINE


def draw(file: Path, effort: Effort, axes: Sequence[int] = _scaling.AXES) -> None:
    """Measure the cost of a cycle against the number of axes and draw it.

    Raises:
        OSError: the page cannot be written.
    """
    curves, notes = _scaling.measure(effort, tell, axes)
    for note in notes:
        tell(note)
    _scaling.write_page(curves, file, _heading(), axes)


def measure(rows: Sequence[Row], effort: Effort) -> tuple[list[Result], list[str]]:
    """Measure rows and their peers; return the results and what has to be said about the peers."""
    results = []
    for number, row in enumerate(rows, 1):
        tell(f"[{number}/{len(rows)}] {row.name}")
        results.append(_measured(row, effort))
    peers = [row.peer for row in rows if row.peer is not None]
    if not peers:
        return results, []
    tell(f"peers: {', '.join(sorted({peer.package for peer in peers}))}")
    values, notes = _peers.measure(peers, effort)
    return [_beside(result, values) for result in results], notes


def _rows(group: str | None) -> list[Row]:
    return [row for name, rows in GROUPS.items() if group in (None, name) for row in rows]


def _unknown(group: str) -> str:
    return f"no group {group!r}; there are: {', '.join(GROUPS)}"


def _measured(row: Row, effort: Effort) -> Result:
    try:
        return Result(row, *row.measure(effort))
    except Skipped as reason:
        return Result(row, None, str(reason))
    except Failed as reason:
        return Result(row, None, str(reason), failed=True)


def _beside(result: Result, values: dict[str, float]) -> Result:
    peer = result.row.peer
    return result if peer is None else result._replace(peer_value=values.get(peer.job))


def _heading() -> str:
    return (
        f"motionlayer {__version__}, kernels {_kernel.MODE}, Python {platform.python_version()}, "
        f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores"
    )


def _complain(message: str, code: int) -> int:
    print(f"motionlayer bench: {message}", file=sys.stderr)
    return code
