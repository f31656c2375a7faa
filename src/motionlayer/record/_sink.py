"""`Sink`: where full blocks go, the encoder and the hash; it belongs to one thread at a time."""

import hashlib
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motionlayer.event import Event
from motionlayer.record._block import Block
from motionlayer.record._records import End, encode_event
from motionlayer.record._writer import TraceWriter

DIGEST_SIZE: Final = 16


class RunHash:
    """The hash of a run, fed block by block."""

    def __init__(self) -> None:
        self._numbers = hashlib.blake2b(digest_size=DIGEST_SIZE)
        self._events = hashlib.blake2b(digest_size=DIGEST_SIZE)

    def copy(self) -> "RunHash":
        """Return one that goes on from here by itself."""
        other = RunHash()
        other._numbers, other._events = self._numbers.copy(), self._events.copy()
        return other

    def numbers(self, rows: NDArray[np.float64]) -> None:
        """Take in the hashed rows of the table, shape (ticks, 4 * columns), C-contiguous."""
        self._numbers.update(rows.data)

    def event(self, event: Event) -> None:
        """Take in an event; JSON escapes line ends, so one per line is unambiguous."""
        self._events.update(encode_event(event) + b"\n")

    def hexdigest(self, ticks: int) -> str:
        """Return the hash over all that was taken in and the number of ticks."""
        both = self._numbers.digest() + self._events.digest() + ticks.to_bytes(8, "little")
        return hashlib.blake2b(both, digest_size=DIGEST_SIZE).hexdigest()


class Mark(NamedTuple):
    """What a sink has taken in until some tick.

    Attributes:
        ticks: rows.
        hash: of them; None if it is not taken, or something is missing.
        chunks: of a trace in memory, with its head.
        changes: of the header in that head.
    """

    ticks: int
    hash: RunHash | None
    chunks: tuple[bytes, ...] = ()
    changes: Mapping[str, Any] = MappingProxyType({})


class Sink:
    """Takes blocks.

    Args:
        writer: None writes nothing.
        hashing: whether the hash of the run is taken.

    Attributes:
        digest: the hash of the run once it is finished, hexadecimal; "" if it is not taken or something is missing.
        end: how the run ended, for the end of the trace.
    """

    def __init__(self, writer: TraceWriter | None, *, hashing: bool) -> None:
        self.digest = ""
        self.end: End | None = None
        self._writer = writer
        self._hash = RunHash() if hashing else None
        self._ticks = 0

    def mark(self) -> Mark:
        """Return what has been taken in until now."""
        copy = self._hash.copy() if self._hash is not None else None
        if self._writer is None:
            return Mark(self._ticks, copy)
        return Mark(self._ticks, copy, tuple(self._writer.chunks), self._writer.changes)

    def go_back(self, mark: Mark, changes: Mapping[str, Any]) -> None:
        """Forget the blocks since a mark, and change the header."""
        if self._writer is not None:
            self._writer.go_back(mark.chunks, {**mark.changes, **changes})
        self._hash = mark.hash.copy() if mark.hash is not None else None
        self._ticks = mark.ticks

    def write(self, block: Block) -> None:
        """Take in a block.

        Raises:
            TraceError: it cannot be written.
        """
        self._ticks += block.count
        if block.gap is not None:
            self._hash = None  # of a run of which something is missing there is none
        if self._hash is not None:
            self._hash.numbers(block.hashed[: block.count])
            for event in block.events:
                self._hash.event(event)
        if self._writer is not None:
            gaps = [block.gap] if block.gap is not None else []
            self._writer.records(gaps, block.inputs, block.plans, block.events)
            self._writer.rows(block.first, block.values[: block.count])

    def finish(self) -> None:
        """Write the end of the trace.

        Raises:
            TraceError: it cannot be written.
        """
        digest = self._hash.hexdigest(self._ticks) if self._hash is not None else ""
        if self._writer is not None:
            self._writer.close(self._ticks, digest, self.end)
        self.digest = digest

    def abandon(self) -> None:
        """Let go of the file as it is. Never raises."""
        if self._writer is not None:
            self._writer.abandon()
