"""`Inside`: what the cycle does for a server: it publishes the symbols and applies what clients wrote."""

import bisect
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Final, NamedTuple, Protocol, runtime_checkable

from motionlayer.connect.ads._codes import Code
from motionlayer.connect.ads._describe import Placed
from motionlayer.connect.ads._image import STATUS, Status
from motionlayer.connect.ads._memory import Shared
from motionlayer.connect.ads._service import Kind, Outcome, Write
from motionlayer.connect.ads._wire import pack_outcomes, unpack_request

if TYPE_CHECKING:
    from motionlayer.iec import Memory

Act = Callable[[Write, str], Outcome]
"""Does what one kind of request asks for; gets who asks."""

_REFUSED: Final[tuple[tuple[type[Exception], Code], ...]] = (
    (PermissionError, Code.NOT_PERMITTED),
    (IndexError, Code.INVALID_OFFSET),
    (ValueError, Code.INVALID_DATA),
    (TypeError, Code.INVALID_DATA),
)
"""What a write may raise, and how that is answered."""

_KINDS: Final = tuple(kind for kind, _ in _REFUSED)


LARGE: Final = 4096
"""Bytes of a variable that is copied by itself."""


class _Stretch(NamedTuple):
    """Variables that are published in one piece.

    Attributes:
        where: in the image.
        pieces: their bytes, and those between them.
    """

    where: slice
    pieces: "list[bytes | Memory]"


@runtime_checkable
class Stale(Protocol):
    """A variable whose bytes are brought up to date when they are published."""

    def publish(self) -> None:
        """Bring the bytes up to date."""


class Inside:
    """The side of the cycle; it is there in every run, so that a recorded one can be repeated without a server.

    Args:
        places: returns all symbols with their places in the image; called once, when they are all known.
        acts: what else can be asked for, by kind.
    """

    def __init__(self, places: Callable[[], Sequence[Placed]], acts: Mapping[Kind, Act] | None = None) -> None:
        self._find_places = places
        self._known: list[Placed] | None = None
        self._starts: list[int] = []
        self._shared: Shared | None = None
        self._status: Callable[[int], Status] = lambda _tick: Status(0, 0)
        self._stale: list[Stale] = []
        self._stretches: list[_Stretch] = []
        self._acts: dict[Kind, Act] = {Kind.BYTES: self._bytes, Kind.BIT: self._bit, **(acts or {})}

    @property
    def places(self) -> Sequence[Placed]:
        """All symbols with their places, in order."""
        if self._known is None:
            self._known = list(self._find_places())
            self._starts = [one.start for one in self._known]
        return self._known

    @property
    def size(self) -> int:
        """Bytes of the image: the symbols, and the status behind them."""
        end = self.places[-1].stop if self.places else 0
        return -(-end // 8) * 8 + STATUS.size

    def begin(self, shared: Shared, status: Callable[[int], Status]) -> None:
        """Publish from now on.

        Args:
            shared: room for `size` bytes.
            status: returns how the run is after a tick.
        """
        self._shared, self._status = shared, status
        self._stale = [one.symbol.source for one in self.places if isinstance(one.symbol.source, Stale)]
        self._stretches = _stretches(self.places)

    def end(self) -> None:
        """Publish no more."""
        self._shared = None

    def publish(self, tick: int) -> None:
        """Let servers see this tick; a stage of step OUTPUTS."""
        shared = self._shared
        if shared is None:
            return
        published = shared.published
        for source in self._stale:
            source.publish()
        image = published.begin(tick)
        for where, pieces in self._stretches:
            image[where] = pieces[0] if len(pieces) == 1 else b"".join(pieces)
        STATUS.pack_into(image, published.size - STATUS.size, *self._status(tick))
        shared.history.keep(published.count + 1, tick, image)
        published.finish()

    def apply(self, payload: bytes) -> bytes:
        """Do what a request asks for, in its order; the handler of the channel."""
        client, writes = unpack_request(payload)
        return pack_outcomes([self._outcome(write, client) for write in writes])

    def _outcome(self, write: Write, client: str) -> Outcome:
        act = self._acts.get(write.kind)
        if act is None:
            return Outcome(Code.SERVICE_NOT_SUPPORTED)
        try:
            return act(write, client)
        except _KINDS as error:
            return Outcome(next(code for kind, code in _REFUSED if isinstance(error, kind)))

    def _at(self, offset: int) -> Placed:
        places = self.places
        return places[bisect.bisect_right(self._starts, offset) - 1]

    def _bytes(self, write: Write, client: str) -> Outcome:
        place = self._at(write.place)
        place.symbol.source.write(write.place - place.start, write.data, client)
        return Outcome(Code.NO_ERROR)

    def _bit(self, write: Write, client: str) -> Outcome:
        offset, bit = divmod(write.place, 8)
        place = self._at(offset)
        source, at = place.symbol.source, offset - place.start
        (old,) = source.read(at, 1)
        source.write(at, bytes((old & ~(1 << bit) | bool(write.data[:1].strip(b"\0")) << bit,)), client)
        return Outcome(Code.NO_ERROR)


def _stretches(places: Sequence[Placed]) -> list[_Stretch]:
    """Return what is copied to publish all variables: to join small ones takes half the time of one copy for each."""
    found: list[_Stretch] = []
    pieces: list[bytes | Memory] = []
    start = stop = 0
    for one in places:
        memory = one.symbol.source.memory
        if len(memory) >= LARGE:
            if pieces:
                found.append(_Stretch(slice(start, stop), pieces))
            found.append(_Stretch(slice(one.start, one.stop), [memory]))
            pieces, start = [], one.stop
        else:
            pieces += [bytes(one.start - stop), memory]
        stop = one.stop
    if pieces:
        found.append(_Stretch(slice(start, stop), pieces))
    return found
