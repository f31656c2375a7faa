"""The published image as a server reads it: the bytes of all symbols, and behind them the `Status` of the run.

The time of a tick stands in the image itself, because only the run knows it: in real time a run that was held up goes
on later, and one that was taken back begins anew.
"""

import contextlib
import struct
from collections.abc import Iterator
from typing import Final, NamedTuple

from motionlayer.runtime import Published

STATUS: Final = struct.Struct("<Q5H6x")
STATES: Final = 8
"""Where in a status the states of the PLC stand."""

BEGINNINGS: Final = 16
"""Where in a status stands how often the run has begun."""


class Status(NamedTuple):
    """What stands behind the symbols.

    Attributes:
        stamp: time of the tick, FILETIME: 100 ns since 1601, UTC.
        plc: ADS state of the motion layer.
        plc_device: its device state.
        system: ADS state of the system service.
        system_device: its device state.
        beginnings: how often the run has begun, 1 without a restart; clients that see it change look for everything
            anew.
    """

    stamp: int
    plc: int
    plc_device: int = 0
    system: int = 0
    system_device: int = 0
    beginnings: int = 1


class Snapshot(NamedTuple):
    """A publication.

    Attributes:
        number: of the publication.
        tick: of the run.
        stamp: time of the tick, FILETIME.
        data: all bytes, with the status.
    """

    number: int
    tick: int
    stamp: int
    data: bytes


class SharedImage:
    """The image in shared memory; see `Image`.

    Args:
        published: the image.
    """

    def __init__(self, published: Published) -> None:
        self._published = published
        self.size = published.size - STATUS.size
        """Bytes of the symbols."""
        self._together = False
        self._held: bytes | None = None

    @property
    def count(self) -> int:
        """Number of publications so far."""
        return self._published.count

    def read(self, offset: int, length: int) -> bytes:
        """Return bytes of one and the same tick."""
        if self._together:
            return self._whole()[offset : offset + length]
        return self._published.whole(slice(offset, offset + length))[2]

    def status(self) -> Status:
        """Return how the run is."""
        return Status(*STATUS.unpack(self.read(self.size, STATUS.size)))

    @contextlib.contextmanager
    def together(self) -> Iterator[None]:
        """Let all that is read meanwhile be of the same tick."""
        self._together = True
        try:
            yield
        finally:
            self._together, self._held = False, None

    def snapshot(self) -> Snapshot:
        """Return the last publication as a whole."""
        number, tick, data = self._published.whole()
        return Snapshot(number, tick, STATUS.unpack_from(data, self.size)[0], data)

    def _whole(self) -> bytes:
        if self._held is None:
            self._held = self._published.whole()[2]
        return self._held
