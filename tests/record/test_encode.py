"""Rows to columns: what the kernels write in batches is what a plain reading of the format says."""

import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.record import _encode
from motionlayer.record._encode import RowEncoder, quantise
from motionlayer.record._rows import RowBlock
from tests.effort import examples

from .samples import Floats

KINDS = ("constant", "lossless", "steps", "wide steps", "not finite")


def column(rng: np.random.Generator, ticks: int, kind: str) -> tuple[Any, float]:
    """Return values and resolution."""
    if kind == "constant":
        return np.full(ticks, rng.normal()), 0.0
    if kind == "lossless":
        return rng.normal(size=ticks), 0.0
    if kind == "steps":
        return np.cumsum(rng.integers(-100, 100, ticks)) * 0.25, 0.25
    if kind == "wide steps":
        return rng.integers(-(10**12), 10**12, ticks) * 0.5, 0.5
    return np.where(np.arange(ticks) % 3, np.inf, 0.3), 0.25


def columns(seed: int, ticks: int, kinds: list[str]) -> tuple[Floats, Floats]:
    """Return a block, and the resolution of each column."""
    rng = np.random.default_rng(seed)
    chosen = [column(rng, ticks, kind) for kind in kinds]
    return np.array([values for values, _ in chosen]).T.copy(), np.array([unit for _, unit in chosen])


def encoded(block: Floats, resolution: Floats, first: int = 5) -> bytes:
    size, parts = RowEncoder(resolution).encode(first, block)
    payload = b"".join(parts)
    assert len(payload) == size
    return payload


@settings(max_examples=examples(60), deadline=None)
@given(seed=st.integers(0, 999), ticks=st.integers(1, 40), kinds=st.lists(st.sampled_from(KINDS), max_size=12))
@pytest.mark.parametrize("batch", [1, 7, 64, 1 << 14])
def test_the_size_of_a_batch_changes_nothing(batch: int, seed: int, ticks: int, kinds: list[str]) -> None:
    block, resolution = columns(seed, ticks, kinds) if kinds else (np.zeros((ticks, 0)), np.zeros(0))
    whole = encoded(block, resolution)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(_encode, "BATCH", batch)
        assert encoded(block, resolution) == whole
    rows = RowBlock(memoryview(whole), len(resolution))
    assert (rows.first, rows.ticks) == (5, ticks)
    for number, unit in enumerate(resolution.tolist()):
        values = block[:, number]
        expected = np.array([_nearest(value, unit) for value in values.tolist()])
        assert rows.column(number, unit).tobytes() == expected.tobytes()


def _nearest(value: float, unit: float) -> float:
    return round(value / unit) * unit + 0.0 if unit and np.isfinite(value) else value


def test_the_bytes_are_those_of_the_format() -> None:
    block = np.array([[1.0, 0.5, 2.0, 7.0], [1.0, 0.5, 3.0, 7.5], [1.0, 0.75, 4.0, -500.0]])
    payload = encoded(block, np.array([0.0, 0.25, 0.0, 0.5]))
    assert payload == b"".join(
        (
            struct.pack("<qII", 5, 3, 4),
            bytes([0, 2, 1, 3]),  # constant, differences of one byte, as it is, differences of two bytes
            struct.pack("<d", 1.0),
            struct.pack("<ddd", 2.0, 3.0, 4.0),
            struct.pack("<qbb", 2, 0, 1),
            struct.pack("<qhh", 14, 1, -1015),
        )
    )


def test_a_thousand_signals_cross_many_batches() -> None:
    block, resolution = columns(3, 300, [KINDS[number % len(KINDS)] for number in range(1000)])
    rows = RowBlock(memoryview(encoded(block, resolution)), 1000)
    for number in (0, 1, 2, 3, 4, 501, 502, 503, 996, 997, 998, 999):
        expected = [_nearest(value, float(resolution[number])) for value in block[:, number].tolist()]
        assert rows.column(number, float(resolution[number])).tobytes() == np.array(expected).tobytes()


@given(
    values=st.lists(st.floats(allow_nan=True, allow_infinity=True), min_size=1, max_size=30),
    resolution=st.floats(5e-324, 1e300),
)
def test_quantising_twice_changes_nothing_and_is_what_the_encoder_does(values: list[float], resolution: float) -> None:
    block = np.array(values)[:, None]
    once = quantise(block[:, 0], resolution)
    assert quantise(once, resolution).tobytes() == once.tobytes()
    rows = RowBlock(memoryview(encoded(block, np.array([resolution]))), 1)
    assert rows.column(0, resolution).tobytes() == once.tobytes()


def test_the_block_of_the_cycle_is_left_as_it_was() -> None:
    block, resolution = columns(1, 20, list(KINDS))
    before = block.tobytes()
    encoded(block, resolution)
    assert block.tobytes() == before
