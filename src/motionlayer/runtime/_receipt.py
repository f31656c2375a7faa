"""`Receipt`: what has become of an input that was posted."""

import threading
from typing import Protocol


class Cycle(Protocol):
    """Whose ticks settle a receipt."""

    @property
    def cycle_thread(self) -> int | None:
        """The thread whose ticks are under way; it cannot wait for what they bring."""


class Receipt:
    """What has become of one posted input; any thread may ask.

    Attributes:
        channel: where it was posted.
        settled: it has been applied and published, or its end is known to be an error.
        result: what the handler of the channel gave back; empty before, and where it gave nothing.
    """

    __slots__ = ("_cycle", "_error", "_latch", "_tick", "channel", "result", "settled")

    def __init__(self, channel: str, cycle: Cycle) -> None:
        self.channel = channel
        self._cycle = cycle
        self.settled = False
        self.result = b""
        self._tick = -1
        self._error: Exception | None = None
        self._latch = threading.Lock()  # locked until settled; a third of the cost of threading.Event
        self._latch.acquire()

    def wait(self, timeout: float = 10.0) -> int:
        """Wait, in another thread than that of the cycle, until the input has been applied and its outcome published.

        Args:
            timeout: how long at most, in seconds of wall time.

        Returns:
            The tick that applied it.

        Raises:
            TimeoutError: it has not been applied by then; it may still be.
            RuntimeError: the run ended before, or the thread of the cycle would wait for itself.
            Exception: whatever the handler of the channel raised.
        """
        if not self.settled and self._cycle.cycle_thread == threading.get_ident():
            raise RuntimeError(
                f"channel {self.channel}: wait() in a tick would hold up the run that it waits for; "
                "in a program `await run.until(lambda: receipt.settled)`"
            )
        if not self._latch.acquire(timeout=timeout):
            raise TimeoutError(f"channel {self.channel}: not applied within {timeout:g} s; is the run being stepped?")
        self._latch.release()
        if self._error is not None:
            raise self._error
        return self._tick

    def settle(self, tick: int, error: Exception | None = None) -> None:
        """Tell those who wait; called once, by the mailbox."""
        self._tick, self._error = tick, error
        self.settled = True
        self._latch.release()
