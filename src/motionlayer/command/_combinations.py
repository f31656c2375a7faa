"""`all_of` and `any_of`: commands that wait for others."""

from typing import Any

from motionlayer.command._command import Command


def all_of(*commands: Command[Any]) -> Command[tuple[Any, ...]]:
    """Return a command that is done when all are, with their results in order.

    The first that ends in error or aborted ends it the same way; the others go on.
    """
    whole: Command[tuple[Any, ...]] = Command(f"all_of({', '.join(c.name for c in commands)})")
    whole.activate()

    def look() -> None:
        if not whole.busy:
            return
        failed = next((command for command in commands if command.error is not None or command.aborted), None)
        if failed is not None and failed.error is not None:
            whole.fail(failed.error)
        elif failed is not None:
            whole.abort(failed.by)
        elif all(command.done for command in commands):
            whole.finish(tuple(command.result for command in commands))

    for command in commands:
        command.on_end(look, lambda: whole.awaited)
    look()
    return whole


def any_of(*commands: Command[Any]) -> Command[Command[Any]]:
    """Return a command that is done, however the first of them ends; its result is that one.

    Raises:
        ValueError: there is none to wait for.
    """
    if not commands:
        raise ValueError("any_of() of nothing would never end: give at least one command")
    whole: Command[Command[Any]] = Command(f"any_of({', '.join(c.name for c in commands)})")
    whole.activate()

    def look(command: Command[Any]) -> None:
        if whole.busy:
            whole.finish(command)

    for command in commands:
        command.on_end(lambda command=command: look(command), lambda: whole.awaited)  # type: ignore[misc]
    return whole
