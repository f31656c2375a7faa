"""`Command`, its errors, and the ledger that numbers commands."""

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import Any, Generic, NamedTuple, TypeVar, cast

from motionlayer.command._errors import ERRORS, ErrorId

T = TypeVar("T")


class ObjectInfo(NamedTuple):
    """An object of the run, by kind and name; what stands in a command's way is named like this."""

    kind: str
    name: str


@dataclass(frozen=True, slots=True)
class MotionError:
    """Why a command or an axis is in error.

    Attributes:
        id: error id, see `ERRORS`.
        source: the object it happened to.
        detail: value, limit and unit, where there are any.
    """

    id: ErrorId
    source: str
    detail: str = ""

    @property
    def text(self) -> str:
        """What happened and the way out, without the source."""
        text, advice, _ = ERRORS[self.id]
        detail = f" ({self.detail})" if self.detail else ""
        return f"{text}{detail} [0x{self.id:04X}]; {advice}"

    def __str__(self) -> str:
        return f"{self.source}: {self.text}"


class CommandError(Exception):
    """Raised where a command that ended in error is awaited; `error` says why."""

    def __init__(self, command: "Command[Any]", error: MotionError) -> None:
        super().__init__(f"{command.name}: {error.text}")
        self.command = command
        self.error = error


class CommandAborted(Exception):  # noqa: N818 - the field says "command aborted"
    """Raised where an aborted command is awaited; `command.by` is what replaced it."""

    def __init__(self, command: "Command[Any]") -> None:
        by = f" by {command.by.name}" if command.by is not None else ""
        super().__init__(f"{command.name} was aborted{by}")
        self.command = command


class Ledger:
    """What a run knows about its commands: the present tick, who issues them, and their numbers.

    Attributes:
        tick: the tick being worked on.
        issuer: the program that runs now, None outside programs.
        turn: number of the turn of the task whose programs run now, the tick outside tasks; so it goes up by one from
            one call of a cyclic program to the next.
    """

    __slots__ = ("_last", "issuer", "tick", "turn")

    def __init__(self) -> None:
        self.tick = 0
        self.issuer: Command[Any] | None = None
        self.turn = 0
        self._last = 0

    def number(self) -> int:
        """Return the number of the next command, from 1."""
        self._last += 1
        return self._last


class Command(Generic[T]):
    """Something that takes time.

    Exactly one of `busy`, `done`, `aborted` and `error is not None` holds at any time. Only the object that
    executes the command calls `activate`, `finish`, `fail` and `abort`.

    Attributes:
        name: what was commanded, for messages: `X.move_absolute`.
        number: number within the run, 0 for combinations.
        owner: the program that issued it.
        active: the object works on it right now.
        error: set once it ended in error.
        by: the command that aborted it.
        blocker: what is in the way, where the command waits for something.
    """

    def __init__(self, name: str, *, number: int = 0, owner: "Command[Any] | None" = None) -> None:
        self.name = name
        self.number = number
        self.owner = owner
        self.active = False
        self.done = False
        self.aborted = False
        self.error: MotionError | None = None
        self.by: Command[Any] | None = None
        self.blocker: ObjectInfo | None = None
        self._result: T | None = None
        self._listeners: list[tuple[Callable[[], None], Callable[[], bool]]] = []

    @property
    def busy(self) -> bool:
        """The command has not ended."""
        return not (self.done or self.aborted or self.error is not None)

    @property
    def result(self) -> T:
        """What the command gives.

        Raises:
            CommandError: it ended in error.
            CommandAborted: it was aborted.
            RuntimeError: it is still busy.
        """
        if self.error is not None:
            raise CommandError(self, self.error)
        if self.aborted:
            raise CommandAborted(self)
        if not self.done:
            raise RuntimeError(f"{self.name} is still busy: await it, or ask `done` first")
        return cast("T", self._result)

    def __await__(self) -> Generator["Command[Any]", None, T]:
        if self.busy:
            yield self
        return self.result

    async def settled(self) -> "Command[T]":
        """Wait for the end, however it ends, and return the command itself."""
        if self.busy:
            await _Pause(self)
        return self

    def on_end(self, listener: Callable[[], None], waiting: Callable[[], bool] = lambda: True) -> None:
        """Call `listener` when the command ends; at once if it has.

        Args:
            listener: called without arguments.
            waiting: tells whether the listener still stands for somebody who waits; see `awaited`.
        """
        if self.busy:
            self._listeners.append((listener, waiting))
        else:
            listener()

    @property
    def awaited(self) -> bool:
        """Somebody waits for the end."""
        return any(waiting() for _, waiting in self._listeners)

    def activate(self) -> None:
        """The object begins to work on it."""
        self.active = True

    def finish(self, result: T) -> None:
        """End it done."""
        self._end()
        self.done = True
        self._result = result
        self._tell()

    def fail(self, error: MotionError) -> None:
        """End it in error."""
        self._end()
        self.error = error
        self._tell()

    def abort(self, by: "Command[Any] | None" = None) -> None:
        """End it aborted."""
        self._end()
        self.aborted = True
        self.by = by
        self._tell()

    def _end(self) -> None:
        if not self.busy:
            raise RuntimeError(f"{self.name} (command {self.number}) ended twice")
        self.active = False

    def _tell(self) -> None:
        listeners, self._listeners = self._listeners, []
        for listener, _ in listeners:
            listener()

    def __repr__(self) -> str:
        state = "done" if self.done else "aborted" if self.aborted else "active" if self.active else "busy"
        if self.error is not None:
            state = f"error 0x{self.error.id:04X}: {self.error.text}"
        return f"<{type(self).__name__} {self.name} {state}>"


class _Pause:
    """Wait for the end of a command without asking for its result."""

    def __init__(self, command: Command[Any]) -> None:
        self._command = command

    def __await__(self) -> Generator[Command[Any], None, None]:
        yield self._command
