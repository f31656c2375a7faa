"""`Stream`: one TCP connection of the server, a thin shell around `Connection`."""

import asyncio
import math
import socket
from typing import Final, cast

from motionlayer.connect.ads._connection import Connection
from motionlayer.connect.ads._frame import FrameError
from motionlayer.connect.ads._router import Router

OPTIONS: Final = (
    (socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1),
    (socket.IPPROTO_TCP, socket.TCP_KEEPIDLE, 30),
    (socket.IPPROTO_TCP, socket.TCP_KEEPINTVL, 10),
    (socket.IPPROTO_TCP, socket.TCP_KEEPCNT, 3),
    (socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, 60_000),
    (socket.IPPROTO_TCP, socket.TCP_NODELAY, 1),
)
"""A peer that has vanished is noticed after a minute, also while something is on its way to it: probes are sent on a
connection only where nothing is, and without a time of its own that would be repeated for a quarter of an hour. What is
sent goes out at once."""


class Stream(asyncio.Protocol):
    """One TCP connection. Whoever is there may be quiet for as long as it likes, as with the router of a controller.

    AdsLib, and pyads with it, connects long before it first asks for something, and never connects again. So time ends
    only a connection that leaves a frame half sent; one that has said nothing at all makes room when others want it.

    Args:
        router: what all connections share.
        streams: all that are open; this one is added and removed.

    Attributes:
        silent_since: time of the loop at which it was opened, s; infinite once something has come.
    """

    def __init__(self, router: Router, streams: "set[Stream]") -> None:
        self._router = router
        self._streams = streams
        self._transport: asyncio.Transport | None = None
        self._connection: Connection | None = None
        self._host = ""
        self.silent_since = math.inf

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Take the connection, or close it at once."""
        transport = cast("asyncio.Transport", transport)  # those of uvloop are none by their type
        peer = transport.get_extra_info("peername")
        if peer is None:  # whoever it was has reset the connection before it was taken
            transport.abort()
            return
        self._host = peer[0]
        why = self._refusal()
        if why:
            self._router.tell(self._host, why)
            transport.abort()
            return
        for level, option, value in OPTIONS:
            transport.get_extra_info("socket").setsockopt(level, option, value)
        self._transport = transport
        self._streams.add(self)
        self._connection = Connection(self._router, self._host, self._send)
        self.silent_since = asyncio.get_running_loop().time()

    def data_received(self, data: bytes) -> None:
        """Answer what has come."""
        if self._connection is None or self._transport is None:
            return
        if self.silent_since < math.inf:
            self.silent_since = math.inf
            self._watch(self._connection)
        try:
            self._connection.receive(data)
        except FrameError as error:
            self._drop(str(error))
        else:
            if self._connection.closing:
                self._transport.close()

    def connection_lost(self, _error: Exception | None) -> None:
        """Release what the connection held."""
        self._streams.discard(self)
        self._transport = None
        if self._connection is not None:
            self._connection.closed()

    def close(self) -> None:
        """Close the connection; the server ends."""
        if self._transport is not None:
            self._transport.abort()

    def _send(self, data: bytes) -> None:
        transport = self._transport
        if transport is None or transport.is_closing():
            return
        transport.write(data)
        if transport.get_write_buffer_size() > self._router.limits.unsent:
            self._drop("takes nothing that is sent to it, and is disconnected")

    def _drop(self, why: str) -> None:
        self._router.tell(self._host, why)
        if self._connection is not None:
            self._connection.broken = True
        if self._transport is not None:
            self._transport.abort()

    def _refusal(self) -> str:
        """Return why the connection is not taken, "" if it is."""
        if not self._router.access.admits(self._host):
            return "its address is not allowed to connect"
        full = len(self._streams) >= self._router.limits.connections and not self._make_room()
        return "too many connections" if full else ""

    def _make_room(self) -> bool:
        """Disconnect whoever has been silent longest, if it has never said a word; tell whether there is room."""
        silent = min(self._streams, key=lambda one: one.silent_since)
        if asyncio.get_running_loop().time() - silent.silent_since < self._router.limits.silence:
            return False
        silent._drop("has said nothing yet, and makes room for another client")  # noqa: SLF001 - one of its own kind
        self._streams.discard(silent)  # the loop tells it later that it is closed
        return True

    def _watch(self, connection: Connection) -> None:
        """Look now and then whether a frame that had begun has come to its end."""
        if self._transport is None:
            return
        if connection.stuck():
            self._drop("sends no complete frame, and is disconnected")
        else:
            asyncio.get_running_loop().call_later(self._router.limits.silence, self._watch, connection)
