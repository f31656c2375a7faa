"""A machine with blocks, called once per cycle; every call is observed."""

import functools
from collections.abc import Callable
from typing import Any

from motionlayer import Machine, Simulation
from motionlayer.bench.campaign._blocks import observer_of
from motionlayer.fb import AXIS_REF, MC_Power
from motionlayer.verify import assert_valid
from tests.machines import LINEAR


class Rig:
    """One axis or several, powered, whose blocks are called in every cycle.

    Args:
        count: of the axes X, Y, Z.
        power: call MC_Power with everything released before the first cycle of a test.
        top: more tables of the machine.
        changes: keys of the axes.
    """

    def __init__(
        self, count: int = 1, *, power: bool = True, top: dict[str, Any] | None = None, **changes: Any
    ) -> None:
        axis = dict.fromkeys("XYZ"[:count], LINEAR | changes)
        self.run = Simulation(Machine.from_dict({"format": 1, "name": "rig", "axis": axis} | (top or {})))
        self.refs = list(self.run.axis_refs.values())
        self.power = [MC_Power(ref) for ref in self.refs]
        self._watched: list[tuple[Any, Any]] = []
        if power:
            on = {"Enable": True, "Enable_Positive": True, "Enable_Negative": True}
            self.cycle(3, *[functools.partial(one, **on) for one in self.power])

    @property
    def ref(self) -> AXIS_REF:
        """The first axis."""
        return self.refs[0]

    def watch(self, *blocks: Any) -> None:
        """Observe blocks from now on; `cycle` calls them."""
        self._watched += [(block, observer_of(type(block).__name__)) for block in blocks]

    def cycle(self, ticks: int = 1, *calls: Callable[[], object]) -> None:
        """Run cycles: calls of the test, then those of all watched blocks with the inputs they have."""

        def main(_run: object) -> None:
            for call in calls:
                call()
            for block, observer in self._watched:
                block()
                observer.look(block)

        program = self.run.cyclic(main)
        self.run.step(ticks)
        program.cancel()
        if program.failure is not None:
            raise program.failure

    def until(self, done: Callable[[], bool], *calls: Callable[[], object], ticks: int = 5000) -> int:
        """Run cycles until something holds; return how many."""
        for count in range(ticks):
            if done():
                return count
            self.cycle(1, *calls)
        raise AssertionError("it did not come about")

    def check(self) -> None:
        """Let `verify` judge the run."""
        self.run.step(2)
        assert_valid(self.run.trace)
