"""`Starting`: who waits until a layer is ready, on either side."""

from collections.abc import Callable

from motionlayer.command import Command


class Starting:
    """Commands that are done as soon as the start-up is.

    Args:
        ready: tells whether it is.
    """

    def __init__(self, ready: Callable[[], bool]) -> None:
        self._ready = ready
        self._waiting: list[Command[None]] = []

    def wait(self) -> Command[None]:
        """Return what can be awaited."""
        command: Command[None] = Command("motion layer: started")
        command.activate()
        if self._ready():
            command.finish(None)
        else:
            self._waiting.append(command)
        return command

    def look(self) -> None:
        """Tell those who wait; once in a cycle."""
        if self._waiting and self._ready():
            waiting, self._waiting = self._waiting, []
            for command in waiting:
                command.finish(None)
