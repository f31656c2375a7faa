"""Distributions of durations, cheap enough to be kept in every tick.

A histogram has a bin for each nanosecond below 64 ns; from there on every octave is cut into 32 equal bins, so that a
bin is at most 1/32 of its values wide. The place of a value follows from its bit length, without a logarithm, and the
bins are there from the beginning: adding costs a fifth of a microsecond and allocates nothing.
"""

from collections.abc import Sequence
from typing import Final, NamedTuple

_BITS: Final = 6
"""Bits of a value that are kept: the leading one, and five that cut its octave into 32 bins."""

_HALF: Final = 1 << (_BITS - 1)


class Statistics(NamedTuple):
    """What was measured in a run.

    Attributes:
        compute: duration of the ticks, without the wait for their time.
        lateness: by how much ticks began after they were due; empty in simulation.
        stages: longest call of each stage in nanoseconds, in order, by step and name.
        overruns: ticks that began at least one tick late.
        slips: how often time slipped.
        slipped: by how much in total, in seconds of the clock.
        brakes: how often all axes braked because ticks were late.
    """

    compute: "Histogram"
    lateness: "Histogram"
    stages: dict[str, int]
    overruns: int
    slips: int
    slipped: float
    brakes: int


class Spread(NamedTuple):
    """A distribution in four numbers, in nanoseconds; all 0 where nothing was measured."""

    min: int
    median: int
    p99: int
    max: int


class Histogram:
    """Counts of durations.

    Attributes:
        counts: values per bin.
    """

    __slots__ = ("_max", "_min", "counts")

    def __init__(self) -> None:
        self.counts = [0] * ((64 - _BITS + 1) * _HALF + _HALF)
        self._min = 2**63
        self._max = 0

    def add(self, value: int) -> None:
        """Count a duration in nanoseconds, 0 to 2^63 - 1."""
        shift = value.bit_length() - _BITS
        self.counts[value if shift <= 0 else (shift << (_BITS - 1)) + (value >> shift)] += 1
        if value > self._max:  # noqa: PLR1730 - max() and min() would double the cost
            self._max = value
        if value < self._min:  # noqa: PLR1730
            self._min = value

    @property
    def count(self) -> int:
        """Number of values."""
        return sum(self.counts)

    def quantile(self, share: float) -> int:
        """Return the duration in nanoseconds that a share (0 to 1) of all values does not exceed.

        It is the upper end of the bin, so at most 1/32 too large and never too small; 0 without values.
        """
        wanted = share * self.count
        seen = 0
        for index, count in enumerate(self.counts):
            seen += count
            if count and seen >= wanted:
                return min(_lowest(index + 1) - 1, self._max)
        return 0

    @property
    def spread(self) -> Spread:
        """Smallest, median, 99th percentile and largest value; smallest and largest are exact."""
        if not self.count:
            return Spread(0, 0, 0, 0)
        return Spread(self._min, self.quantile(0.5), self.quantile(0.99), self._max)

    def coarse(self, edges: Sequence[int]) -> list[int]:
        """Return the counts between wider edges, `len(edges) + 1` of them; a bin belongs where it begins.

        Args:
            edges: nanoseconds, rising.
        """
        found = [0] * (len(edges) + 1)
        for index, count in enumerate(self.counts):
            if count:
                found[sum(_lowest(index) >= edge for edge in edges)] += count
        return found


def _lowest(index: int) -> int:
    """Return the smallest value of a bin."""
    shift = max(0, (index >> (_BITS - 1)) - 1)
    return (index - (shift << (_BITS - 1))) << shift
