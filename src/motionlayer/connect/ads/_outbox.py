"""`PipeOutbox`: requests of clients on their way to the run, and what is told to its log."""

from collections.abc import Callable, Sequence
from multiprocessing.connection import Connection as Pipe
from typing import Final

from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._service import Kind, Later, Outcome, Write
from motionlayer.connect.ads._wire import NUMBER, Message, head, pack_request, unpack_outcomes

MAX_WAITING: Final = 10_000
"""Requests of all clients that wait for the run."""

MOST_TOLD: Final = 20
"""Refusals a second that reach the log; the others are counted."""

_LAST: Final = 0xFFFF_FFFE


class PipeOutbox:
    """Requests through a pipe to the run; see `Outbox`."""

    def __init__(self, pipe: Pipe) -> None:
        self._pipe = pipe
        self._waiting: dict[int, Later[list[Outcome]]] = {}
        self._last = 0

    def post(self, writes: Sequence[Write], client: str) -> Later[list[Outcome]]:
        """Hand writes to the run; the arguments are those of `Outbox.post`."""
        if len(self._waiting) >= MAX_WAITING:
            raise AdsError(Code.MAILBOX_FULL, f"{len(self._waiting)} requests wait for the run")
        self._last = self._last % _LAST + 1
        later: Later[list[Outcome]] = Later()
        self._waiting[self._last] = later
        message = Message.CONTROL if writes[0].kind is Kind.CONTROL else Message.REQUEST
        self._pipe.send_bytes(NUMBER.pack(message, self._last) + pack_request(client, writes))
        return later

    def settle(self, message: bytes) -> None:
        """Take the outcomes of a request."""
        _, number = NUMBER.unpack_from(message)
        self._waiting.pop(number).settle(unpack_outcomes(message[NUMBER.size :]))


class Teller:
    """Tells the log of the run what was refused, but not more than it can bear.

    Args:
        pipe: to the run.
        now: returns seconds of some clock.
    """

    def __init__(self, pipe: Pipe, now: Callable[[], float]) -> None:
        self._pipe = pipe
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
        self._pipe.send_bytes(head(Message.TOLD) + f"{who}\0{why}".encode())
