"""`run`: the command `motionlayer bench`."""

import os
import platform
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from motionlayer import __version__, _kernel
from motionlayer.bench import _core, _peers, _report
from motionlayer.bench._report import Result
from motionlayer.bench._row import Effort, Failed, Row, Skipped

GROUPS: Final[dict[str, tuple[Row, ...]]] = {"core": _core.ROWS}

FINE: Final = 0
FAILED: Final = 1
USAGE: Final = 2


def run(group: str | None, json: Path | None) -> int:
    """Measure, print a table to stdout with progress on stderr, and write the rows to a file.

    A missed goal is shown in the table and is no failure: goals hold for one computer.

    Args:
        group: key of `GROUPS`; all of them where left out.
        json: where to write `[{name, value, unit, peer, peer_value}, ...]`; null for what could not be measured.

    Returns:
        Exit code: 0; 1 if something to be measured did not work or the file cannot be written; 2 for an unknown
        group.
    """
    if group is not None and group not in GROUPS:
        return _complain(f"no group {group!r}; there are: {', '.join(GROUPS)}", USAGE)
    rows = [row for name, rows in GROUPS.items() if group in (None, name) for row in rows]
    results, notes = measure(rows, Effort())
    print(_heading())
    print(_report.table(results, notes))
    if json is not None:
        try:
            _report.write(results, json)
        except OSError as error:
            return _complain(f"{json}: cannot be written: {error.strerror}", FAILED)
    return FAILED if any(result.failed for result in results) else FINE


def measure(rows: Sequence[Row], effort: Effort, peer_python: Path | None = None) -> tuple[list[Result], list[str]]:
    """Measure rows and their peers; return the results and what has to be said about the peers.

    Args:
        rows: in order.
        effort: see `Effort`.
        peer_python: see `_peers.measure`.
    """
    results = []
    for number, row in enumerate(rows, 1):
        _tell(f"[{number}/{len(rows)}] {row.name}")
        results.append(_measured(row, effort))
    packages = sorted({row.peer.package for row in rows if row.peer is not None})
    if not packages:
        return results, []
    _tell(f"peers: {', '.join(packages)}")
    values, notes = _peers.measure(packages, effort, peer_python, _tell)
    return [_beside(result, values) for result in results], notes


def _measured(row: Row, effort: Effort) -> Result:
    try:
        return Result(row, *row.measure(effort))
    except Skipped as reason:
        return Result(row, None, str(reason))
    except Failed as reason:
        return Result(row, None, str(reason), failed=True)


def _beside(result: Result, values: dict[str, float]) -> Result:
    peer = result.row.peer
    return result if peer is None else result._replace(peer_value=values.get(peer.package))


def _heading() -> str:
    return (
        f"motionlayer {__version__}, kernels {_kernel.MODE}, Python {platform.python_version()}, "
        f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores\n"
    )


def _tell(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def _complain(message: str, code: int) -> int:
    print(f"motionlayer bench: {message}", file=sys.stderr)
    return code
