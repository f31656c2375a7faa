"""Timing calls inside the process."""

import contextlib
import gc
import statistics
from collections.abc import Callable, Iterator
from time import perf_counter_ns

WARM_UP = 0.2
"""Calls before the first one that counts, as a share of those that do; at least one."""


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Keep the garbage collector away."""
    was_on = gc.isenabled()
    gc.collect()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def times_us(action: Callable[[], object], samples: int, *, between: Callable[[], object] | None = None) -> list[float]:
    """Return the time of every call of `action` in microseconds.

    Args:
        action: what is timed.
        samples: calls that count, >= 1.
        between: called after each, untimed.
    """
    times = []
    with quiet():
        for _ in range(1 + int(WARM_UP * samples) + samples):
            start = perf_counter_ns()
            action()
            times.append(perf_counter_ns() - start)
            if between is not None:
                between()
    return [time / 1e3 for time in times[-samples:]]


def median_us(action: Callable[[], object], samples: int, *, between: Callable[[], object] | None = None) -> float:
    """Return the median time of one call of `action` in microseconds; the arguments are those of `times_us`."""
    return statistics.median(times_us(action, samples, between=between))
