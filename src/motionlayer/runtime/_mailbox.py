"""The mailbox: the only way from other threads into a run.

Other threads *post*; the cycle *applies* in step INPUTS what has been posted until then, in order of arrival, and
*acknowledges* it at the end of step OUTPUTS, when what came of it can be read outside. A `Source` has no thread that
posts: the cycle fetches from it first. Each input is handed to the listeners with its tick before it is applied: a
recorder writes it down, and `feed` does the same in a replay. What the owner of a run does to it between two ticks is
no post, but an input all the same: it is noted.

No locks between the two sides: a poster that the system suspends must not hold up the cycle. Appending to a deque and
popping from it are single steps of the interpreter, so an input is there as a whole or not at all. A mailbox in which
nothing lies costs one test in a tick.
"""

import threading
from collections import deque
from collections.abc import Callable, Iterable
from typing import Final, NamedTuple

from motionlayer.command import Ledger
from motionlayer.event import Device, Event, EventLog, Input, Kind, Level
from motionlayer.runtime._receipt import Receipt
from motionlayer.runtime._source import Source

CAPACITY: Final = 100_000
"""Inputs that may wait for the next tick."""

Handler = Callable[[bytes], bytes | None]
"""Applies an input in the cycle thread; what it returns is the result of the receipt."""


class MailboxFull(RuntimeError):  # noqa: N818 - the state, as a user would say it
    """So many inputs wait for the next tick that no more are taken; what was posted now is lost."""


class _Posted(NamedTuple):
    channel: str
    payload: bytes
    receipt: Receipt


class Mailbox:
    """Inputs from other threads, or from a recording, applied in the cycle thread.

    Args:
        ledger: tells which tick is next.
        events: where a handler that fails is told.
        capacity: inputs that may wait; threads that post at the same instant may exceed it by one each.
    """

    def __init__(self, ledger: Ledger, events: EventLog, capacity: int = CAPACITY) -> None:
        self.refused = 0
        """Inputs that were not taken because the mailbox was full."""
        self.deaf = False
        """In a replay: what is posted is acknowledged, but not applied; what came is in the recording."""
        self.on_post: Callable[[], None] | None = None
        """Called after every post, in the thread that posts; for a run that is held up, and looks at once then."""
        self.cycle_thread: int | None = None
        """The thread whose ticks are under way; it cannot wait for what they bring."""
        self._ledger = ledger
        self._events = events
        self._capacity = capacity
        self._handlers: dict[str, Handler] = {}
        self._listeners: list[Callable[[Input], None]] = []
        self._waiting: deque[_Posted] = deque()
        self._fed: deque[Input] = deque()
        self._next_fed = -1
        self._applied: list[tuple[Receipt, Exception | None]] = []
        self._source: Source | None = None
        self._closed = False
        self._count_lock = threading.Lock()

    @property
    def empty(self) -> bool:
        """Nothing that was posted waits for the next tick."""
        return not self._waiting

    @property
    def channels(self) -> list[str]:
        """Names of the channels, in the order of their registration."""
        return list(self._handlers)

    def register(self, channel: str, handler: Handler) -> None:
        """Open a channel.

        Args:
            channel: its name; `part.object`, so that names of different parts never meet.
            handler: called in the cycle thread, in step INPUTS, with each payload. What it raises reaches the poster
                and is a warning; the cycle goes on.

        Raises:
            ValueError: there is such a channel already.
        """
        if channel in self._handlers:
            raise ValueError(f"channel {channel!r} is registered already; each has one handler")
        self._handlers[channel] = handler

    def attach(self, source: Source) -> None:
        """Fetch inputs from a source in every tick from now on, until `close`."""
        self._source = source

    def listen(self, listener: Callable[[Input], None]) -> None:
        """Call `listener` with every input from now on, in the cycle thread, before it is applied."""
        self._listeners.append(listener)

    def post(self, channel: str, payload: bytes | bytearray | memoryview = b"") -> Receipt:
        """Hand an input to the next tick; any thread may call this, and never waits.

        Args:
            channel: who is to take it.
            payload: what it is; copied unless it is `bytes`.

        Returns:
            The receipt; that of a run that has ended is settled with an error.

        Raises:
            KeyError: no such channel.
            TypeError: the payload is not bytes-like.
            MailboxFull: too many wait already.
        """
        if channel not in self._handlers:
            raise KeyError(f"no channel {channel!r}; this run has {', '.join(self._handlers) or 'none'}")
        if not isinstance(payload, (bytes, bytearray, memoryview)):
            raise TypeError(f"channel {channel}: payload must be bytes, not {type(payload).__name__}")
        if len(self._waiting) >= self._capacity:
            with self._count_lock:
                self.refused += 1
            raise MailboxFull(
                f"channel {channel}: {self._capacity} inputs wait for the next tick; wait for receipts before more"
            )
        receipt = Receipt(channel, self)
        self._waiting.append(_Posted(channel, bytes(payload), receipt))
        told = self.on_post  # asked once: the cycle may take it away meanwhile
        if told is not None:
            told()
        if self._closed:  # asked after the append: whoever is last, this or `close`, finds what lies there
            self._refuse_waiting()
        return receipt

    def feed(self, inputs: Iterable[Input]) -> None:
        """Apply recorded inputs at exactly their ticks, before what is posted in these.

        Args:
            inputs: in order of their ticks, none of which has begun.

        Raises:
            KeyError: one is for a channel that this run does not have.
            ValueError: they are not in order, or the tick of one has begun.
        """
        new = list(inputs)
        last = self._fed[-1].tick if self._fed else self._ledger.tick
        for one in new:
            if one.channel not in self._handlers:
                raise KeyError(f"input at tick {one.tick}: no channel {one.channel!r}; this run has {self.channels}")
            if one.tick < last:
                raise ValueError(
                    f"input at tick {one.tick} for channel {one.channel!r}: must be at tick {last} or later, "
                    "in the order of the ticks; feed a whole recording before the run begins"
                )
            last = one.tick
        self._fed.extend(new)
        self._next_fed = self._fed[0].tick if self._fed else -1

    @property
    def fed(self) -> tuple[Input, ...]:
        """Inputs that were fed, and whose ticks are still to come."""
        return tuple(self._fed)

    def feed_again(self, inputs: tuple[Input, ...]) -> None:
        """Let these be fed, in the place of those that are: the run has gone back to a tick at which it was so."""
        self._fed.clear()
        self._fed.extend(inputs)
        self._next_fed = self._fed[0].tick if self._fed else -1

    def note(self, channel: str, payload: bytes = b"") -> None:
        """Tell the listeners of something that is done to the run now, between two ticks, past the mailbox.

        A replay applies it before anything else of the tick to come, which sees the same.

        Args:
            channel: whose handler does the same.
            payload: what it is given for that.
        """
        for listener in self._listeners:
            listener(Input(self._ledger.tick, channel, payload))

    def apply(self, tick: int) -> None:
        """Apply what has come for this tick; a stage of step INPUTS, before all others."""
        if self._source is not None:
            self._source.fetch()
        if not self._waiting and tick != self._next_fed:
            return
        fed = self._fed
        while fed and fed[0].tick == tick:
            self._handle(fed.popleft())
        self._next_fed = fed[0].tick if fed else -1
        for _ in range(len(self._waiting)):  # what comes meanwhile is for the next tick
            channel, payload, receipt = self._waiting.popleft()
            error = None if self.deaf else self._handle(Input(tick, channel, payload), receipt)
            self._applied.append((receipt, error))

    def acknowledge(self, tick: int) -> None:
        """Settle the receipts of this tick; a stage of step OUTPUTS, after all others."""
        if self._applied:
            applied, self._applied = self._applied, []
            for receipt, error in applied:
                receipt.settle(tick, error)
            if self._source is not None:
                self._source.tell()

    def close(self) -> None:
        """Refuse what waits, and everything from now on: the run has ended."""
        self._closed = True
        applied, self._applied = self._applied, []
        for receipt, error in applied:
            receipt.settle(-1, error or _run_ended(receipt.channel))
        self._refuse_waiting()
        source, self._source = self._source, None
        if source is not None:  # what it has, and what it has had of this tick, is answered, too
            source.fetch()
            source.tell()

    def _handle(self, one: Input, receipt: Receipt | None = None) -> Exception | None:
        for listener in self._listeners:
            listener(one)
        try:
            result = self._handlers[one.channel](one.payload)
        except Exception as error:  # noqa: BLE001 - a fault of a client never stops the cycle
            text = f"input of {len(one.payload)} bytes refused: {type(error).__name__}: {error}"
            source, main = f"channel {one.channel}", Device.Device_Main
            self._events.add(Event(one.tick, Level.WARNING, Kind.MESSAGE, source, text, device=main))
            return error
        if receipt is not None and result is not None:
            receipt.result = result
        return None

    def _refuse_waiting(self) -> None:
        while True:
            try:
                posted = self._waiting.popleft()
            except IndexError:  # another thread may have taken the last one
                return
            posted.receipt.settle(-1, _run_ended(posted.channel))


def _run_ended(channel: str) -> RuntimeError:
    return RuntimeError(f"channel {channel}: the run has ended; post to a run that goes on")
