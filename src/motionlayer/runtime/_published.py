"""`Published`: bytes of the last finished tick, for readers that nobody waits for.

The writer fills one half of a double buffer, in turns; a reader takes the half that was finished last:

    writer of publication n              reader
    begun = n                            n = done
    fill half n mod 2                    copy out of half n mod 2
    done = n                             valid if begun ≤ n + 1, else again

Half n mod 2 is written again by publication n + 2 only, which first sets `begun` to n + 2; so a copy that was disturbed
is known, and is one that took longer than a whole tick. Nobody waits for anybody. Counters and halves lie in one block
of bytes and need no lock: it may as well be memory shared with another process.
"""

from typing import Final

_DONE, _BEGUN, _TICK = 0, 1, 2  # places of the header: two counters, and the tick of each half
_HEADER: Final = 4 * 8


class Published:
    """A double buffer in a block of bytes.

    Args:
        block: of `Published.size_of` bytes, for one writer and any number of readers.
        new: it was not used before.
    """

    def __init__(self, block: memoryview, *, new: bool = True) -> None:
        size = (len(block) - _HEADER) // 2
        self.size = size
        self._header = block[:_HEADER].cast("q")
        if new:
            self._header[_TICK] = self._header[_TICK + 1] = -1
        self._halves = block[_HEADER : _HEADER + size], block[_HEADER + size : _HEADER + 2 * size]

    @staticmethod
    def size_of(size: int) -> int:
        """Return the size of a block for `size` bytes."""
        return _HEADER + 2 * size

    def begin(self, tick: int) -> memoryview:
        """Return the half that a publication is to fill, completely."""
        header = self._header
        count = header[_BEGUN] + 1
        half = count & 1
        header[_BEGUN] = count
        header[_TICK + half] = tick
        return self._halves[half]

    def finish(self) -> None:
        """Let readers see what was filled."""
        self._header[_DONE] = self._header[_BEGUN]

    @property
    def count(self) -> int:
        """Number of publications so far; it goes on where the tick does not, in a run that is held up or taken back."""
        return self._header[_DONE]

    @property
    def tick(self) -> int:
        """The last finished tick, -1 before the first."""
        return self._header[_TICK + (self._header[_DONE] & 1)]

    def read(self, where: slice) -> tuple[int, bytes]:
        """Return the last finished tick, -1 before the first, and a slice of what was published."""
        return self.whole(where)[1:]

    def whole(self, where: slice = slice(None)) -> tuple[int, int, bytes]:
        """Return number, tick and bytes of the last publication, all of them where no slice is given."""
        header = self._header
        while True:
            count = header[_DONE]
            half = count & 1
            tick, data = header[_TICK + half], bytes(self._halves[half][where])
            if header[_BEGUN] <= count + 1:
                return count, tick, data

    def release(self) -> None:
        """Give the block back; afterwards nothing can be read or written."""
        for view in (self._header, *self._halves):
            view.release()
