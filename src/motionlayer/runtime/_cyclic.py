"""Cyclic programs: plain functions that a task calls in each of its cycles, as a PLC calls its programs."""

import inspect
from collections.abc import Callable, Coroutine
from types import SimpleNamespace
from typing import Any

from motionlayer.command import Command
from motionlayer.runtime._program import Program


class CyclicProgram(Program):
    """A function called in every cycle of its task, until it is cancelled or an exception leaves it.

    Attributes:
        memory: what the function keeps between its calls; its second argument, if it takes two.
        since: the first tick in which it may be called.
    """

    advice = "a cyclic program cannot wait; let it return, and look again when it is called in the next cycle"

    def __init__(
        self,
        function: Callable[..., None],
        run: object,
        name: str,
        *,
        with_memory: bool,
        number: int,
        owner: Command[Any] | None,
        since: int,
    ) -> None:
        super().__init__(name, number=number, owner=owner)
        self.memory = SimpleNamespace()
        self.since = since
        self._function = function
        self._run = run
        self._with_memory = with_memory

    def _go_on(self, throw: BaseException | None) -> bool:
        if throw is not None:
            raise throw
        answer: object = self._function(self._run, self.memory) if self._with_memory else self._function(self._run)
        if answer is not None:
            raise _answered(self._function, answer)
        return True


def takes_memory(function: Callable[..., object]) -> bool:
    """Tell whether a cyclic function is `def f(run, memory)` and not `def f(run)`.

    A second parameter with a default is not the memory.

    Raises:
        TypeError: it is neither.
    """
    name = getattr(function, "__name__", repr(function))
    if inspect.iscoroutinefunction(function) or inspect.isgeneratorfunction(function):
        raise TypeError(
            f"{name}: not a plain function; a cyclic program is `def {name}(run)` or `def {name}(run, memory)`, "
            f"and `async def` is started with run.start({name}())"
        )
    signature = inspect.signature(function)
    for arguments in ((None,), (None, None)):
        try:
            signature.bind(*arguments)
        except TypeError:
            continue
        return len(arguments) == 2
    raise TypeError(f"{name}{signature}: a cyclic program is `def {name}(run)` or `def {name}(run, memory)`")


def _answered(function: Callable[..., object], answer: object) -> TypeError:
    name = getattr(function, "__name__", repr(function))
    if isinstance(answer, Coroutine):
        answer.close()
        return TypeError(f"{name} returned a coroutine; write `async def {name}(run)`, which runs from wait to wait")
    return TypeError(
        f"{name} returned {answer!r:.60}; a cyclic program returns nothing, and ends with run.program.cancel()"
    )
