"""Faults planted in a server process: `python -c "from tests.connect.planted import main; main('hang')"`.

Each is one that a client can bring about: reading this index group.
"""

import os
import sys
import threading
from collections.abc import Callable
from pathlib import Path

from motionlayer.bench.campaign import _ads_victim
from motionlayer.connect.ads._connection import Connection

ROOT = str(Path(__file__).resolve().parents[2])

BEFORE = 100
"""Streams that are served well before a fault shows."""

KEPT = 30_000
"""Bytes that each stream leaves behind."""

_left: list[bytearray] = []


def hang() -> None:
    """Never answer anybody again."""
    threading.Event().wait()


def crash() -> None:
    """End the process."""
    os._exit(3)


def fail() -> None:
    """Raise where nothing may be raised."""
    raise RuntimeError("planted")


def leak() -> None:
    """Keep something of every stream."""
    _left.append(bytearray(os.urandom(1)) * KEPT)


FAULTS: dict[str, tuple[int, Callable[[], None]]] = {
    "hang": (BEFORE, hang),
    "crash": (BEFORE, crash),
    "fail": (BEFORE, fail),
    "leak": (0, leak),
}


def command(name: str) -> tuple[str, ...]:
    """Return the command that runs a server with a fault."""
    code = f"import sys; sys.path[0] = {ROOT!r}; from tests.connect.planted import main; main({name!r})"
    return sys.executable, "-c", code


def main(name: str) -> None:
    """Serve, with a fault."""
    before, fault = FAULTS[name]
    closed, streams = Connection.closed, 0

    def with_fault(connection: Connection) -> None:
        nonlocal streams
        streams += 1
        if streams > before:
            fault()
        closed(connection)

    Connection.closed = with_fault  # type: ignore[assignment,method-assign]
    _ads_victim.main()
