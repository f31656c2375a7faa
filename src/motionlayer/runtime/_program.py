"""Programs and what they wait for.

A program is a coroutine, or a function that a task calls (`_cyclic`). A coroutine may await commands, `run.sleep` and
`run.until` among them; each suspends it until a later tick.
Who is due is decided before any program of a tick runs; each runs at most once per tick, in order of start.
"""

import abc
import sys
from collections.abc import Coroutine
from typing import Any, Final, NoReturn

from motionlayer.command import Command


class Cancelled(BaseException):
    """Thrown into a program at the place where it waits, when it is cancelled."""


class Deadline:
    """A `fail_after` that is open in a program."""

    __slots__ = ("seconds", "tick")

    def __init__(self, tick: int, seconds: float) -> None:
        self.tick = tick
        self.seconds = seconds


class Issuer(Command[Any]):
    """Code of the user's: while it runs, what is commanded is its own, and messages name it.

    Attributes:
        failure: the exception that left it, if any.
        warned: lines of which a warning has been given, which is done once.
        advice: what to do about a wait that has no effect.
    """

    advice: str

    def __init__(self, name: str, *, number: int, owner: Command[Any] | None) -> None:
        super().__init__(name, number=number, owner=owner)
        self.failure: BaseException | None = None
        self.warned: list[str] = []


class Program(Issuer, abc.ABC):
    """Something of the user's that runs in the programs step; a command too, so that it can be awaited."""

    def __init__(self, name: str, *, number: int, owner: Command[Any] | None) -> None:
        super().__init__(name, number=number, owner=owner)
        self.deadlines: list[Deadline] = []
        self.waits_for: Command[Any] | None = None
        self.cancelling = False
        self._value: Any = None

    def cancel(self) -> None:
        """End the program at its next turn; what it commanded goes on."""
        self.cancelling = True

    def resume(self, throw: BaseException | None = None) -> bool:
        """Give the program its turn; return False when it has come to its end.

        Args:
            throw: raised in the program at the place where it stands.

        Raises:
            BaseException: whatever leaves the program.
        """
        self.waits_for = None
        return self._go_on(throw)

    @abc.abstractmethod
    def _go_on(self, throw: BaseException | None) -> bool:
        """Let the user's code go on; see `resume`."""

    @property
    def value(self) -> Any:  # noqa: ANN401 - whatever the program returns
        """What the program returned in the end."""
        return self._value

    def close(self) -> None:
        """Let go of the program; it gets no turn any more."""


class CoroutineProgram(Program):
    """A running coroutine; its turn goes to the next wait. Cancelled, it is thrown `Cancelled` in the next tick."""

    advice = "write `await` before it"

    def __init__(
        self, coroutine: Coroutine[Any, Any, Any], name: str, *, number: int, owner: Command[Any] | None
    ) -> None:
        super().__init__(name, number=number, owner=owner)
        self._coroutine = coroutine

    def _go_on(self, throw: BaseException | None) -> bool:
        try:
            with _NoLoop():
                asked = self._coroutine.throw(throw) if throw is not None else self._coroutine.send(None)
                while not isinstance(asked, Command):
                    asked = self._coroutine.throw(_foreign(asked))
        except StopIteration as end:
            self._value = end.value
            return False
        self.waits_for = asked
        return True

    def close(self) -> None:
        """Let the coroutine run its `finally` blocks; it cannot wait any more."""
        self._coroutine.close()


class _NoLoop:
    """What asyncio finds while a program runs: without it `asyncio.sleep` would miss a loop, and say only that.

    An asyncio that nobody has imported is left alone, and so is a loop that the whole run happens in.
    """

    def __init__(self) -> None:
        self._events: Any = None

    def __enter__(self) -> None:
        events = sys.modules.get("asyncio.events")
        if events is not None and events._get_running_loop() is None:  # noqa: SLF001 - exported for makers of loops
            events._set_running_loop(self)  # noqa: SLF001
            self._events = events

    def __exit__(self, *_: object) -> None:
        if self._events is not None:
            self._events._set_running_loop(None)  # noqa: SLF001
            self._events = None

    def __getattr__(self, name: str) -> NoReturn:
        raise TypeError(f"a program has no asyncio loop ({name}): {_OWN_WAITS}; {_NOT_ASYNCIO}")


_OWN_WAITS: Final = "await a command, run.sleep(seconds) or run.until(predicate)"
_NOT_ASYNCIO: Final = "await run.sleep(seconds) instead of asyncio.sleep"


def _foreign(asked: object) -> TypeError:
    kind = f"{type(asked).__module__}.{type(asked).__qualname__}" if asked is not None else "a bare yield"
    advice = f"; {_NOT_ASYNCIO}" if "Future" in kind or asked is None else ""
    return TypeError(f"a program cannot await {kind}: {_OWN_WAITS}{advice}")
