"""Whatever blocks are called with: the rules of PLCopen hold, and so does everything that `verify` judges."""

import pytest

from motionlayer.bench.campaign._blocks import live
from motionlayer.verify import assert_valid


@pytest.mark.slow  # the short form of the campaign does the same in the quick suite
@pytest.mark.parametrize("seed", range(3))
def test_random_blocks_keep_the_rules(seed: int) -> None:
    assert_valid(live(seed, 0, 3400).trace)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 110))
def test_random_blocks_keep_the_rules_for_long(seed: int) -> None:
    assert_valid(live(seed, 0, 10_000).trace)
