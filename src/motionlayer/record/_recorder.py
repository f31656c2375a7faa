"""`Recorder`: one kernel call per cycle; everything else happens in its thread, one block at a time."""

import hashlib
from collections.abc import Callable, Sequence
from pathlib import Path
from queue import SimpleQueue
from threading import Thread
from typing import Any, Final, Self

import numpy as np
from numpy.typing import NDArray

from motionlayer._kernel import kernel
from motionlayer.event import Event
from motionlayer.record._errors import TraceError
from motionlayer.record._records import Plan, Signal, encode_event
from motionlayer.record._trace import Trace
from motionlayer.record._writer import TraceWriter

Floats = NDArray[np.float64]

HASHED_ROWS: Final = 4
"""The first rows of the table: set position, velocity, acceleration, actual position."""

DIGEST_SIZE: Final = 16
BLOCKS: Final = 3
"""One is filled, one is written, one absorbs the jitter between the two."""

BLOCK_BYTES: Final = 1 << 21
BLOCK_TICKS: Final = (64, 1024)
"""Least and most ticks of a block: what its thread costs is shared by many, what a crash loses is bounded."""


@kernel
def gather(flat: Floats, index: NDArray[np.int64], block: Floats, row: int) -> None:
    """Copy the selected values of a table into a row of `block`, then as many of its first as fit."""
    count = index.shape[0]
    for k in range(count):
        block[row, k] = flat[index[k]]
    for k in range(block.shape[1] - count):
        block[row, count + k] = flat[k]


class _Block:
    """Rows of consecutive ticks, and the plans and events that came with them."""

    __slots__ = ("count", "events", "first", "plans", "values")

    def __init__(self, ticks: int, width: int) -> None:
        self.values = np.zeros((ticks, width))
        self.clear()

    def clear(self) -> None:
        self.first = 0
        self.count = 0
        self.plans: list[Plan] = []
        self.events: list[Event] = []


class RunHash:
    """The hash of a run, fed block by block."""

    def __init__(self) -> None:
        self._numbers = hashlib.blake2b(digest_size=DIGEST_SIZE)
        self._events = hashlib.blake2b(digest_size=DIGEST_SIZE)

    def numbers(self, rows: Floats) -> None:
        """Take in the hashed rows of the table, shape (ticks, 4 * columns)."""
        self._numbers.update(rows.tobytes())

    def event(self, event: Event) -> None:
        """Take in an event; JSON escapes line ends, so one per line is unambiguous."""
        self._events.update(encode_event(event) + b"\n")

    def hexdigest(self, ticks: int) -> str:
        """Return the hash over all that was taken in and the number of ticks."""
        both = self._numbers.digest() + self._events.digest() + ticks.to_bytes(8, "little")
        return hashlib.blake2b(both, digest_size=DIGEST_SIZE).hexdigest()


class Recorder:
    """Records a run. Its methods belong to the cycle thread; a `with` block closes it.

    Args:
        table: float64, C-contiguous, never moved while recording; the hash is over its first four rows.
        signals: what to record; without signals and without a path nothing is kept but the hash.
        header: JSON values of the trace header; `base_cycle_ns` is needed, `signals` is filled in here.
        path: the file, None for memory.
        hashing: whether the hash of the run is taken.
        block_ticks: ticks per block, None for a fitting number.

    Raises:
        TraceError: the file cannot be opened.
        ValueError: the table does not fit, a signal lies outside of it, or two have the same name.
        KeyError: the header lacks `base_cycle_ns`.
    """

    def __init__(
        self,
        table: Floats,
        signals: Sequence[Signal],
        header: dict[str, Any],
        path: Path | None = None,
        *,
        hashing: bool = True,
        block_ticks: int | None = None,
    ) -> None:
        _check(table, signals, hashing=hashing, block_ticks=block_ticks)
        self._flat = table.reshape(-1)
        self._index = np.array([signal.index for signal in signals], dtype=np.int64)
        self._path = path
        self._writer = _writer(signals, header, path)
        self._hash = RunHash() if hashing else None
        self._digest = ""
        self._ticks = 0
        self._error: BaseException | None = None
        width = len(signals) + (HASHED_ROWS * table.shape[1] if hashing else 0)
        self._capacity = block_ticks or _fitting(width)
        self._free: SimpleQueue[_Block] = SimpleQueue()
        self._full: SimpleQueue[_Block | None] = SimpleQueue()
        for _ in range(BLOCKS - 1):
            self._free.put(_Block(self._capacity, width))
        self._block = _Block(self._capacity, width)
        self._values = self._block.values
        self._first = 0
        self._count = 0
        # A daemon: a run that dies without closing must not hang; its file is readable to the last block.
        self._thread = Thread(target=self._work, name="trace writer", daemon=True)
        self._thread.start()
        gather(self._flat, self._index, self._values, 0)  # compiled before the first cycle

    def capture(self, tick: int) -> None:
        """Record the table as it is now as the values of `tick`.

        Raises:
            TraceError: an earlier block could not be written.
            ValueError: the recorder is closed.
        """
        row = self._count
        if row == self._capacity or tick - self._first != row:
            self._begin(tick)
            row = 0
        gather(self._flat, self._index, self._values, row)
        self._count = row + 1

    def plan(self, plan: Plan) -> None:
        """Record a profile that was taken over."""
        self._block.plans.append(plan)

    def event(self, event: Event) -> None:
        """Record an event."""
        self._block.events.append(event)

    def close(self) -> str:
        """Write what is left, end the thread and return the hash in hexadecimal ("" without hashing).

        Raises:
            TraceError: something could not be written; the file ends with its last whole block.
        """
        if self._thread.is_alive():
            self._hand_over()
            self._full.put(None)
            self._thread.join()
            self._count = self._capacity  # the next capture looks for a block and finds it closed
        self._check_writer()
        return self._digest

    def trace(self) -> Trace:
        """Close, and return what was recorded.

        Raises:
            TraceError: something could not be written, or nothing was to be kept.
        """
        self.close()
        if self._writer is None:
            raise TraceError("nothing was recorded but the hash; select signals to keep a trace")
        return Trace.load(self._path) if self._path else Trace.from_chunks(self._writer.chunks)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _begin(self, tick: int) -> None:
        """Start a block at `tick`; a jump of the ticks shows as a gap in the trace."""
        if not self._thread.is_alive():
            raise ValueError("the recorder is closed")
        if self._count:
            self._hand_over()
            self._check_writer()
            self._block = self._free.get()
            self._values = self._block.values
        self._first = tick
        self._count = 0

    def _hand_over(self) -> None:
        self._block.first = self._first
        self._block.count = self._count
        self._ticks += self._count
        self._full.put(self._block)

    def _check_writer(self) -> None:
        error = self._error
        if isinstance(error, TraceError):
            raise TraceError(str(error)) from error
        if error is not None:
            raise TraceError(f"the trace writer failed: {error!r}; this is a defect of motionlayer") from error

    def _work(self) -> None:
        """Write blocks until None comes; after a failure only give them back, so the cycle never hangs."""
        while (block := self._full.get()) is not None:
            if self._error is None:
                self._guarded(self._write, block)
            block.clear()
            self._free.put(block)
        if self._error is None:
            self._guarded(self._finish)
        if self._writer is not None:
            self._writer.abandon()

    def _guarded(self, action: Callable[..., None], *arguments: _Block) -> None:
        try:
            action(*arguments)
        except BaseException as error:  # noqa: BLE001 - it is raised in the cycle thread
            self._error = error

    def _write(self, block: _Block) -> None:
        signals = len(self._index)
        rows = block.values[: block.count]
        if self._hash is not None:
            self._hash.numbers(rows[:, signals:])
            for event in block.events:
                self._hash.event(event)
        if self._writer is not None:
            for plan in block.plans:
                self._writer.plan(plan)
            for event in block.events:
                self._writer.event(event)
            self._writer.rows(block.first, rows[:, :signals])

    def _finish(self) -> None:
        digest = self._hash.hexdigest(self._ticks) if self._hash is not None else ""
        if self._writer is not None:
            self._writer.close(self._ticks, digest)
        self._digest = digest


def _check(table: Floats, signals: Sequence[Signal], *, hashing: bool, block_ticks: int | None) -> None:
    if table.ndim != 2 or table.dtype != np.float64 or not table.flags.c_contiguous:
        raise ValueError(f"the table is {table.dtype} of shape {table.shape}; contiguous float64 in 2-D is needed")
    if hashing and len(table) < HASHED_ROWS:
        raise ValueError(f"the table has {len(table)} rows; the hash is over its first {HASHED_ROWS}")
    for signal in signals:
        if not 0 <= signal.index < table.size:
            raise ValueError(f"{signal.name}: index {signal.index} is outside of the table's {table.size} values")
    if block_ticks is not None and block_ticks < 1:
        raise ValueError(f"blocks of {block_ticks} ticks; at least 1 is needed")


def _writer(signals: Sequence[Signal], header: dict[str, Any], path: Path | None) -> TraceWriter | None:
    if path is None and not signals:
        return None
    described = [{"name": signal.name, "unit": signal.unit, "resolution": signal.resolution} for signal in signals]
    return TraceWriter(path, {**header, "signals": described})


def _fitting(width: int) -> int:
    least, most = BLOCK_TICKS
    return max(least, min(most, BLOCK_BYTES // (8 * max(width, 1))))
