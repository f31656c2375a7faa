"""`Pump`: the thread between the cycle and the sink; blocks go there full and come back empty."""

from collections.abc import Callable, Iterable, Mapping
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Any, NamedTuple

from motionlayer.record._block import Block
from motionlayer.record._errors import TraceError
from motionlayer.record._sink import Mark, Sink


class _Return(NamedTuple):
    """Stands between two blocks in the queue: what came since the mark is forgotten."""

    mark: Mark
    changes: Mapping[str, Any]


class Pump:
    """Hands blocks to a sink in a thread of its own. Its methods belong to the cycle thread.

    After a failure blocks are only given back, so that the cycle never hangs.

    Args:
        sink: used by the thread alone until `close` has returned.
        blocks: free ones.
    """

    def __init__(self, sink: Sink, blocks: Iterable[Block]) -> None:
        self._sink = sink
        self._error: BaseException | None = None
        self._free: SimpleQueue[Block] = SimpleQueue()
        self._full: SimpleQueue[Block | _Return | SimpleQueue[Mark] | None] = SimpleQueue()
        for block in blocks:
            self._free.put(block)
        # A daemon: a run that dies without closing must not hang; its file is readable to the last block.
        self._thread = Thread(target=self._work, name="trace writer", daemon=True)
        self._thread.start()

    @property
    def running(self) -> bool:
        """Whether blocks are still taken."""
        return self._thread.is_alive()

    def empty(self, *, wait: bool) -> Block | None:
        """Return an empty block, None if there is none and `wait` is False."""
        try:
            return self._free.get(wait)
        except Empty:
            return None

    def put(self, block: Block) -> None:
        """Hand over a block; it comes back."""
        self._full.put(block)

    def mark(self) -> Mark:
        """Wait until the sink has taken all blocks that were handed over; return what it has then."""
        answer: SimpleQueue[Mark] = SimpleQueue()
        self._full.put(answer)
        return answer.get()

    def go_back(self, mark: Mark, changes: Mapping[str, Any]) -> None:
        """Let the sink forget all blocks that were handed over since a mark, and change the header."""
        self._full.put(_Return(mark, changes))

    def close(self) -> None:
        """Let the sink finish, and wait for it."""
        self._full.put(None)
        self._thread.join()

    def check(self) -> None:
        """Raise what went wrong in the thread.

        Raises:
            TraceError: something could not be written.
        """
        error = self._error
        if isinstance(error, TraceError):
            raise TraceError(str(error)) from error
        if error is not None:
            raise TraceError(f"the trace writer failed: {error!r}; this is a defect of motionlayer") from error

    def _work(self) -> None:
        while (item := self._full.get()) is not None:
            if isinstance(item, Block):
                self._guarded(self._sink.write, item)
                item.clear()
                self._free.put(item)
            elif isinstance(item, _Return):
                self._guarded(self._sink.go_back, *item)
            else:
                item.put(self._sink.mark())
        self._guarded(self._sink.finish)
        self._sink.abandon()

    def _guarded(self, action: Callable[..., None], *arguments: object) -> None:
        if self._error is not None:
            return
        try:
            action(*arguments)
        except BaseException as error:  # noqa: BLE001 - it is raised in the cycle thread
            self._error = error
