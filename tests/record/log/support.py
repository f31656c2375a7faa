"""Events, files and the log in between."""

import contextlib
import subprocess
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest

from motionlayer.event import Device, Event, Kind, Level, Levels, device_of
from motionlayer.record.log import LocalTime, LogFolder, MessageLog

AXIS = device_of(Device.Axis, 1)
SECOND = 1_000_000_000
CYCLE = 1_000_000
MOUNT = "mount"


def at(text: str) -> int:
    """Return a time given as text, in ns since 1970; UTC."""
    since = datetime.fromisoformat(text).replace(tzinfo=UTC) - datetime(1970, 1, 1, tzinfo=UTC)
    return since // timedelta(microseconds=1) * 1000


def utc(_second: int) -> int:
    return 0


def local(epoch: str = "2025-10-24T13:00:00") -> LocalTime:
    """Return the time of ticks of 1 ms, in UTC."""
    return LocalTime(at(epoch), CYCLE, utc)


def message(
    tick: int = 0, text: str = "text", level: Level = Level.INFO, *, device: int = AXIS, code: int = 0, part: int = 1001
) -> Event:
    return Event(tick, level, Kind.MESSAGE, "X", text, code, 0, device, part)


def opened(folder: Path, epoch: str = "2025-10-24T13:00:00", **changes: Any) -> MessageLog:
    """Return a log that writes everything."""
    size = {"size": changes.pop("size")} if "size" in changes else {}
    return MessageLog(LogFolder(folder, **size), local(epoch), Levels(Level.SENTIENT), **changes)


def files(folder: Path) -> dict[str, list[str]]:
    """Return the lines of all message files below a folder, by their relative names; each must be whole."""
    found = {}
    for path in sorted(folder.rglob("*.txt")):
        content = path.read_bytes().decode()
        assert not content or content.endswith("\n")
        found[path.relative_to(folder).as_posix()] = content.split("\n")[:-1]
    return found


def texts(lines: list[str]) -> list[str]:
    """Return the last columns."""
    return [line.split("\t")[5] for line in lines]


def times(lines: list[str]) -> list[str]:
    """Return the columns of the time."""
    return [line.split("\t")[1] for line in lines]


@contextlib.contextmanager
def small_disk(disk: Path) -> Iterator[Path]:
    """Make a folder, and a disk of 64 KiB in it."""
    disk.mkdir()
    mounted = subprocess.run([MOUNT, "-t", "tmpfs", "-o", "size=64k", "none", disk], capture_output=True, check=False)
    if mounted.returncode:
        pytest.skip("a file system cannot be mounted here")
    yield disk
    subprocess.run([f"u{MOUNT}", disk], check=True)


def resize(disk: Path, size: str) -> None:
    """Give such a disk another size, as `mount` writes it."""
    subprocess.run([MOUNT, "-o", f"remount,size={size}", disk], check=True)
