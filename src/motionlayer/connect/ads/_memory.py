"""`Memory`: the image of a run and its history, in memory that a server shares."""

import mmap
import os
from typing import Final

from motionlayer.runtime import History, Published

SPAN_NS: Final = 250_000_000
"""Time of the run that the history reaches back: for so long a server may be kept from running, and loses nothing."""

LEAST: Final = 16
MOST: Final = 64 * 1024 * 1024
"""Publications that are kept, at least; bytes that they take, at most. Memory that nobody watches is never touched."""


_BELL: Final = 64
"""Bytes of the counters in front."""

_RINGS, _AWAKE = 0, 1  # places of these


class Shared:
    """Image, history, and a bell, in one block.

    Args:
        block: of `Shared.size_of` bytes, zeros where it is new.
        size: bytes of the image.
        cycle_ns: of the run.
        new: it was not used before.

    Attributes:
        published: the image.
        history: what it was before.
    """

    def __init__(self, block: memoryview, size: int, cycle_ns: int, *, new: bool = True) -> None:
        end = _end(size)
        self._bell = block[:_BELL].cast("q")
        self.published = Published(block[_BELL : _BELL + Published.size_of(size)], new=new)
        self.history = History(block[end:], size, _depth(size, cycle_ns))

    @staticmethod
    def size_of(size: int, cycle_ns: int) -> int:
        """Return the size of a block for an image of `size` bytes."""
        return _end(size) + History.size_of(size, _depth(size, cycle_ns))

    @property
    def rings(self) -> int:
        """How often the server has rung."""
        return self._bell[_RINGS]

    def ring(self) -> None:
        """Let the run know that something has been sent to it: to look here costs a tick no call of the system."""
        self._bell[_RINGS] += 1

    @property
    def awake(self) -> bool:
        """The run waits for what is sent to it, and looks all the time: it answers before one could fall asleep."""
        return bool(self._bell[_AWAKE])

    @awake.setter
    def awake(self, awake: bool) -> None:
        self._bell[_AWAKE] = awake

    def release(self) -> None:
        """Give the block back; afterwards nothing can be read or written."""
        self._bell.release()
        self.published.release()
        self.history.release()


def _end(size: int) -> int:
    """Return where the history begins: at a page of memory."""
    return -(-(_BELL + Published.size_of(size)) // mmap.PAGESIZE) * mmap.PAGESIZE


def _depth(size: int, cycle_ns: int) -> int:
    return max(LEAST, min(-(-SPAN_NS // cycle_ns), MOST // max(size, 1)))


class Memory:
    """The image of a run, in memory that a server shares; it has no name, and is gone with the last who uses it."""

    def __init__(self) -> None:
        self.file = os.memfd_create("motionlayer ads")
        """File descriptor, which the server is given."""
        self._block: mmap.mmap | None = None
        self._shared: Shared | None = None

    def share(self, size: int, cycle_ns: int) -> Shared:
        """Return room for an image of so many bytes, and its history; called once."""
        whole = Shared.size_of(size, cycle_ns)
        os.ftruncate(self.file, whole)
        self._block = mmap.mmap(self.file, whole)
        self._shared = Shared(memoryview(self._block), size, cycle_ns)
        return self._shared

    def close(self) -> None:
        """Give the memory back."""
        if self._shared is not None:
            self._shared.release()
        if self._block is not None:
            self._block.close()
        os.close(self.file)
