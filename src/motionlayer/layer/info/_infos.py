"""`AxisInfos`: Info of all axes, in every cycle (motion-layer 6, the intended meaning; D13).

One kernel fills the output image of all axes from `NcToPlc` and from what their controllers say, seen as words of 16
bits: the fields of a structure of pack mode 2 begin at even bytes, so that a number of 8 bytes is four words in both.
"""

from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer.layer.info._kernels import COUNT_BITS, ERRORS, FLAGS, NEW_ERRORS, ROWS, TURNED, Words, fill_info

if TYPE_CHECKING:
    from motionlayer.iec import OutputArray
    from motionlayer.layer.types import AxisInfo
    from motionlayer.nc import AxisRefs


class Flag:
    """What a controller says of its axis; plain integers, because every command sets some."""

    INITIALISED: Final = 1
    ERROR: Final = 2
    """A command has ended in error, or does not exist; until the error is cleared."""
    TIMEOUT: Final = 4
    REQUESTED: Final = 8
    """A command is under way."""


class Found(NamedTuple):
    """What has changed since the last call, as places of axes.

    Attributes:
        errors: axes with an error that they did not have before.
        turned: axes whose drive has a reference switch that has turned.
    """

    errors: list[int]
    turned: list[int]


class AxisInfos:
    """Fills `GVL_AXIS.Info`.

    Args:
        images: the cyclic interface of the axes.
        info: the symbol.

    Attributes:
        flags: see `Flag`, one element per axis.
        errors: number of the error with which the last command ended, 0 without.
        switches: of the drives, 1.0 is on.
    """

    def __init__(self, images: "AxisRefs", info: "OutputArray[AxisInfo]") -> None:
        count = len(images.nc_to_plc)
        self._memory: NDArray[np.int64] = np.zeros((ROWS, count), np.int64)
        self.flags = self._memory[FLAGS]
        self.errors = self._memory[ERRORS]
        self.switches = images.switches
        self._source = _words(images.nc_to_plc.view(np.uint8), count)
        self._shown = _words(np.frombuffer(info.memory, np.uint8), count)
        fill_info(self._source, self._shown, self._memory, 0.0 * self.switches)  # loaded before the first cycle

    def fill(self) -> Found | None:
        """Show what is valid now; return what has changed, None if nothing has."""
        found = fill_info(self._source, self._shown, self._memory, self.switches)
        if not found:
            return None
        errors, turned = found & (1 << COUNT_BITS) - 1, found >> COUNT_BITS
        return Found(self._memory[NEW_ERRORS, :errors].tolist(), self._memory[TURNED, :turned].tolist())


def _words(raw: NDArray[np.uint8], count: int) -> Words:
    """Return bytes as words, one row per axis."""
    return raw.reshape(count, -1).view(np.uint16)
