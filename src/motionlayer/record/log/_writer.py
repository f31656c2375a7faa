"""`LogFolder`: the files of all lists, and what happens when they cannot be written."""

import errno
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import Final, NamedTuple

from motionlayer.event import Level, MessageList
from motionlayer.record.log._errors import LogError
from motionlayer.record.log._files import Files
from motionlayer.record.log._line import note
from motionlayer.record.log._lock import Lock

HELD: Final = 16_000_000
"""Bytes of lines that are kept while they cannot be written."""

LEAST_SIZE: Final = 10_000
"""Bytes that a file must be allowed to have; a line has 1020 at most."""

_HOPES: Final = {
    errno.ENOSPC: "free space",
    errno.EDQUOT: "free space or raise the quota",
    errno.EACCES: "give the right to write there",
}


class _Piece(NamedTuple):
    """Whole lines of one list and one date."""

    of: MessageList
    date: str
    lines: bytes
    mark: bool = False
    """They are no messages, but say that some are missing."""


class LogFolder:
    """Writes lines into files, and keeps them where that fails (D69).

    Args:
        folder: the root folder; made if there is none. One run at a time writes there.
        port: what names begin with: the ADS port of the runtime.
        size: bytes of a file, at most.
        held: bytes of lines that are kept while they cannot be written.
        on_trouble: called once when lines cannot be written any more, with what to tell a person; by the thread
            that writes.

    Attributes:
        missing: lines that were given up.
        trouble: why lines could not be written the last time that was so; "" if it never was.

    Raises:
        LogError: another run writes there, or nobody can.
        ValueError: the size is too small.
    """

    def __init__(
        self,
        folder: Path,
        *,
        port: int = 851,
        size: int = 100_000_000,
        held: int = HELD,
        on_trouble: Callable[[str], None] = lambda _: None,
    ) -> None:
        if size < LEAST_SIZE:
            raise ValueError(f"message files of {size} bytes: must be at least {LEAST_SIZE}")
        self.missing = 0
        self.trouble = ""
        self._failing = False
        self._folder = folder
        self._on_trouble = on_trouble
        self._bound = held
        self._files = {one: Files(folder, f"{port}{one.value}", size) for one in MessageList}
        self._kept: deque[_Piece] = deque()
        self._bytes = 0
        self._gap = 0
        self._gap_piece: _Piece | None = None
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise LogError(f"log folder {folder} cannot be made: {error.strerror}; name another one") from error
        self._lock = Lock(folder)

    def probe(self, date: str) -> None:
        """Open the motion file of a date, so that a folder nobody can write to is found before the run begins.

        Raises:
            LogError: it cannot be written.
        """
        try:
            self._files[MessageList.MOTION].probe(date)
        except OSError as error:
            self._lock.release()
            raise LogError(
                f"{self._files[MessageList.MOTION].path(date)} cannot be written: {error.strerror}; "
                "mend that or name another log folder"
            ) from error

    def write(self, of: MessageList, date: str, lines: bytes) -> None:
        """Write whole lines, or keep them for the next try, or give them up. Never raises OSError."""
        piece = _Piece(of, date, lines)
        self.retry()
        if self._kept and self._bytes + len(lines) > self._bound:
            self._give_up(piece)
            return
        self._mark_gap()
        self._keep(piece)
        self.retry()

    def retry(self) -> None:
        """Write what is kept, as far as that works."""
        try:
            while self._kept:
                piece = self._kept.popleft()
                self._bytes -= len(piece.lines)
                self._append(piece)
        except OSError as error:
            self._fail(error)

    def sync(self) -> None:
        """Bring everything that was written to the disk."""
        try:
            for files in self._files.values():
                files.sync()
        except OSError as error:
            self._fail(error)
        else:
            self._failing = bool(self._kept)

    def close(self) -> None:
        """Write what is kept; what cannot be written now is given up."""
        try:
            self.retry()
            self._mark_gap()
            self.retry()
            self.missing += sum(piece.lines.count(b"\n") for piece in self._kept if not piece.mark)
            self.sync()
        finally:
            self._lock.release()

    def _append(self, piece: _Piece) -> None:
        """Write a piece; what could not be written comes back to the front."""
        of, date, rest, mark = piece
        try:
            while rest:
                rest = rest[self._files[of].append(date, rest) :]
        except OSError:
            self._kept.appendleft(_Piece(of, date, rest, mark))
            self._bytes += len(rest)
            raise

    def _keep(self, piece: _Piece) -> None:
        self._kept.append(piece)
        self._bytes += len(piece.lines)

    def _give_up(self, piece: _Piece) -> None:
        self.missing += (count := piece.lines.count(b"\n"))
        self._gap += count
        self._gap_piece = self._gap_piece or piece

    def _mark_gap(self) -> None:
        """Say in the file, in the place of what was given up, how much it was."""
        if self._gap_piece is None:
            return
        of, date, lines, _ = self._gap_piece
        time = lines.split(b"\t", 2)[1].decode()
        text = f"{self._gap} messages are missing here: they could not be written"
        self._keep(_Piece(of, date, note(time, Level.WARNING, self._gap, text).encode(), mark=True))
        self._gap, self._gap_piece = 0, None

    def _fail(self, error: OSError) -> None:
        if self._failing:  # until all is written, and on the disk
            return
        self._failing = True
        self.trouble = f"{error.strerror}; {_HOPES.get(error.errno or 0, 'mend that')}"
        self._on_trouble(
            f"messages cannot be written into {self._folder}: {self.trouble}: lines are kept up to {self._bound} bytes "
            "and tried again"
        )
