"""What a recorder is given, and how many blocks of which size it makes of that."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from motionlayer.record._records import Signal

Floats = NDArray[np.float64]

HASHED_ROWS: Final = 4
"""The first rows of the table: set position, velocity, acceleration, actual position."""

BLOCK_BYTES: Final = 1 << 21
BLOCK_TICKS: Final = (64, 1024)
"""Least and most ticks of a block: what its thread costs is shared by many, what a crash loses is bounded."""

BLOCKS: Final = 3
"""One is filled, one is written, one absorbs the jitter between the two."""

LOSSY_BLOCK_NS: Final = 200_000_000
"""Most time in one block of a recorder that must not wait: what a crash loses is bounded in time as well."""

LOSSY_BLOCKS: Final = 16
"""Blocks of a recorder that must not wait: a disk that stands still for some seconds costs nothing."""


def check(table: Floats, signals: Sequence[Signal], *, hashing: bool, block_ticks: int | None) -> None:
    """Refuse a table that cannot be recorded, signals outside of it, and blocks of nothing.

    Raises:
        ValueError: the message says which.
    """
    if table.ndim != 2 or table.dtype != np.float64 or not table.flags.c_contiguous:
        raise ValueError(f"the table is {table.dtype} of shape {table.shape}; contiguous float64 in 2-D is needed")
    if hashing and len(table) < HASHED_ROWS:
        raise ValueError(f"the table has {len(table)} rows; the hash is over its first {HASHED_ROWS}")
    for signal in signals:
        if not 0 <= signal.index < table.size:
            raise ValueError(f"{signal.name}: index {signal.index} is outside of the table's {table.size} values")
    if block_ticks is not None and block_ticks < 1:
        raise ValueError(f"blocks of {block_ticks} ticks; at least 1 is needed")


def fitting(width: int, base_cycle_ns: int, *, lossless: bool) -> int:
    """Return how many ticks of so many values make a block."""
    least, most = BLOCK_TICKS
    ticks = max(least, min(most, BLOCK_BYTES // (8 * max(width, 1))))
    return ticks if lossless else max(1, min(ticks, LOSSY_BLOCK_NS // base_cycle_ns))
