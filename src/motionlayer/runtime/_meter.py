"""Measuring what the stages of a tick cost. What is measured decides nothing below the runtime's edge."""

from collections.abc import Callable, Sequence

from motionlayer.runtime._cycle import Stage
from motionlayer.runtime._statistics import Histogram


class Meter:
    """Run the stages of a tick and take their times.

    Args:
        stages: in the order in which they run.
        now_ns: the clock, in nanoseconds.

    Attributes:
        compute: duration of the ticks, without the wait for their time.
        longest: longest call of each stage in nanoseconds, in their order.
    """

    def __init__(self, stages: Sequence[Stage], now_ns: Callable[[], int]) -> None:
        self.compute = Histogram()
        self.longest = [0] * len(stages)
        self._stages = tuple(stages)
        self._calls = tuple((index, stage.run) for index, stage in enumerate(stages))
        self._now_ns = now_ns
        self._slowest = self._slowest_ns = 0
        self._part, self._part_ns = "", 0

    def run(self, tick: int) -> None:
        """Run one tick."""
        now_ns, longest = self._now_ns, self.longest
        begun = before = now_ns()
        for index, call in self._calls:
            call(tick)
            now = now_ns()
            took = now - before
            before = now
            if took > self._slowest_ns:
                self._slowest_ns, self._slowest = took, index
            if took > longest[index]:  # noqa: PLR1730 - max() would cost more than the rest
                longest[index] = took
        self.compute.add(before - begun)

    def note(self, name: str, took: int) -> None:
        """Take in what a part of a stage has cost (ns), so that it can be named."""
        if took > self._part_ns:
            self._part, self._part_ns = name, took

    def slowest(self) -> tuple[str, int]:
        """Return name and duration (ns) of the longest call since `forget`, or of the part that took most of it."""
        if 2 * self._part_ns > self._slowest_ns:
            return self._part, self._part_ns
        return self._stages[self._slowest].name, self._slowest_ns

    def forget(self) -> None:
        """Begin a new span: `slowest` tells of what comes from now on."""
        self._slowest_ns = self._part_ns = 0

    @property
    def stages(self) -> dict[str, int]:
        """Longest call of each stage in nanoseconds, by step and name."""
        names = [f"{stage.step.name.lower()}: {stage.name}" for stage in self._stages]
        return dict(zip(names, self.longest, strict=True))
