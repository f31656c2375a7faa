"""The container: a head, then chunks that each prove themselves. What is in them is not its business."""

import json
import re
import struct
import zlib
from collections.abc import Iterable, Iterator
from typing import Any, Final, NamedTuple

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
INPUT: Final = b"INPT"
GAP: Final = b"GAP "
TAIL: Final = b"TAIL"
TAGS: Final = (ROWS, PLAN, EVENT, INPUT, GAP, TAIL)


class Chunk(NamedTuple):
    """A whole chunk, and the offset at which it begins."""

    offset: int
    tag: bytes
    payload: memoryview


class Break(NamedTuple):
    """Where no whole chunk begins; damage is "" if one is merely cut off there."""

    offset: int
    damage: str


def pack_head(header: Header) -> bytes:
    """Return magic and header as bytes."""
    text = json.dumps(header).encode()
    return HEAD.pack(MAGIC, len(text), zlib.crc32(text)) + text


def pack_chunk(tag: bytes, payload: bytes) -> bytes:
    """Return a chunk."""
    return b"".join(pack_parts(tag, len(payload), (payload,)))


def pack_parts(tag: bytes, size: int, parts: Iterable[bytes | memoryview]) -> list[bytes | memoryview]:
    """Return the parts of a chunk; a payload that comes in parts is neither joined nor copied.

    Args:
        tag: four bytes.
        size: of all parts, in bytes.
        parts: the payload; the checksum of each is taken before the next one is asked for.
    """
    head = CHUNK.pack(tag, size)
    crc = zlib.crc32(head)
    payload = []
    for part in parts:
        crc = zlib.crc32(part, crc)
        payload.append(part)
    return [head, CRC.pack(crc), *payload]


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


def chunks(data: memoryview, offset: int = 0) -> Iterator[Chunk | Break]:
    """Yield every whole chunk; at a cut or at damage yield what is there and end."""
    while offset < len(data):
        if not _whole(data, offset):
            yield Break(offset, _damage(data, offset))
            return
        tag, length = CHUNK.unpack_from(data, offset)
        end = offset + CHUNK_HEAD + length
        yield Chunk(offset, tag, data[offset + CHUNK_HEAD : end])
        offset = end


def _whole(data: memoryview, offset: int, length: int | None = None) -> bool:
    """Tell whether a whole chunk begins at an offset; `length` stands in for the one it states."""
    start = offset + CHUNK_HEAD
    if start > len(data):
        return False
    tag, stated = CHUNK.unpack_from(data, offset)
    length = stated if length is None else length
    if length > len(data) - start:
        return False
    (crc,) = CRC.unpack_from(data, offset + CHUNK.size)
    return bool(zlib.crc32(data[start : start + length], zlib.crc32(CHUNK.pack(tag, length))) == crc)


def _damage(data: memoryview, offset: int) -> str:
    """Return what is wrong where no whole chunk begins, "" if a writer that was killed may have left this."""
    tag = bytes(data[offset : offset + len(ROWS)])
    if not any(known.startswith(tag) for known in TAGS):
        return f"no chunk begins with {tag!r}"
    rest = len(data) - offset - CHUNK_HEAD
    if rest < 0:
        return ""
    name = tag.decode().rstrip()
    if CHUNK.unpack_from(data, offset)[1] <= rest:
        return f"the checksum of the {name} chunk does not fit"
    # It seems to go on behind the end of the file. If it is whole up to there, or chunks follow, its length is wrong.
    if _whole(data, offset, rest) or _chunk_follows(data, offset + CHUNK_HEAD):
        return f"the length of the {name} chunk does not fit"
    return ""


def _chunk_follows(data: memoryview, offset: int) -> bool:
    return any(_whole(data, offset + found.start()) for found in re.finditer(b"|".join(TAGS), data[offset:]))
