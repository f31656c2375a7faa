"""One run writes into a folder; the operating system gives it back, however the run ends."""

import fcntl
import os
from pathlib import Path
from typing import Final

from motionlayer.record.log._errors import LogError

NAME: Final = ".lock"


class Lock:
    """Holds a folder until `release`, or the end of the process.

    Raises:
        LogError: another run has it, or the lock file cannot be written.
    """

    def __init__(self, folder: Path) -> None:
        path = folder / NAME
        try:
            self._file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o666)
        except OSError as error:
            raise LogError(f"log folder {folder}: {path} cannot be written: {error.strerror}; name another") from error
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            os.ftruncate(self._file, 0)
            os.write(self._file, str(os.getpid()).encode())
        except OSError as error:
            holder = os.pread(self._file, 20, 0).decode(errors="replace")
            os.close(self._file)
            if not isinstance(error, BlockingIOError):
                raise LogError(f"log folder {folder}: {path}: {error.strerror}; name another folder") from error
            if holder == str(os.getpid()):
                raise LogError(
                    f"log folder {folder}: another run of this process writes there; close() it before, "
                    "or run it in a with block"
                ) from error
            raise LogError(
                f"log folder {folder}: the run of process {holder or 'unknown'} writes there; wait for its end, "
                "or name another folder: [log] folder, or --log DIR"
            ) from error

    def release(self) -> None:
        """Give the folder back."""
        os.close(self._file)
