"""`Watches`: what the run keeps for notifications; `Lookout`: finds what was published since the last look."""

from collections import Counter
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Final

from motionlayer.connect.ads._image import STATUS, SharedImage
from motionlayer.connect.ads._service import Watched
from motionlayer.runtime import GRAIN, History

if TYPE_CHECKING:
    from motionlayer.connect.ads._notify import Notifications

LOST: Final = "publications were overwritten before the server could look at them; notifications of theirs are lost"


class Watches:
    """Counts who watches which grain of the image; the stamp of a publication is watched with everything.

    Args:
        history: keeps what is watched.
        status: first byte of the status.
    """

    def __init__(self, history: History, status: int) -> None:
        self._history = history
        self._status = status
        self._counts: Counter[int] = Counter()

    def add(self, watched: Watched) -> int:
        """Watch something; return the version of the history from which on it is there."""
        grains = list(self._grains(watched))
        self._counts.update(grains)
        new = [grain for grain in grains if self._counts[grain] == 1]
        if new:
            self._history.mark(new, watched=True)
        return self._history.version

    def remove(self, watched: Watched) -> None:
        """Watch it no more."""
        grains = list(self._grains(watched))
        self._counts.subtract(grains)
        left = [grain for grain in grains if not self._counts[grain]]
        if left:
            self._history.mark(left, watched=False)
            for grain in left:
                del self._counts[grain]

    def _grains(self, watched: Watched) -> Iterator[int]:
        """Yield the grains that something lies in, each once."""
        found: dict[int, None] = {}
        for start, length in (*watched.spans, (self._status, STATUS.size)):
            found |= dict.fromkeys(range(start // GRAIN, -(-(start + length) // GRAIN)))
        return iter(found)


class Lookout:
    """Shows notifications what was published, one publication after the other, however late it looks.

    Args:
        image: the newest publication.
        history: those before it.
        notifications: what samples them.
        tell: takes what is lost: whom it concerns, and what it is.

    Attributes:
        lost: publications that could not be looked at, since the beginning.
    """

    def __init__(
        self, image: SharedImage, history: History, notifications: "Notifications", tell: Callable[[str, str], None]
    ) -> None:
        self._image = image
        self._history = history
        self._notifications = notifications
        self._tell = tell
        self._seen = 0
        self._kept = memoryview(bytearray(image.size + STATUS.size))
        self.lost = 0

    def look(self) -> None:
        """Look at all that was published since the last time; without notifications there is nothing to see."""
        newest, seen = self._image.count, self._seen
        self._seen = newest
        if not len(self._notifications):
            return
        self._notifications.wait()
        lost = max(0, newest - self._history.depth - seen) if seen else 0
        for count in range(max(seen, newest - self._history.depth) + 1, newest + 1):
            lost += self._missed(count)
        if lost:
            self.lost += lost
            self._tell("notifications", f"{lost} {LOST}")
        if newest == seen and self._notifications.beginning:
            self._begin()

    def _missed(self, count: int) -> bool:
        """Look at a publication; tell whether it was overwritten meanwhile."""
        tick = self._history.tick(count)
        if tick is None or not self._notifications.due(tick):
            return False
        version = self._history.read(count, self._kept)
        if version is None:
            return True
        stamp = STATUS.unpack_from(self._kept, self._image.size)[0]
        self._notifications.look(tick, stamp, self._kept, version)
        return False

    def _begin(self) -> None:
        """Let notifications begin with the newest publication, also if none is to come: the run may not be going on."""
        newest = self._image.snapshot()
        if newest.number == self._seen:
            self._notifications.look(newest.tick, newest.stamp, newest.data, self._history.version)
