"""States: a command and its progress in one number (motion-layer 5.1), and waiting for one."""

import enum
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final, NamedTuple, Protocol

from motionlayer.command import ERRORS, Command, CommandError, ErrorId, MotionError
from motionlayer.layer.types._commands import NO_INIT, AxisCommand
from motionlayer.layer.types._progress import Progress

if TYPE_CHECKING:
    from motionlayer.layer._exchange import Exchange

BLOCK: Final = 1000
"""Numbers of a progress: its base, and the commands behind it."""

_BAD: Final = (Progress.ERROR, Progress.NOT_EXIST)


class Answer(NamedTuple):
    """A state, split; made for `match`. Numbers without a member stay numbers.

    Attributes:
        command: which command the state is about; NULL where it is about none (D61).
        progress: how far it is.
    """

    command: int
    progress: int


def split(state: int, commands: type[enum.IntEnum] = AxisCommand) -> Answer:
    """Split a state.

    Args:
        state: as published.
        commands: the enumeration of the commands.
    """
    number, progress = state % BLOCK, state - state % BLOCK
    if progress == 0 and number >= Progress.NOT_EXIST:
        number, progress = number - Progress.NOT_EXIST, int(Progress.NOT_EXIST)
    known = commands(number) if number in commands._value2member_map_ else number
    return Answer(known, Progress(progress) if progress in Progress._value2member_map_ else progress)


class LayerError(CommandError):
    """A command of the layer has not come to DONE.

    Attributes:
        state: as published.
        error_id: number of the error, 0 without one.
    """

    def __init__(self, wait: "StateWait", error: MotionError, text: str, *, state: int, error_id: int) -> None:
        super().__init__(wait, error)
        self.args = (text,)
        self.state, self.error_id = state, error_id


class Pair(Protocol):
    """A command field and a state field, as one who waits sees them."""

    name: str
    commands: type[enum.IntEnum]
    exchange: "Exchange | None"

    @property
    def asked(self) -> int:
        """What the command field holds."""

    @property
    def code(self) -> int:
        """What the state field holds."""

    @property
    def error_id(self) -> int:
        """Number of the error, 0 without one."""


class StateWait(Command[int]):
    """Wait until a state shows that a command is done; the result is the state.

    Args:
        pair: the object.
        command: which command.
    """

    def __init__(self, pair: Pair, command: int) -> None:
        shown = pair.commands(command).name if command in pair.commands._value2member_map_ else str(command)
        super().__init__(f"{pair.name}: {shown}")
        self._pair = pair
        self._wanted = command
        self._number = 0 if pair.exchange is None else pair.exchange.number(pair.asked)
        self._why = ""
        self._code = self._error_id = 0
        self.activate()

    def look(self) -> None:
        """Take up what the state shows."""
        code = self._pair.code
        command, progress = split(code, self._pair.commands)
        later = self._later()
        if later == 0 and command in (self._wanted, NO_INIT):
            if progress == Progress.DONE:
                self.finish(code)
            elif progress in _BAD:
                self._give_up(code, f"the state is {code}, {_named(progress)}")
        elif later > 0 or self._pair.asked != self._wanted:
            self._give_up(code, f"another command has taken its place, the state is {code}")

    def _later(self) -> int:
        """Return how many commands later the one is that the state answers; less than 0 for an earlier one."""
        exchange = self._pair.exchange
        return 0 if exchange is None else exchange.answered - self._number

    def _give_up(self, code: int, why: str) -> None:
        number = self._pair.error_id
        known = ErrorId(number) if number in ERRORS else None
        self._why = f"{why}{f'; error 0x{number:04X}' if number else ''}{f', {ERRORS[known].text}' if known else ''}"
        self._code, self._error_id = code, number
        self.fail(MotionError(known or ErrorId.COMMAND_NOT_DONE, self._pair.name, f"state {code}"))

    @property
    def result(self) -> int:
        """The state.

        Raises:
            LayerError: the command has not come to DONE.
            RuntimeError: it is still under way.
        """
        if self.error is not None:
            text = f"{self.name}: {self._why}"
            raise LayerError(self, self.error, text, state=self._code, error_id=self._error_id)
        return super().result


class Waits:
    """Everything that waits for a state; looked at once per cycle, when all states are what they are."""

    def __init__(self) -> None:
        self.open: list[StateWait] = []

    def add(self, pair: Pair, command: int) -> StateWait:
        """Wait, from the next look on."""
        wait = StateWait(pair, command)
        self.open.append(wait)
        return wait

    def look(self) -> None:
        """Let those end that have come to an end."""
        for wait in self.open:
            wait.look()
        self.open = [wait for wait in self.open if wait.busy]


def _named(progress: int) -> str:
    return f"PROGRESS_{Progress(progress).name}" if progress in Progress._value2member_map_ else str(progress)


class ObjectState:
    """The state of one object, as control programs use it.

    Args:
        name: of the object, for messages.
        commands: enumeration of the commands.
        asked: returns what the command field holds.
        view: the structure with the field `state`.
        error_id: returns the number of the error.
        waits: of the layer.

    Attributes:
        exchange: what has gone out and come back, where the layer is in another machine; None beside the layer, whose
            states answer what the command field holds in the same cycle.
    """

    exchange: "Exchange | None" = None

    def __init__(
        self,
        name: str,
        commands: type[enum.IntEnum],
        asked: Callable[[], int],
        view: Any,  # noqa: ANN401 - any structure with a field `state`
        error_id: Callable[[], int],
        waits: Waits,
    ) -> None:
        self.name = name
        self.commands = commands
        self.view = view
        self._asked = asked
        self._error_id = error_id
        self._waits = waits

    @property
    def asked(self) -> int:
        """What the command field holds."""
        return self._asked()

    @property
    def code(self) -> int:
        """The state, command + progress."""
        return int(self.view.state)

    @property
    def error_id(self) -> int:
        """Number of the error, 0 without one."""
        return self._error_id()

    def split(self) -> Answer:
        """Return command and progress, for `match`."""
        return split(self.code, self.commands)

    def done(self, command: int) -> StateWait:
        """Return what can be awaited until a command is done; write the command field before.

        It is the command that the field holds now: what the state shows of an earlier one with the same number does not
        count. Awaiting it raises LayerError where the command ends in error, does not exist, or is replaced.

        Raises:
            ValueError: no state has room for the number of the command.
        """
        if not 0 <= command < BLOCK:
            raise ValueError(f"{self.name}: no state tells of command {int(command)}; allowed: 0 to {BLOCK - 1}")
        return self._waits.add(self, int(command))

    def __repr__(self) -> str:
        command, progress = self.split()
        name = command.name if isinstance(command, enum.Enum) else str(command)
        return f"<{self.name}: {self.code} = {name} + {_named(progress)}>"
