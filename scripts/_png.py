"""Small pictures: a screenshot with a palette instead of true colours, a third of the bytes."""

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]

SIGNATURE = b"\x89PNG\r\n\x1a\n"
COARSE = 4  # steps in which colours are counted: what is closer looks the same
COLOURS = 256  # of a palette


def shrink(data: bytes) -> bytes:
    """Return a PNG file in the most telling of its colours; the others become the closest of them.

    Raises:
        ValueError: it is no PNG file in true colours of 8 bits.
    """
    pixels = decode(data)
    colours, which, counts = np.unique(pixels.reshape(-1, 3) // COARSE, axis=0, return_inverse=True, return_counts=True)
    colours = colours.astype(np.int64) * 255 // (255 // COARSE)
    palette = colours[_telling(colours, counts)]
    closest = ((colours[:, None] - palette) ** 2).sum(axis=2).argmin(axis=1).astype(np.uint8)
    return _encode(closest[which].reshape(pixels.shape[:2]), palette.astype(np.uint8))


def _telling(colours: NDArray[np.int64], counts: NDArray[np.int64]) -> list[int]:
    """Choose colours one by one: each time the one that is missed most, by its distance and how often it occurs."""
    chosen = [int(counts.argmax())]
    distance = np.full(len(colours), np.inf)
    for _ in range(min(COLOURS, len(colours)) - 1):
        distance = np.minimum(distance, ((colours - colours[chosen[-1]]) ** 2).sum(axis=1))
        chosen.append(int((distance * np.sqrt(counts)).argmax()))
    return chosen


def _encode(indices: Bytes, palette: Bytes) -> bytes:
    height, width = indices.shape
    lines = np.hstack([np.zeros((height, 1), np.uint8), indices])
    head = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    chunks = [
        (b"IHDR", head),
        (b"PLTE", palette.tobytes()),
        (b"IDAT", zlib.compress(lines.tobytes(), 9)),
        (b"IEND", b""),
    ]
    return SIGNATURE + b"".join(
        struct.pack(">I4s", len(body), tag) + body + struct.pack(">I", zlib.crc32(tag + body)) for tag, body in chunks
    )


def decode(data: bytes) -> Bytes:
    """Return the pixels, shape (height, width, 3), of a PNG file of 8 bits per channel without interlacing.

    Raises:
        ValueError: it is another kind of picture.
    """
    body, at = b"", len(SIGNATURE)
    width, height, depth, kind, _, _, interlaced = struct.unpack(">IIBBBBB", data[at + 8 : at + 21])
    if data[:at] != SIGNATURE or depth != 8 or kind not in {2, 6} or interlaced:
        raise ValueError("not a PNG file in true colours of 8 bits")
    while at < len(data):
        size, tag = struct.unpack(">I4s", data[at : at + 8])
        if tag == b"IDAT":
            body += data[at + 8 : at + 8 + size]
        at += size + 12
    channels = 3 if kind == 2 else 4
    lines = np.frombuffer(zlib.decompress(body), np.uint8).reshape(height, 1 + width * channels)
    above = np.zeros((width, channels), np.int64)
    pixels = np.empty((height, width, channels), np.uint8)
    for row, line in enumerate(lines):
        above = _unfilter(int(line[0]), line[1:].reshape(width, channels).astype(np.int64), above)
        pixels[row] = above
    return pixels[:, :, :3]


def _unfilter(kind: int, line: NDArray[np.int64], above: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return a row of pixels from its differences to the pixels on the left and above."""
    if kind == 0:
        return line
    if kind == 1:
        return np.cumsum(line, axis=0) % 256
    if kind == 2:
        return (line + above) % 256
    rows = [list(map(int, pixel)) for pixel in line]
    left, corner = [0] * line.shape[1], [0] * line.shape[1]
    for pixel, over in zip(rows, above.tolist(), strict=True):
        for c, (a, b, d) in enumerate(zip(left, over, corner, strict=True)):
            pixel[c] = (pixel[c] + ((a + b) // 2 if kind == 3 else _nearest(a, b, d))) % 256
        left, corner = pixel, over
    return np.array(rows)


def _nearest(left: int, above: int, corner: int) -> int:
    """Return the neighbour that is closest to left + above - corner (Paeth)."""
    guess = left + above - corner
    return min((left, above, corner), key=lambda value: abs(guess - value))
