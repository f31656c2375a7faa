"""From bytes to what a `Trace` is made of."""

import json
import struct
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import chain

from motionlayer.event import Event
from motionlayer.record import _container as container
from motionlayer.record._errors import TraceError
from motionlayer.record._records import Plan, Signal, decode_event, decode_plan
from motionlayer.record._rows import RowBlock


@dataclass
class Content:
    """What was read, up to the first damaged or cut off place."""

    header: container.Header
    signals: tuple[Signal, ...]
    blocks: list[RowBlock] = field(default_factory=list)
    plans: list[Plan] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    hash: str = ""
    complete: bool = False

    def take(self, tag: bytes, payload: memoryview) -> None:
        """Add a chunk; tags of a later version are passed over."""
        if tag == container.ROWS:
            self.blocks.append(RowBlock(payload, len(self.signals)))
        elif tag == container.PLAN:
            self.plans.append(decode_plan(payload))
        elif tag == container.EVENT:
            self.events.append(decode_event(payload))
        elif tag == container.TAIL:
            self.hash = str(json.loads(bytes(payload))["hash"])
            self.complete = True


def read(parts: Iterable[bytes], name: str) -> Content:
    """Read a trace from a file's bytes, or from the chunks of a writer.

    Raises:
        TraceError: the head is foreign or damaged. Damage behind it ends the reading.
    """
    views: Iterator[memoryview] = (memoryview(part) for part in parts)
    head = next(views, memoryview(b""))
    header, offset = container.unpack_head(head, name)
    content = Content(header, _signals(header, name))
    streams = chain([container.chunks(head, offset)], (container.chunks(view) for view in views))
    for chunk in chain.from_iterable(streams):
        if chunk is None or content.complete:
            content.complete = False  # damaged, or something behind the tail
            break
        try:
            content.take(*chunk)
        except (ValueError, LookupError, TypeError, struct.error):
            break
    return content


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
