"""How much tests with random inputs try: all in the full suite, a share in the quick one (`scripts/check.py`)."""

from typing import Final

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
