"""The published image as a server reads it: the bytes of all symbols, and behind them the `Status` of the run.

The time of a tick stands in the image itself, because only the run knows it: in real time a run that was held up goes
on later, and one that was taken back begins anew.
"""

import struct
from typing import Final, NamedTuple

from motionlayer.runtime import Published

STATUS: Final = struct.Struct("<Q5H6x")
STATES: Final = 8
"""Where in a status the states of the PLC stand."""


class Status(NamedTuple):
    """What stands behind the symbols.

    Attributes:
        stamp: time of the tick, FILETIME: 100 ns since 1601, UTC.
        plc: ADS state of the motion layer.
        plc_device: its device state.
        system: ADS state of the system service.
        system_device: its device state.
        restarts: how often the run has begun anew.
    """

    stamp: int
    plc: int
    plc_device: int = 0
    system: int = 0
    system_device: int = 0
    restarts: int = 0


class SharedImage:
    """The image in shared memory; see `Image`."""

    def __init__(self, published: Published) -> None:
        self._published = published
        self.size = published.size - STATUS.size
        """Bytes of the symbols."""

    @property
    def count(self) -> int:
        """Number of publications so far."""
        return self._published.count

    @property
    def tick(self) -> int:
        """The last finished tick."""
        return self._published.tick

    def read(self, offset: int, length: int) -> bytes:
        """Return bytes of one and the same tick."""
        return self._published.read(slice(offset, offset + length))[1]

    def status(self) -> Status:
        """Return how the run is."""
        return Status(*STATUS.unpack(self._published.read(slice(self.size, None))[1]))

    def snapshot(self) -> tuple[int, int, bytes]:
        """Return the last finished tick, its stamp, and all bytes of it with the status."""
        tick, data = self._published.read(slice(None))
        return tick, STATUS.unpack_from(data, self.size)[0], data
