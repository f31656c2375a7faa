"""The files of one list: by day and by size."""

import os
import re
from pathlib import Path
from typing import Final

FLAGS: Final = os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC


class Files:
    """Appends whole lines to the file of a day, and to its next part when that has its size.

    Args:
        folder: the root folder.
        root: what names begin with, `851_MSG_PLC_`.
        size: bytes of a file, at most; more than a line has.
    """

    def __init__(self, folder: Path, root: str, size: int) -> None:
        self._folder = folder
        self._root = root
        self._size = size
        self._date = ""
        self._part = 0
        self._unsynced: dict[Path, None] = {}

    def path(self, date: str) -> Path:
        """Return the file that lines of a date, `YYYY_MM_DD`, go to now."""
        if date != self._date:
            self._date, self._part = date, self._last_part(date)
        part = f"_{self._part}" if self._part else ""
        return self._folder / date / f"{self._root}{date}{part}.txt"

    def probe(self, date: str) -> None:
        """Open the file of a date, and make it if there is none.

        Raises:
            OSError: that failed.
        """
        os.close(self._open(self.path(date)))

    def append(self, date: str, lines: bytes) -> int:
        """Append lines as far as they fit; a file never ends with a piece of one.

        Returns:
            How many bytes were taken; 0 if the next part is to begin first: call again.

        Raises:
            OSError: not one line could be written.
        """
        path = self.path(date)
        file = self._open(path)
        try:
            begin = _whole(file)
            end = lines.rfind(b"\n", 0, max(0, self._size - begin)) + 1
            if end == 0:
                os.fsync(file)
                self._unsynced.pop(path, None)
                self._part += 1
                return 0
            self._unsynced[path] = None
            return _write(file, begin, lines[:end])
        finally:
            os.close(file)

    def sync(self) -> None:
        """Bring everything that was written to the disk.

        Raises:
            OSError: that failed.
        """
        while self._unsynced:
            path, _ = self._unsynced.popitem()
            for one in (path, path.parent):
                file = os.open(one, os.O_RDONLY | os.O_CLOEXEC)
                try:
                    os.fsync(file)
                finally:
                    os.close(file)

    def _open(self, path: Path) -> int:
        try:
            return os.open(path, FLAGS, 0o666)
        except FileNotFoundError:  # a new day, or somebody took the folder away
            path.parent.mkdir(parents=True, exist_ok=True)
            return os.open(path, FLAGS, 0o666)

    def _last_part(self, date: str) -> int:
        """Return the number of the last part there is; a run goes on where the one before it ended."""
        pattern = re.compile(re.escape(f"{self._root}{date}") + r"_(\d+)\.txt")
        try:
            names = [path.name for path in (self._folder / date).iterdir()]
        except OSError:  # opening the file tells it
            return 0
        return max((int(found[1]) for found in map(pattern.fullmatch, names) if found), default=0)


def _whole(file: int) -> int:
    """End a line that a killed writer left, and return the size of the file."""
    size = os.fstat(file).st_size
    if size and os.pread(file, 1, size - 1) != b"\n":
        size += os.write(file, b"\n")
    return size


def _write(file: int, begin: int, lines: bytes) -> int:
    done = 0
    try:
        while done < len(lines):
            done += os.write(file, lines[done:])
    except OSError:
        done = lines.rfind(b"\n", 0, done) + 1
        os.ftruncate(file, begin + done)
        if done == 0:
            raise
    return done
