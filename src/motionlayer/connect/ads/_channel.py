"""`Channel`: messages between a run and its server, over a stream socket. Neither side ever waits for the other."""

import socket
import struct
import time
from typing import TYPE_CHECKING, Final, NamedTuple

from motionlayer.connect.ads._wire import Message

if TYPE_CHECKING:
    from collections.abc import Callable

_HEAD: Final = struct.Struct("<BII")
"""What a message is, the number of the request, and the bytes behind that."""

PIECE: Final = 256 * 1024
"""Bytes that are received at once, at most: a large request takes more than one look, so that no tick gets long."""


class Received(NamedTuple):
    """A message that has come.

    Attributes:
        message: what it is.
        number: of the request; 0 where it belongs to none.
        data: the rest.
    """

    message: int
    number: int
    data: bytes


class Channel:
    """One end.

    Args:
        end: a connected stream socket; the channel closes it.

    Attributes:
        on_send: called whenever something was sent.
        more: something may be left of what had come at the last look.
    """

    def __init__(self, end: socket.socket) -> None:
        end.setblocking(False)
        self._socket = end
        self._unsent = bytearray()
        self._rest = bytearray()
        self._come: list[Received] = []
        self.more = False
        self.on_send: Callable[[], None] = lambda: None
        self._piece = memoryview(bytearray(PIECE))

    def fileno(self) -> int:
        """Return the file descriptor, -1 once it is closed."""
        return self._socket.fileno()

    @property
    def unsent(self) -> int:
        """Bytes that the other side has not taken yet; see `flush`."""
        return len(self._unsent)

    def send(self, message: Message, data: bytes = b"", number: int = 0) -> None:
        """Send a message, as far as the other side takes it."""
        self._put(_HEAD.pack(message, number, len(data)) + data)

    def send_all(self, message: Message, answers: list[tuple[int, bytes]]) -> None:
        """Send messages of one kind, each with its number, at once."""
        self._put(b"".join([_HEAD.pack(message, number, len(data)) + data for number, data in answers]))

    def flush(self) -> None:
        """Send the rest, as far as the other side takes it now."""
        unsent, self._unsent = bytes(self._unsent), bytearray()
        if unsent:
            self._put(unsent)

    def receive(self) -> list[Received]:
        """Return the messages that are complete now; none if nothing has come.

        Raises:
            EOFError: the other side is gone.
        """
        if self._come:
            come, self._come = self._come, []
            return come
        try:
            length = self._socket.recv_into(self._piece)
        except (BlockingIOError, TimeoutError):
            self.more = False
            return []
        except OSError as error:
            raise EOFError from error
        if not length:
            raise EOFError
        self.more = length == PIECE
        piece = self._piece[:length]
        if not self._rest and length >= _HEAD.size:  # the usual piece is one message
            message, number, size = _HEAD.unpack_from(piece)
            if size == length - _HEAD.size:
                return [Received(message, number, bytes(piece[_HEAD.size :]))]
        self._rest += piece
        return self._complete()

    def wait(self, seconds: float) -> Received:
        """Return the next message; this call waits. What has come behind it is left to the next call.

        Raises:
            TimeoutError: none comes in time.
            EOFError: the other side is gone.
        """
        end = time.monotonic() + seconds
        try:
            while (left := end - time.monotonic()) > 0.0:
                self._socket.settimeout(left)
                if come := self.receive():
                    self._come = come[1:]
                    return come[0]
        finally:
            self._socket.setblocking(False)
        raise TimeoutError(f"no message within {seconds:g} s")

    def drain(self, seconds: float) -> None:
        """Wait so long at most until the other side has taken everything; there is nobody else to care for."""
        self._socket.settimeout(seconds)
        self.flush()
        self._socket.setblocking(False)

    def close(self) -> None:
        """Close this end."""
        self._socket.close()

    def _put(self, data: bytes) -> None:
        if self._unsent:
            self._unsent += data
            return
        sent = 0
        try:
            while sent < len(data):
                sent += self._socket.send(memoryview(data)[sent:] if sent else data)
        except (BlockingIOError, TimeoutError):
            self._unsent += data[sent:]
        except OSError:  # the other side is gone, and nobody waits for it
            return
        self.on_send()

    def _complete(self) -> list[Received]:
        """Take the whole messages out of what has come."""
        rest, found, at = self._rest, [], 0
        while len(rest) - at >= _HEAD.size:
            message, number, size = _HEAD.unpack_from(rest, at)
            stop = at + _HEAD.size + size
            if stop > len(rest):
                break
            found.append(Received(message, number, bytes(rest[at + _HEAD.size : stop])))
            at = stop
        del rest[:at]
        return found
