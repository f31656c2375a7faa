"""`TraceWriter`: the one encoder, into a file or into memory."""

import json
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from motionlayer.event import Event, Input
from motionlayer.record import _container as container
from motionlayer.record._encode import RowEncoder
from motionlayer.record._errors import TraceError
from motionlayer.record._output import open_alone
from motionlayer.record._records import End, Gap, Plan, encode_event, encode_gap, encode_input, encode_plan


class TraceWriter:
    """Writes a trace chunk by chunk; what was written is readable at any time.

    Args:
        target: the file, replaced if it exists; None keeps the encoded chunks in `chunks`.
        header: JSON values; `base_cycle_ns` and `signals` (name, unit, resolution) are needed, `format` is
            set here.

    Raises:
        TraceError: the file cannot be written, here and in every method; here also if another run writes it.
        KeyError: the header lacks one of its fields.
        ValueError: two signals have the same name.
    """

    def __init__(self, target: Path | None, header: dict[str, Any]) -> None:
        self.chunks: list[bytes] = []
        self.changes: Mapping[str, Any] = {}
        """What is to be changed in the header at the end."""
        self._target = target
        self._file: BinaryIO | None = None
        signals = header["signals"]
        names = [signal["name"] for signal in signals]
        if len(set(names)) < len(names):
            twice = sorted({name for name in names if names.count(name) > 1})
            raise ValueError(f"signals recorded twice: {', '.join(twice)}")
        self._encoder = RowEncoder(np.array([signal["resolution"] for signal in signals], dtype=np.float64))
        head = container.pack_head({**header, "format": container.FORMAT, "base_cycle_ns": header["base_cycle_ns"]})
        if target is not None:
            try:
                self._file = open_alone(target)
            except OSError as error:
                raise self._failure(error) from error
        try:
            self._write(head)
            self._flush()
        except TraceError:
            self.abandon()
            raise

    def rows(self, first_tick: int, block: NDArray[np.float64]) -> None:
        """Write rows of consecutive ticks, shape (ticks, signals), and flush."""
        if len(block):
            size, parts = self._encoder.encode(first_tick, np.ascontiguousarray(block))
            self._write(*container.pack_parts(container.ROWS, size, parts))
        self._flush()

    def plan(self, plan: Plan) -> None:
        """Write a plan."""
        self._write(container.pack_chunk(container.PLAN, encode_plan(plan)))

    def event(self, event: Event) -> None:
        """Write an event."""
        self._write(container.pack_chunk(container.EVENT, encode_event(event)))

    def input(self, what: Input) -> None:
        """Write something that came from outside."""
        self._write(container.pack_chunk(container.INPUT, encode_input(what)))

    def gap(self, gap: Gap) -> None:
        """Write what is missing from here on."""
        self._write(container.pack_chunk(container.GAP, encode_gap(gap)))

    def records(
        self, gaps: Iterable[Gap], inputs: Iterable[Input], plans: Iterable[Plan], events: Iterable[Event]
    ) -> None:
        """Write what stands in front of rows, causes before effects."""
        for gap in gaps:
            self.gap(gap)
        for what in inputs:
            self.input(what)
        for plan in plans:
            self.plan(plan)
        for event in events:
            self.event(event)

    def go_back(self, chunks: Sequence[bytes], changes: Mapping[str, Any]) -> None:
        """Let the trace in memory consist of these chunks, which it once did, with other values in its header."""
        self.chunks[:] = chunks
        self.changes = changes

    def close(self, ticks: int, digest: str, end: End | None = None) -> None:
        """Write the tail, which says that the trace is whole, and close the file."""
        tail = json.dumps({"ticks": ticks, "hash": digest, "end": end}).encode()
        if self.changes:
            header, _ = container.unpack_head(memoryview(self.chunks[0]), "the recording")
            self.chunks[0] = container.pack_head({**header, **self.changes})
        try:
            self._write(container.pack_chunk(container.TAIL, tail))
            self._flush()
        finally:
            self.abandon()

    def abandon(self) -> None:
        """Close the file as it is; without a tail the trace reads as incomplete. Never raises."""
        file, self._file = self._file, None
        if file is not None:
            with suppress(OSError):  # what is lost here has been reported by the write that failed
                file.close()

    def _write(self, *parts: bytes | memoryview) -> None:
        if self._target is None:
            self.chunks.append(b"".join(parts))
        elif self._file is not None:
            try:
                self._file.writelines(parts)
            except OSError as error:
                raise self._failure(error) from error

    def _flush(self) -> None:
        if self._file is not None:
            try:
                self._file.flush()
            except OSError as error:
                raise self._failure(error) from error

    def _failure(self, error: OSError) -> TraceError:
        return TraceError(
            f"{self._target}: the trace cannot be written: {error.strerror}; "
            f"free space or name another file with --trace"
        )
