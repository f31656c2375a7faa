"""The rows of the group `runtime`, measured with next to no repetitions. Nothing here judges a time."""

import math

import pytest
from tests.effort import thinned

from motionlayer.bench import GROUPS, Effort, Row

TINY = Effort(samples=3, runs=1)


def test_the_runtime_group_has_these_rows() -> None:
    assert [(row.name, row.unit, str(row.goal)) for row in GROUPS["runtime"]] == [
        ("event.record", "µs", "≤ 1"),
        ("event.per_second", "1/s", "≥ 200000"),
        ("trace.core_share", "cores", "≤ 0.03"),
        ("realtime.late_p99", "µs", "≤ 300"),
        ("soak.growth", "MiB", "≤ 1"),
        ("reset.time", "ms", "≤ 1"),
    ]


@pytest.mark.parametrize("row", thinned(GROUPS["runtime"], 3), ids=lambda row: row.name)
def test_every_row_gives_a_number(row: Row) -> None:
    figure = row.measure(TINY)
    assert math.isfinite(figure.value)
    if row.name == "trace.core_share":  # also told for a machine that mostly rests
        assert "20 of 100 axes move" in figure.note
