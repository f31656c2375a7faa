"""A machine with a motion layer, and what its state fields have shown in every cycle."""

from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any, TypeVar

from motionlayer import Machine, Simulation
from motionlayer.event import Event
from motionlayer.layer import AxisObject, MotionLayer, Progress
from motionlayer.verify import assert_valid
from tests.machines import LINEAR

T = TypeVar("T")

SIMPLE = [Progress.INIT, Progress.OCCUPIED, Progress.DONE]
"""What most commands show."""

FAILED = [Progress.INIT, Progress.OCCUPIED, Progress.ERROR]
"""What they show when they cannot be carried out."""

SERVO: dict[str, Any] = {"drive": {"kind": "servo", "position_gain": 100.0}}
"""Keys of an axis whose drive can fail."""


class Rig:
    """Axes X, Y, Z … with a layer, brought up before the first cycle of a test.

    Args:
        count: of the axes.
        up: wait for the start-up.
        options: the table `[layer]`.
        top: more tables of the machine.
        changes: keys of the axes.
    """

    def __init__(
        self,
        count: int = 1,
        *,
        up: bool = True,
        options: dict[str, Any] | None = None,
        top: dict[str, Any] | None = None,
        **changes: Any,
    ) -> None:
        names = [chr(ord("X") + place) if place < 3 else f"A{place + 1}" for place in range(count)]
        axis = dict.fromkeys(names, LINEAR | changes)
        tables = {"format": 1, "name": "rig", "axis": axis, "layer": options or {}} | (top or {})
        self.run = Simulation(Machine.from_dict(tables))
        layer = self.run.layer
        assert isinstance(layer, MotionLayer)
        self.layer = layer
        self.codes: list[list[int]] = [[] for _ in names]
        self.messages: list[Event] = []
        self.run.events.listen(self._listen)
        if up:
            self.until(lambda: self.layer.ready)

    @property
    def x(self) -> AxisObject:
        """The first axis."""
        return self.layer.axis[1]

    def _listen(self, event: Event) -> None:
        self.messages.append(event)

    def texts(self, part: object) -> list[str]:
        """Return the texts of the layer's messages of a part."""
        return [event.text for event in self.messages if event.subdevice == part and event.command == 0]

    def cycle(self, ticks: int = 1) -> None:
        """Run cycles, and see what the states show at the end of each."""
        for _ in range(ticks):
            self.run.step()
            for codes, one in zip(self.codes, self.layer.axis, strict=True):
                codes.append(one.state.code)

    def seen(self, look: Callable[[], T], ticks: int) -> list[T]:
        """Run cycles; return what was seen at the end of each."""
        found = []
        for _ in range(ticks):
            self.cycle()
            found.append(look())
        return found

    def until(self, done: Callable[[], bool], ticks: int = 20_000) -> int:
        """Run cycles until something holds; return how many."""
        for count in range(ticks):
            if done():
                return count
            self.cycle()
        raise AssertionError(f"it did not come about; the states are {[one.state for one in self.layer.axis]}")

    def drop(self, command: int, axis: int = 1) -> int:
        """Write a command and run the cycle that sees it; return the state at its end."""
        self.layer.axis[axis].ctrl.cmd = command
        self.cycle()
        return self.layer.axis[axis].state.code

    def do(self, command: int, axis: int = 1) -> list[int]:
        """Drop a command and run until it has ended; return the states it has shown, each once, by their progress."""
        begin = len(self.codes[axis - 1])
        self.drop(command, axis)
        state = self.layer.axis[axis].state
        self.until(lambda: state.code % 10000 == 0 or state.split().progress in ENDS)
        return [code - command for code in shown(self.codes[axis - 1][begin:])]

    def ready(self, *, home: bool = False) -> "Rig":
        """Switch all axes on, and home them."""
        for one in self.layer.axis:
            assert self.do(3, one.index)[-1] == Progress.DONE
            if home:
                assert self.do(11, one.index)[-1] == Progress.DONE
        return self

    def check(self) -> None:
        """Let `verify` judge the run."""
        self.run.step(2)
        assert_valid(self.run.trace)


ENDS = (Progress.ERROR, Progress.DONE, Progress.NOT_EXIST)


def shown(codes: list[int]) -> Iterator[int]:
    """Yield states without repetition."""
    yield codes[0]
    yield from (after for before, after in pairwise(codes) if after != before)


def aim(rig: Rig, position: float, velocity: float = 200.0, **others: Any) -> None:
    """Write the move data of the first axis."""
    for name, value in {"position": position, "velocity": velocity, **others}.items():
        setattr(rig.x.data, name, value)


def place(rig: Rig) -> float:
    """Return the set position of the first axis."""
    return rig.run.axes["X"].set_position
