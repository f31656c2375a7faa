"""Histograms against the values themselves."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.runtime import Histogram, Spread

durations = st.integers(0, 200) | st.integers(0, 10**7) | st.integers(0, 2**63 - 1)


def filled(values: list[int]) -> Histogram:
    histogram = Histogram()
    for value in values:
        histogram.add(value)
    return histogram


@given(st.lists(durations, min_size=1, max_size=200), st.floats(0.0, 1.0))
def test_a_quantile_is_never_too_small_and_at_most_a_bin_too_large(values: list[int], share: float) -> None:
    exact = sorted(values)[max(0, int(np.ceil(share * len(values))) - 1)]
    found = filled(values).quantile(share)
    assert exact <= found <= exact + exact // 32


@given(st.lists(durations, min_size=1, max_size=100))
def test_count_smallest_and_largest_are_exact(values: list[int]) -> None:
    histogram = filled(values)
    assert histogram.count == len(values)
    assert (histogram.spread.min, histogram.spread.max) == (min(values), max(values))


@given(st.lists(durations, max_size=100), st.lists(st.integers(1, 2**40), min_size=1, max_size=8, unique=True))
def test_wider_edges_lose_no_value_and_misplace_none_by_more_than_a_bin(values: list[int], edges: list[int]) -> None:
    edges = sorted(edges)
    found = np.cumsum(filled(values).coarse(edges))
    assert found[-1] == len(values)
    for below, edge in zip(found, edges, strict=False):
        assert sum(value < edge for value in values) <= below <= sum(value < edge + edge // 32 + 1 for value in values)


def test_without_values() -> None:
    assert Histogram().spread == Spread(0, 0, 0, 0)
    assert Histogram().coarse([10]) == [0, 0]
