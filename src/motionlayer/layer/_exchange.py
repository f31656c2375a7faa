"""`Exchange`: which commands have gone to a layer in another machine, and which of them its State has answered.

Beside the layer a State is the answer to what the command field held in the same cycle. At the other end of a
connection it is an answer to something earlier. Numbers alone do not tell to what: a State that says MOVE_POS + DONE
may speak of the move before the last one. But the layer answers commands in their order, and a command is a change of
the field. So the changes that have gone out are counted, and a State that changes is the answer to the first of them
that it can be; those before it were lost on the way, or were answered too shortly to be seen from here.
"""

from motionlayer.layer._answer import split
from motionlayer.layer._controller import FINAL, LARGEST
from motionlayer.layer.types._commands import NO_INIT, AxisCommand
from motionlayer.layer.types._progress import Progress


class Exchange:
    """Commands and answers of one object.

    Args:
        first: what the field holds to begin with; State tells of it without being asked.

    Attributes:
        answered: how many of the commands that have gone out are answered, or can be no more.
    """

    def __init__(self, first: AxisCommand) -> None:
        self.answered = 0
        self._last = int(first)
        self._open: list[int] = []
        self._code: int | None = None

    def number(self, asked: int) -> int:
        """Return which command it is that the field holds: how many will have been answered with it."""
        return self.answered + len(self._open) + (asked != self._last)

    def give(self, asked: int) -> None:
        """Note what the command field holds as it goes out."""
        if asked != self._last:
            self._last = asked
            self._open.append(asked)

    def take(self, code: int) -> None:
        """Note what State shows as it comes in."""
        before, self._code = self._code, code
        if before is None or code == before or not _begins(code, before):
            return
        command = split(code).command
        place = next((place for place, asked in enumerate(self._open) if _can_answer(command, asked)), None)
        if place is not None:
            self.answered += place + 1
            del self._open[: place + 1]


def _begins(code: int, before: int) -> bool:
    """Tell whether a State is no further progress of the command of before, but speaks of another one."""
    (command, progress), (other, last) = split(code), split(before)
    return command != other or progress == Progress.INIT or last in FINAL


def _can_answer(command: int, asked: int) -> bool:
    """Tell whether a State of this command may be the answer; it has no room for numbers above 999."""
    return command in (asked, NO_INIT) or (asked > LARGEST and command == 0)
