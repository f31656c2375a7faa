"""What answers on an AMS port: `Service`, and what it asks of the run: `Write`, `Outbox`, `Later`.

Reads are answered at once, from the last finished tick. What changes the run is a `Write`; those of one request go to
the run together, are applied in one tick, and are answered when that tick has been published. Nothing here waits.
"""

import enum
import struct
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Generic, NamedTuple, Protocol, TypeVar

from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._image import Status

if TYPE_CHECKING:
    from motionlayer.connect.ads._client import Client

T = TypeVar("T")

Bytes = bytes | memoryview


class State(enum.IntEnum):
    """ADS states (ads 2.3), as far as this server has them."""

    INVALID = 0
    RESET = 2
    START = 4
    RUN = 5
    STOP = 6
    ERROR = 11
    CONFIG = 15
    RECONFIG = 16


class Later(Generic[T]):
    """A value that is there later; whoever asked is called once."""

    __slots__ = ("_then", "_value")

    def __init__(self) -> None:
        self._then: Callable[[T], None] | None = None
        self._value: tuple[T] | None = None

    def then(self, callback: Callable[[T], None]) -> None:
        """Call `callback` with the value; at once if it is there."""
        if self._value is not None:
            callback(self._value[0])
        else:
            self._then = callback

    def settle(self, value: T) -> None:
        """Give the value; called once."""
        self._value = (value,)
        if self._then is not None:
            self._then(value)


class Kind(enum.IntEnum):
    """What a `Write` changes."""

    BYTES = 0
    BIT = 1
    CALL = 2
    FUNCTION = 3
    CONTROL = 4


class Write(NamedTuple):
    """Something that the run is asked to do.

    Attributes:
        kind: what.
        place: offset in the image, number of the bit, of the method or of the function.
        data: its bytes.
    """

    kind: Kind
    place: int
    data: bytes


class Outcome(NamedTuple):
    """What has become of a `Write`.

    Attributes:
        code: 0, or why it was refused.
        data: what a method gave back.
    """

    code: int
    data: bytes = b""


class Outbox(Protocol):
    """The way into the run."""

    def post(self, writes: Sequence[Write], client: str) -> Later[list[Outcome]]:
        """Let the run apply these in one tick; the outcomes come in their order.

        Args:
            writes: what to do.
            client: who asks, for messages.

        Raises:
            AdsError: too much waits already (0x502).
        """


class Image(Protocol):
    """The published bytes of the last finished tick."""

    @property
    def size(self) -> int:
        """Bytes of the symbols; the status of the run lies behind them."""

    def read(self, offset: int, length: int) -> bytes:
        """Return bytes of one and the same tick."""

    def status(self) -> Status:
        """Return how the run is."""

    def together(self) -> AbstractContextManager[None]:
        """Let all that is read meanwhile be of the same tick."""


DEVICE_INFO = struct.Struct("<BBH16s")


class Service:
    """A server on an AMS port; everything is refused until a subclass does it.

    Attributes:
        name: of the device, up to 16 characters.
        version: major, minor, build.
        age: grows whenever an address may have got another meaning.
    """

    name = "motionlayer"
    version = (3, 1, 4026)
    age = 0

    def device_info(self) -> bytes:
        """Return version and name."""
        return DEVICE_INFO.pack(*self.version, self.name.encode("ascii"))

    def state(self) -> tuple[int, int]:
        """Return ADS state and device state."""
        return State.RUN, 0

    def control(self, state: int, _device_state: int, data: bytes) -> Write | None:
        """Change the state; return what the run is asked for, None where it is done.

        Raises:
            AdsError: refused.
        """
        raise AdsError(Code.SERVICE_NOT_SUPPORTED, f"state {state} with {len(data)} bytes")

    def read(self, client: "Client", group: int, offset: int, length: int) -> bytes:
        """Return at most `length` bytes.

        Raises:
            AdsError: refused.
        """
        raise AdsError(Code.INVALID_GROUP, f"nothing to read in 0x{group:X}:0x{offset:X} ({length} bytes, {client})")

    def locate(self, _group: int, _offset: int, _length: int) -> tuple[int, int] | None:
        """Return first byte and length of what `read` finds in the image; None where it is not there in one piece."""
        return None

    def write(self, client: "Client", group: int, offset: int, data: bytes) -> Write | None:
        """Take bytes; return what the run is asked for, None where it is done.

        Raises:
            AdsError: refused.
        """
        raise AdsError(
            Code.INVALID_GROUP, f"nothing to write in 0x{group:X}:0x{offset:X} ({len(data)} bytes, {client})"
        )

    def read_write(self, client: "Client", group: int, offset: int, length: int, data: bytes) -> bytes | Write:
        """Take bytes and return at most `length`; or what the run is asked for, whose outcome is the answer.

        Raises:
            AdsError: refused.
        """
        raise AdsError(
            Code.INVALID_GROUP, f"nothing to ask in 0x{group:X}:0x{offset:X} ({len(data)}, {length} bytes, {client})"
        )

    def watch(self, client: "Client", group: int, offset: int, length: int) -> "Watched":
        """Return what a notification samples.

        Raises:
            AdsError: nothing is there, or not of this length.
        """
        raise AdsError(Code.INVALID_GROUP, f"nothing to watch in 0x{group:X}:0x{offset:X} ({length} bytes, {client})")


class Watched(NamedTuple):
    """What a notification samples, out of a snapshot of the image.

    Attributes:
        start: first byte.
        length: in bytes.
        bit: number of the one bit in the byte `start`, else None.
        pieces: what the value is put together from, each by its place in the value, first byte and length; the rest of
            the value is 0. Empty: it lies in the image as it is.
    """

    start: int
    length: int
    bit: int | None = None
    pieces: tuple[tuple[int, int, int], ...] = ()

    @property
    def spans(self) -> tuple[tuple[int, int], ...]:
        """First byte and length of all that it samples."""
        if self.pieces:
            return tuple((start, length) for _, start, length in self.pieces)
        return ((self.start, self.length),)

    def sample(self, image: Bytes) -> bytes:
        """Return the value in a snapshot."""
        if self.bit is not None:
            return b"\x01" if image[self.start] >> self.bit & 1 else b"\x00"
        if self.pieces:
            return gathered(self.length, self.pieces, image)
        return bytes(image[self.start : self.start + self.length])


def gathered(length: int, pieces: Sequence[tuple[int, int, int]], image: Bytes) -> bytes:
    """Return a value of a length, put together from pieces: place in the value, first byte in the image, length."""
    value = bytearray(length)
    for at, start, size in pieces:
        value[at : at + size] = image[start : start + size]
    return bytes(value[:length])
