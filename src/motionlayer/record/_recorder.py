"""`Recorder`: one kernel call per cycle; everything else happens in its thread, one block at a time."""

import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, Self

import numpy as np

from motionlayer.event import Event, Input
from motionlayer.record._block import MOST_RECORDS, Block, gather
from motionlayer.record._dimensions import BLOCKS, HASHED_ROWS, LOSSY_BLOCKS, Floats, check, fitting
from motionlayer.record._errors import TraceError
from motionlayer.record._pump import Pump
from motionlayer.record._records import End, Plan, Signal
from motionlayer.record._sink import Mark, Sink
from motionlayer.record._trace import Trace
from motionlayer.record._writer import TraceWriter


class Recorder:
    """Records a run. Its methods belong to the cycle thread; a `with` block closes it.

    Args:
        table: float64, C-contiguous, never moved while recording; the hash is over its first four rows.
        signals: what to record; without signals, without a path and without `keep` nothing is kept but the hash.
        header: JSON values of the trace header; `base_cycle_ns` is needed, `signals` is filled in here.
        path: the file, None for memory.
        keep: keep plans, events and inputs in memory also where there are no signals.
        hashing: whether the hash of the run is taken.
        block_ticks: ticks per block, None for a fitting number.
        lossless: True waits for the thread where it does not keep up, and raises what it cannot write. False, for
            real time, never waits and raises only in `close`: rows are dropped until a block is free, their number
            stands in the trace as a gap, and a trace that cannot be written ends there.
        warn: told once, in the cycle thread, that the first rows are dropped, and once that the trace has ended
            before the run; only without `lossless`.

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
        keep: bool = False,
        hashing: bool = True,
        block_ticks: int | None = None,
        lossless: bool = True,
        warn: Callable[[str], None] = lambda _text: None,
    ) -> None:
        check(table, signals, hashing=hashing, block_ticks=block_ticks)
        self._flat = table.reshape(-1)
        self._index = np.array([signal.index for signal in signals], dtype=np.int64)
        self._path = path
        self._lossless = lossless
        self._warn = warn
        self._told = {"gap": lossless, "end": lossless}
        self._writer = _writer(signals, header, path) if keep or signals or path is not None else None
        self._sink = Sink(self._writer, hashing=hashing)
        hashed = HASHED_ROWS * table.shape[1] if hashing else 0
        self._capacity = block_ticks or fitting(len(signals) + hashed, header["base_cycle_ns"], lossless=lossless)
        most = sys.maxsize if lossless else MOST_RECORDS
        count = BLOCKS if lossless else LOSSY_BLOCKS
        self._pump = Pump(self._sink, [Block(self._capacity, len(signals), hashed, most) for _ in range(count)])
        self._spare = Block(0, len(signals), hashed, most)
        """Stands in where no block is free: it has room for records, not for rows."""
        self._block = self._spare
        self._first = self._count = 0
        self._begin(0)
        gather(self._flat, self._index, self._block.values, self._block.hashed, 0)  # compiled before the first cycle

    @property
    def in_memory(self) -> bool:
        """Whether the recording can go back."""
        return self._path is None

    @property
    def dropping(self) -> bool:
        """Whether rows are dropped at present, because no block is free."""
        return self._block is self._spare

    def capture(self, tick: int) -> None:
        """Record the table as it is now as the values of `tick`.

        Raises:
            TraceError: an earlier block could not be written (only if lossless).
            ValueError: the recorder is closed.
        """
        row = self._count
        if row == self._capacity or tick - self._first != row:
            if not self._begin(tick):
                return
            row = 0
        block = self._block
        gather(self._flat, self._index, block.values, block.hashed, row)
        self._count = row + 1

    def plan(self, plan: Plan) -> None:
        """Record a profile that was taken over."""
        self._block.keep(self._block.plans, plan)

    def event(self, event: Event) -> None:
        """Record an event."""
        self._block.keep(self._block.events, event)

    def input(self, what: Input) -> None:
        """Record something that came from outside."""
        self._block.keep(self._block.inputs, what)

    def mark(self) -> Mark:
        """Return a mark to go back to: all that has been recorded until now. Waits until the thread has taken it in.

        Raises:
            TraceError: something could not be written (only if lossless).
            ValueError: the recorder is closed.
        """
        self._require_open()
        if self.dropping:
            self._change_block(wait=True)
        self._hand_over()
        self._change_block(wait=True)
        self._count = 0
        mark = self._pump.mark()
        self._check_pump()
        return mark

    def go_back(self, mark: Mark, changes: Mapping[str, Any] = MappingProxyType({})) -> None:
        """Forget what was recorded since a mark; the recording goes on from there. It costs some microseconds.

        Args:
            mark: of this recorder.
            changes: of the header from now on.

        Raises:
            TraceError: it is written to a file, which cannot be taken back.
            ValueError: the recorder is closed.
        """
        self.require_memory()
        if self.dropping:
            self._change_block(wait=True)
        self._block.clear()
        self._count = 0
        self._pump.go_back(mark, changes)

    def require_memory(self) -> None:
        """Make sure that the recording can go back.

        Raises:
            TraceError: it is written to a file.
            ValueError: the recorder is closed.
        """
        self._require_open()
        if self._path is not None:
            raise TraceError(f"{self._path}: a trace that is written to a file cannot go back; keep it in memory")

    def close(self, end: End | None = None) -> str:
        """Write what is left, end the thread and return the hash in hexadecimal.

        It is "" without hashing, and if rows or records had to be dropped.

        Args:
            end: how the run ended; counts when the recorder is closed for the first time.

        Raises:
            TraceError: something could not be written; the file ends with its last whole block.
        """
        if self._pump.running:
            if self.dropping:
                self._change_block(wait=True)
            self._hand_over()
            self._sink.end = end
            self._pump.close()
            self._count = self._capacity  # the next capture looks for a block and finds it closed
        self._pump.check()
        return self._sink.digest

    def trace(self, end: End | None = None) -> Trace:
        """Close, and return what was recorded.

        Raises:
            TraceError: something could not be written, or nothing was to be kept.
        """
        self.close(end)
        if self._writer is None:
            raise TraceError("nothing was recorded but the hash; select signals to keep a trace")
        return Trace.load(self._path) if self._path else Trace.from_chunks(self._writer.chunks)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _begin(self, tick: int) -> bool:
        """Start a block at `tick`; False if none is free and the row is dropped.

        A jump of the ticks shows as such in the trace.
        """
        self._require_open()
        if self._count:
            self._hand_over()
            self._block = self._spare
            self._count = 0
            self._check_pump()
        self._first = tick
        if self.dropping and not self._change_block(wait=self._lossless):
            self._spare.drop(tick)
            self._tell(
                "gap",
                f"rows of the trace are missing from tick {tick} on: its writer does not keep up; record "
                "fewer signals or write to a faster disk",
            )
            return False
        return True

    def _change_block(self, *, wait: bool) -> bool:
        block = self._pump.empty(wait=wait)
        if block is None:
            return False
        block.take_over(self._spare)
        self._block = block
        return True

    def _hand_over(self) -> None:
        self._block.first = self._first
        self._block.count = self._count
        self._pump.put(self._block)

    def _check_pump(self) -> None:
        try:
            self._pump.check()
        except TraceError as error:
            if self._lossless:
                raise
            self._tell("end", f"the run goes on, its trace has ended: {error}")

    def _tell(self, what: str, text: str) -> None:
        if not self._told[what]:
            self._told[what] = True
            self._warn(text)

    def _require_open(self) -> None:
        if not self._pump.running:
            raise ValueError("the recorder is closed")


def _writer(signals: Sequence[Signal], header: dict[str, Any], path: Path | None) -> TraceWriter:
    described = [{"name": signal.name, "unit": signal.unit, "resolution": signal.resolution} for signal in signals]
    return TraceWriter(path, {**header, "signals": described})
