"""What every test of the cutter has: a machine that runs, and a judge of its motion."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from motionlayer import Machine, Simulation
from motionlayer.verify import assert_valid

from .cutter import Cutter

MACHINE = Machine.load(Path(__file__).with_name("machine.toml"))


class Cell:
    """The machine without its usual program, and the chain under test.

    Attributes:
        run: the simulation; it stands still until `play` lets it go on.
        cutter: called in every cycle.
    """

    def __init__(self, run: Simulation) -> None:
        self.run = run
        while not run.layer.ready:
            run.step()
        self.cutter = Cutter(run.layer.axis["Feed"], run.layer.axis["Knife"], pieces=3)

    def play(self, time: float = 10.0) -> None:
        """Go on until the chain has ended, then let what still moves come to rest.

        Raises:
            AssertionError: it has not ended after `time` seconds of the machine.
        """
        end = self.run.time + time
        while not self.cutter.ended:
            assert self.run.time < end, f"still in {self.cutter.step} after {time} s"
            self.cutter.cycle()
            self.run.step()
        self.run.step(500)


@pytest.fixture
def cell() -> Iterator[Cell]:
    """A cell for one test; afterwards its motion is judged, whatever the test has looked at."""
    with Simulation(MACHINE, programs=()) as run:
        yield Cell(run)
    assert_valid(run.trace)
