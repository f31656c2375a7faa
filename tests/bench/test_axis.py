"""The rows of the group `axis`, measured with next to no repetitions. Nothing here judges a time."""

import math

import pytest
from tests.effort import thinned

from motionlayer.bench import GROUPS, Effort, Row
from motionlayer.bench import _axis as axis

TINY = Effort(samples=3, runs=1)


def test_the_axis_group_has_these_rows() -> None:
    assert [(row.name, row.unit, str(row.goal)) for row in GROUPS["axis"]] == [
        ("moves.axes_1000", "µs", "≤ 150"),
        ("moves.axes_1000_p99", "µs", "≤ 600"),
        ("blocks.busy_64", "µs", "≤ 120"),
        ("image.axes_1000", "µs", "≤ 40"),
        ("blend.chain_1000", "relative", "≤ 1e-09"),
    ]


@pytest.mark.parametrize("row", thinned(GROUPS["axis"], 3), ids=lambda row: row.name)
def test_every_row_gives_a_number(row: Row) -> None:
    assert math.isfinite(row.measure(TINY).value)


def test_a_short_chain_takes_what_the_blend_rule_says() -> None:
    assert axis.chain(Effort(samples=20, runs=1)).value < 1e-9


def test_the_closed_form_of_one_move_is_known() -> None:
    """200 mm/s with 1e5 mm/s³ in two ramps of 2 sqrt(0.002) s, 20 mm in all."""
    ramp = 2.0 * math.sqrt(0.002)
    assert axis.chain_time([200.0]) == pytest.approx(2.0 * ramp + (20.0 - 200.0 * ramp) / 200.0)
