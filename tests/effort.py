"""How much tests with random inputs try: all in the full suite, a share in the quick one (`scripts/check.py`)."""

from collections.abc import Iterable
from typing import Any, Final

import pytest
from hypothesis import settings

QUICK: Final = "quick"
"""Profile of hypothesis that the quick suite selects."""

SHARE: Final = 4
"""The quick suite takes one of so many examples."""

LEAST: Final = 5


def quick() -> bool:
    """Tell whether this is the quick suite."""
    return settings.get_current_profile_name() == QUICK


def register() -> None:
    """Make the profile known; a test that names no count takes a share of the usual one."""
    settings.register_profile(QUICK, max_examples=settings.get_profile("default").max_examples // SHARE)


def examples(count: int) -> int:
    """Return how many of `count` examples to try."""
    return max(count // SHARE, LEAST) if quick() else count


def thinned(values: Iterable[Any], each: int = SHARE) -> list[Any]:
    """Return parameters of a test of which the quick suite takes the first of so many; the others are slow.

    A tuple holds the values of several parameters.
    """
    return [
        pytest.param(*(value if isinstance(value, tuple) else (value,)), marks=[pytest.mark.slow] * (number % each > 0))
        for number, value in enumerate(values)
    ]
