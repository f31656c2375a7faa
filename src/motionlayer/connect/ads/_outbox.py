"""`ChannelOutbox`: requests of clients on their way to the run, and what is told to its log."""

from collections.abc import Callable, Sequence
from typing import Final

from motionlayer.connect.ads._channel import Channel
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._service import Kind, Later, Outcome, Write
from motionlayer.connect.ads._wire import Message, pack_request, unpack_outcomes

MAX_WAITING: Final = 10_000
"""Requests of all clients that wait for the run."""

MAX_UNSENT: Final = 16 * 1024 * 1024
"""Bytes of requests that the run has not taken yet."""

MOST_TOLD: Final = 20
"""Refusals a second that reach the log; the others are counted."""

_LAST: Final = 0xFFFF_FFFE


class ChannelOutbox:
    """Requests through a channel to the run; see `Outbox`.

    Args:
        channel: to the run.
        awake: tells whether the run will answer at once.
        sent: called after something was sent, with that.
    """

    def __init__(self, channel: Channel, awake: Callable[[], bool], sent: Callable[[bool], None]) -> None:
        self._channel = channel
        self._awake = awake
        self._sent = sent
        self._waiting: dict[int, Later[list[Outcome]]] = {}
        self._last = 0

    def __len__(self) -> int:
        """Return how many requests wait."""
        return len(self._waiting)

    def post(self, writes: Sequence[Write], client: str) -> Later[list[Outcome]]:
        """Hand writes to the run; the arguments are those of `Outbox.post`."""
        if len(self._waiting) >= MAX_WAITING or self._channel.unsent > MAX_UNSENT:
            raise AdsError(Code.MAILBOX_FULL, f"{len(self._waiting)} requests wait for the run")
        self._last = self._last % _LAST + 1
        later: Later[list[Outcome]] = Later()
        self._waiting[self._last] = later
        message = Message.CONTROL if writes[0].kind is Kind.CONTROL else Message.REQUEST
        awake = self._awake()  # asked before: one that is awake takes it, and is at work, when this call returns
        self._channel.send(message, pack_request(client, writes), self._last)
        self._sent(awake)
        return later

    def settle(self, number: int, data: bytes) -> None:
        """Take the outcomes of a request."""
        self._waiting.pop(number).settle(unpack_outcomes(data))


class Teller:
    """Tells the log of the run what was refused, but not more than it can bear.

    Args:
        channel: to the run.
        now: returns seconds of some clock.
    """

    def __init__(self, channel: Channel, now: Callable[[], float]) -> None:
        self._channel = channel
        self._now = now
        self._second = -1
        self._told = self._left_out = 0

    def __call__(self, who: str, why: str) -> None:
        """Tell who was refused, and why."""
        second = int(self._now())
        if second != self._second:
            left_out, self._left_out = self._left_out, 0
            self._second, self._told = second, 0
            if left_out:
                self._tell("clients", f"{left_out} more refusals are not told one by one")
        if self._told >= MOST_TOLD:
            self._left_out += 1
            return
        self._told += 1
        self._tell(who, why)

    def _tell(self, who: str, why: str) -> None:
        self._channel.send(Message.TOLD, f"{who}\0{why}".encode())
