"""The control program of the cutter: feed a length, cut, and again. It knows nothing but Ctrl and State.

The rule that the tests hold it to: material moves only while the knife is up.
"""

import enum

from motionlayer import Simulation
from motionlayer.layer import AxisCommand, AxisObject, Progress

LENGTH = 120.0
"""Of a piece, mm."""
UP, DOWN = 0.0, 60.0
"""Positions of the knife, mm."""
CLEAR = 1.0
"""Up to here the knife is out of the way, mm."""
RETRIES = 3
"""So often in a row a piece is begun again after an error."""


class Step(enum.Enum):
    """What the cutter is at."""

    RESET = enum.auto()
    SWITCH_ON = enum.auto()
    RETRACT = enum.auto()
    FEED = enum.auto()
    CUT = enum.auto()
    FINISHED = enum.auto()
    ALARM = enum.auto()


NEXT = {
    Step.RESET: Step.SWITCH_ON,
    Step.SWITCH_ON: Step.RETRACT,
    Step.RETRACT: Step.FEED,
    Step.FEED: Step.CUT,
    Step.CUT: Step.RETRACT,
}
"""Which step follows, as long as there are pieces."""


class Cutter:
    """The step chain.

    Args:
        feed: moves the material.
        knife: moves the knife.
        pieces: how many to cut.

    Attributes:
        step: where it is.
        cut: pieces that are cut.
        errors: how often an axis failed since the last piece.
    """

    def __init__(self, feed: AxisObject, knife: AxisObject, pieces: int) -> None:
        self.step = Step.SWITCH_ON
        self.cut = 0
        self.errors = 0
        self._feed, self._knife, self._pieces = feed, knife, pieces
        self._begun = False

    @property
    def ended(self) -> bool:
        """Whether there is nothing more to do, or no way on."""
        return self.step in (Step.FINISHED, Step.ALARM)

    def cycle(self) -> None:
        """Look at the answers, and go on."""
        if self.ended:
            return
        if self.step is not Step.RESET and self._failed():
            self.errors += 1
            self._go(Step.RESET if self.errors <= RETRIES else Step.ALARM)
        elif self._done():
            if self.step is Step.CUT:
                self.cut, self.errors = self.cut + 1, 0
            self._go(Step.FINISHED if self.step is Step.RETRACT and self.cut == self._pieces else NEXT[self.step])

    def _done(self) -> bool:
        """Work on the step; return whether it is done."""
        match self.step:
            case Step.RESET:  # the other axis may still brake
                return self._both(AxisCommand.RESET) and self._feed.info.standstill and self._knife.info.standstill
            case Step.SWITCH_ON:
                return self._both(AxisCommand.ENABLE)
            case Step.RETRACT:
                return self._moved(self._knife, UP, 500.0)
            case Step.FEED:
                return self._moved(self._feed, LENGTH * (self.cut + 1), 700.0)
            case _:
                return self._moved(self._knife, DOWN, 300.0)

    def _go(self, step: Step) -> None:
        self.step, self._begun = step, False

    def _failed(self) -> bool:
        return self._feed.info.error or self._knife.info.error

    def _both(self, command: AxisCommand) -> bool:
        """Give both axes a command, by way of NULL; return whether both are done."""
        axes = self._feed, self._knife
        for axis in axes:
            axis.ctrl.cmd = command if self._begun else AxisCommand.NULL
        done = self._begun and all(axis.state.split() == (command, Progress.DONE) for axis in axes)
        self._begun = True
        return done

    def _moved(self, axis: AxisObject, position: float, velocity: float) -> bool:
        """Move an axis, by way of NULL; return whether it is there."""
        axis.data.position, axis.data.velocity = position, velocity
        axis.ctrl.cmd = AxisCommand.MOVE_POS if self._begun else AxisCommand.NULL
        done = self._begun and axis.state.split() == (AxisCommand.MOVE_POS, Progress.DONE)
        self._begun = True
        return done


async def main(run: Simulation, pieces: int = 10) -> None:
    """Call the chain in every cycle until it has ended."""
    await run.layer.started()
    cutter = Cutter(run.layer.axis["Feed"], run.layer.axis["Knife"], pieces)
    while not cutter.ended:
        cutter.cycle()
        await run.sleep(0)
    print(f"{run.time:.3f} s: {cutter.step.name}, {cutter.cut} pieces")
