"""The container: a head, then chunks that each prove themselves. What is in them is not its business."""

import json
import struct
import zlib
from collections.abc import Iterator
from typing import Any, Final

from motionlayer.record._errors import TraceError

Header = dict[str, Any]

MAGIC: Final = b"\x93mltrace"
FORMAT: Final = 1
HEAD: Final = struct.Struct("<8sII")
CHUNK: Final = struct.Struct("<4sQ")
CRC: Final = struct.Struct("<I")
CHUNK_HEAD: Final = CHUNK.size + CRC.size

ROWS: Final = b"ROWS"
PLAN: Final = b"PLAN"
EVENT: Final = b"EVNT"
TAIL: Final = b"TAIL"


def pack_head(header: Header) -> bytes:
    """Return magic and header as bytes."""
    text = json.dumps(header).encode()
    return HEAD.pack(MAGIC, len(text), zlib.crc32(text)) + text


def pack_chunk(tag: bytes, payload: bytes) -> bytes:
    """Return a chunk."""
    head = CHUNK.pack(tag, len(payload))
    return b"".join((head, CRC.pack(zlib.crc32(payload, zlib.crc32(head))), payload))


def unpack_head(data: memoryview, name: str) -> tuple[Header, int]:
    """Return the header and the offset of the first chunk.

    Raises:
        TraceError: the file is foreign, of another format, or its header is damaged.
    """
    if bytes(data[: len(MAGIC)]) != MAGIC:
        raise TraceError(
            f"{name}: not a trace of motionlayer: offset 0 holds {bytes(data[: len(MAGIC)])!r}, "
            f"not {MAGIC!r}; traces are written by `motionlayer run --trace`"
        )
    header = _header(data)
    if header is None:
        raise TraceError(
            f"{name}: the header at offset {HEAD.size} is damaged or cut off in a file of {len(data)} bytes; "
            "record the run again"
        )
    if header.get("format") != FORMAT:
        raise TraceError(
            f"{name}: the header at offset {HEAD.size} says format {header.get('format')!r}; this version "
            f"reads format {FORMAT}: use the version that wrote it, {header.get('product', 'unknown')}"
        )
    return header, HEAD.size + HEAD.unpack_from(data)[1]


def _header(data: memoryview) -> Header | None:
    if len(data) < HEAD.size:
        return None
    _, length, crc = HEAD.unpack_from(data)
    text = bytes(data[HEAD.size : HEAD.size + length])
    if len(text) < length or zlib.crc32(text) != crc:
        return None
    header = json.loads(text)
    return header if isinstance(header, dict) else None


def chunks(data: memoryview, offset: int = 0) -> Iterator[tuple[bytes, memoryview] | None]:
    """Yield tag and payload of every whole chunk; at damage or a cut yield None and end."""
    while offset < len(data):
        start = offset + CHUNK_HEAD
        if start > len(data):
            yield None
            return
        tag, length = CHUNK.unpack_from(data, offset)
        (crc,) = CRC.unpack_from(data, offset + CHUNK.size)
        payload = data[start : start + length]
        if len(payload) < length or zlib.crc32(payload, zlib.crc32(data[offset : offset + CHUNK.size])) != crc:
            yield None
            return
        yield tag, payload
        offset = start + length
