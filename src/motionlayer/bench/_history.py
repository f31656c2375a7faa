"""The history of measurements: one line of JSON per run."""

import json
import os
import platform
import subprocess
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final

import motionlayer
from motionlayer import _kernel
from motionlayer.bench._report import Result, rounded

CHECKOUT: Final = Path(motionlayer.__file__).resolve().parents[2]
MOST_SHOWN: Final = 8
"""Values of a row, the youngest ones."""

GIT_PATIENCE: Final = 10.0
"""Seconds of wall time."""


class HistoryError(Exception):
    """The history cannot be read or written."""


def default_file() -> Path:
    """Return where the history lives: below `XDG_DATA_HOME`, else `~/.local/share`."""
    home = os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share"
    return Path(home) / "motionlayer" / "bench.jsonl"


def append(results: Sequence[Result], file: Path) -> None:
    """Add the values of a run, with date, commit and computer.

    Raises:
        HistoryError: the file cannot be written.
    """
    entry = {
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
        "version": motionlayer.__version__,
        "commit": commit(CHECKOUT),
        "machine": machine(),
        "rows": {result.row.name: rounded(result.value) for result in results},
    }
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with file.open("a", encoding="utf-8") as stream:
            stream.write(json.dumps(entry, ensure_ascii=False) + "\n")
    except OSError as error:
        raise HistoryError(f"{file}: the history cannot be written: {error.strerror}") from error


def machine() -> str:
    """Name what the numbers belong to: nothing else can be compared with them."""
    return (
        f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores, "
        f"Python {platform.python_version()}, kernels {_kernel.MODE}"
    )


def commit(folder: Path) -> str | None:
    """Return the commit of a checkout, with a + if it has changes; None where there is none."""
    if not (folder / ".git").exists():
        return None
    try:
        answers = [
            subprocess.run(  # noqa: S603 - constant arguments
                ["git", "-C", str(folder), *arguments],  # noqa: S607 - the user's git
                capture_output=True, text=True, timeout=GIT_PATIENCE, check=True,
            ).stdout.strip()
            for arguments in (("rev-parse", "--short", "HEAD"), ("status", "--porcelain", "--untracked-files=no"))
        ]  # fmt: skip
    except (OSError, subprocess.SubprocessError):
        return None
    return answers[0] + ("+" if answers[1] else "")


def read(file: Path) -> list[dict[str, Any]]:
    """Return all entries, oldest first; a line that was cut off is left out.

    Raises:
        HistoryError: the file cannot be read.
    """
    try:
        lines = file.read_text(encoding="utf-8").splitlines()
    except FileNotFoundError:
        return []
    except (OSError, UnicodeDecodeError) as error:
        raise HistoryError(f"{file}: the history cannot be read: {error}") from error
    return [entry for line in lines if (entry := _entry(line)) is not None]


def _entry(line: str) -> dict[str, Any] | None:
    try:
        entry = json.loads(line)
    except ValueError:
        return None
    complete = isinstance(entry, dict) and isinstance(entry.get("rows"), dict) and {"date", "machine"} <= entry.keys()
    return entry if complete else None


def changes(entries: Sequence[dict[str, Any]], names: Sequence[str]) -> str:
    """Return how rows have changed on this computer: their youngest values, oldest first, and the last change."""
    own = [entry for entry in entries if entry["machine"] == machine()]
    if not own:
        return f"no history of {machine()}"
    lines = [f"{len(own)} runs of {machine()}, the last one {own[-1]['date']}", ""]
    for name in names:
        values = [entry["rows"][name] for entry in own if entry["rows"].get(name) is not None][-MOST_SHOWN:]
        if values:
            lines.append(f"{name:22} {_change(values):>8}   {'  '.join(f'{value:g}' for value in values)}")
    return "\n".join(lines)


def _change(values: Sequence[float]) -> str:
    """Return the change of the last value against the one before, in percent; "" where there is none."""
    if len(values) < 2 or not values[-2]:
        return ""
    return f"{(values[-1] / values[-2] - 1.0) * 100.0:+.1f} %"
