"""From bytes to what a `Trace` is made of."""

import json
import struct
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

from motionlayer.event import Event, Input
from motionlayer.record import _container as container
from motionlayer.record._errors import TraceError
from motionlayer.record._records import End, Gap, Plan, Signal, decode_event, decode_gap, decode_input, decode_plan
from motionlayer.record._rows import RowBlock


@dataclass
class Content:
    """What was read, up to the first damaged or cut off place; `damage` says what is wrong there."""

    header: container.Header
    signals: tuple[Signal, ...]
    blocks: list[RowBlock] = field(default_factory=list)
    plans: list[Plan] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    inputs: list[Input] = field(default_factory=list)
    gaps: list[Gap] = field(default_factory=list)
    hash: str = ""
    end: End | None = None
    complete: bool = False
    damage: str = ""

    @property
    def ticks(self) -> int:
        """Number of rows."""
        return sum(block.ticks for block in self.blocks)

    def take(self, tag: bytes, payload: memoryview) -> None:
        """Add a chunk; tags of a later version are passed over."""
        if tag == container.ROWS:
            self.blocks.append(RowBlock(payload, len(self.signals)))
        elif tag == container.PLAN:
            self.plans.append(decode_plan(payload))
        elif tag == container.EVENT:
            self.events.append(decode_event(payload))
        elif tag == container.INPUT:
            self.inputs.append(decode_input(payload))
        elif tag == container.GAP:
            self.gaps.append(decode_gap(payload))
        elif tag == container.TAIL:
            self._end(json.loads(bytes(payload)))

    def _end(self, tail: Any) -> None:  # noqa: ANN401 - whatever JSON holds
        if self.signals and tail["ticks"] != self.ticks:  # without signals no rows are kept
            raise ValueError(f"it counts {tail['ticks']} ticks, the rows before it hold {self.ticks}")
        self.hash = str(tail["hash"])
        end = tail.get("end")
        self.end = None if end is None else End(*end)
        self.complete = True

    def spoil(self, damage: str) -> None:
        """Note damage; what is damaged is neither complete nor does it have a hash."""
        self.damage, self.complete, self.hash, self.end = damage, False, "", None


def read(parts: Iterable[bytes], name: str) -> Content:
    """Read a trace from a file's bytes, or from the chunks of a writer.

    Raises:
        TraceError: the head is foreign or damaged. Damage behind it ends the reading.
    """
    views = [memoryview(part) for part in parts]
    header, offset = container.unpack_head(views[0] if views else memoryview(b""), name)
    content = Content(header, _signals(header, name))
    total = sum(map(len, views))
    for number, chunk in enumerate(_chunks(views, offset), 1):
        left = total - chunk.offset
        if content.complete:
            whole = f"the trace ends at offset {chunk.offset} with all of its {content.ticks} ticks"
            content.spoil(f"{whole}; the {left} bytes behind its end do not belong to it")
        elif damage := _take(content, chunk):
            where = f"chunk {number} at offset {chunk.offset}: {damage}"
            content.spoil(f"{where}; {content.ticks} ticks were read, {left} of {total} bytes were not")
        if content.damage or isinstance(chunk, container.Break):
            break
    return content


def _chunks(views: Iterable[memoryview], offset: int) -> Iterator[container.Chunk | container.Break]:
    """Yield the chunks of all views, with offsets from the beginning of the first one."""
    before = 0
    for view in views:
        for chunk in container.chunks(view, offset):
            yield chunk._replace(offset=before + chunk.offset)
        before += len(view)
        offset = 0


def _take(content: Content, chunk: container.Chunk | container.Break) -> str:
    """Add a chunk to what was read; return what is wrong with it, "" if nothing is or if it is cut off."""
    if isinstance(chunk, container.Break):
        return chunk.damage
    try:
        content.take(chunk.tag, chunk.payload)
    except (ValueError, LookupError, TypeError, struct.error) as error:
        return f"the {chunk.tag.decode().rstrip()} chunk makes no sense: {error}"
    return ""


def _signals(header: container.Header, name: str) -> tuple[Signal, ...]:
    try:
        int(header["base_cycle_ns"])
        return tuple(
            Signal(signal["name"], signal["unit"], index, float(signal["resolution"]))
            for index, signal in enumerate(header["signals"])
        )
    except (LookupError, TypeError, ValueError) as error:
        raise TraceError(
            f"{name}: the header at offset {container.HEAD.size} lacks or garbles base_cycle_ns or signals "
            f"({error!r}); record the run again"
        ) from error
