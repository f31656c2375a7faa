"""The file that a trace is written to: one writer at a time, however the other one ends."""

import fcntl
import os
import stat
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

from motionlayer.record._errors import TraceError


def open_alone(path: Path) -> BinaryIO:
    """Open a file for writing and empty it, unless another writer has it.

    The lock comes before the file is emptied: what the other one has written stays. It is the operating system's and
    ends with the file, so that a killed run leaves none. Devices and pipes are not locked, file systems without locks
    do without.

    Raises:
        TraceError: another run writes it.
        OSError: it cannot be opened.
    """
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_CLOEXEC, 0o666)
    try:
        if stat.S_ISREG(os.fstat(descriptor).st_mode):
            _lock(descriptor, path)
            os.ftruncate(descriptor, 0)
    except BaseException:
        os.close(descriptor)
        raise
    return os.fdopen(descriptor, "wb")


def _lock(descriptor: int, path: Path) -> None:
    with suppress(OSError):
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise TraceError(
                f"{path}: another run still writes this trace; wait for its end or close() it, "
                "or name another file with --trace"
            ) from error
