"""`Client`: one AMS address on a connection, and what it holds."""

import functools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final

from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._frame import Address

LOGGED: Final = (
    Code.NOT_PERMITTED,
    Code.ACCESS_DENIED,
    Code.NO_MORE_HANDLES,
    Code.WATCH_SIZE,
    Code.MAILBOX_FULL,
)
"""Refusals that the log tells."""


@dataclass(frozen=True)
class Limits:
    """What a server holds for its clients, at most.

    Attributes:
        connections: of all clients together.
        addresses: AMS addresses that ask through a connection, and AMS ports that it registers.
        handles: of a client.
        all_handles: of all clients together.
        notifications: of a client; the vendor advises 550.
        all_notifications: of all clients together.
        watched: bytes of a client's notifications, in all.
        waiting: requests of a connection that wait for the run.
        unsent: bytes for a connection that does not take them; it is closed then.
        silence: seconds for the rest of a frame that has begun; the connection is closed after that. Whoever has said
            nothing for so long makes room where there are too many connections.
    """

    connections: int = 64
    addresses: int = 64
    handles: int = 10_000
    all_handles: int = 100_000
    notifications: int = 2_000
    all_notifications: int = 20_000
    watched: int = 1024 * 1024
    waiting: int = 1_000
    unsent: int = 16 * 1024 * 1024
    silence: float = 10.0


@dataclass(eq=False)
class Client:
    """Who asks.

    Attributes:
        address: AMS address.
        host: where its connection comes from.
        read_only: it may change nothing.
        limits: what it may hold.
        tell: takes why something was refused, for the log.
        handles: its handles.
        notifications: its notifications.
        watched: bytes of these.
    """

    address: Address
    host: str
    read_only: bool = False
    limits: Limits = field(default_factory=Limits)
    tell: Callable[[str], None] = field(default=lambda _why: None, repr=False)
    handles: set[int] = field(default_factory=set)
    notifications: set[int] = field(default_factory=set)
    watched: int = 0

    def refused(self, error: AdsError) -> None:
        """Take up a refusal: those that concern access and limits are logged, others are between client and server."""
        if error.code in LOGGED:
            self.tell(str(error))

    def require_writing(self) -> None:
        """Refuse a client that may change nothing.

        Raises:
            AdsError: it may not (0x704).
        """
        if self.read_only:
            raise AdsError(Code.NOT_PERMITTED, f"{self} may only read")

    @functools.cached_property
    def name(self) -> str:
        """Who it is, for messages."""
        return f"{self.address} at {self.host}"

    def __str__(self) -> str:
        return self.name
