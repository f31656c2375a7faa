"""The life of one command: busy, then exactly one end."""

from collections.abc import Callable
from typing import Any

import pytest

from motionlayer.command import (
    ERRORS,
    Command,
    CommandAborted,
    CommandError,
    ErrorId,
    Ledger,
    MotionError,
)

ERROR = MotionError(ErrorId.VELOCITY, "X", "velocity = 7")
ENDS: dict[str, Callable[[Command[int]], None]] = {
    "done": lambda command: command.finish(1),
    "error": lambda command: command.fail(ERROR),
    "aborted": lambda command: command.abort(Command("other")),
}


def outputs(command: Command[Any]) -> dict[str, bool]:
    return {
        "busy": command.busy,
        "done": command.done,
        "aborted": command.aborted,
        "error": command.error is not None,
    }


def true_outputs(command: Command[Any]) -> list[str]:
    return [name for name, value in outputs(command).items() if value]


def test_begins_busy_and_inactive() -> None:
    command: Command[int] = Command("move")
    assert true_outputs(command) == ["busy"]
    assert not command.active


@pytest.mark.parametrize("end", ENDS)
def test_ends_in_exactly_one_way_and_inactive(end: str) -> None:
    command: Command[int] = Command("move")
    command.activate()
    ENDS[end](command)
    assert true_outputs(command) == [end]
    assert not command.active


@pytest.mark.parametrize("first", ENDS)
@pytest.mark.parametrize("second", ENDS)
def test_a_second_end_is_refused_and_changes_nothing(first: str, second: str) -> None:
    command: Command[int] = Command("move", number=12)
    ENDS[first](command)
    by = command.by
    with pytest.raises(RuntimeError, match=r"move .*12.* ended twice"):
        ENDS[second](command)
    assert true_outputs(command) == [first]
    assert command.by is by


def test_result_of_each_end() -> None:
    command: Command[int] = Command("move")
    with pytest.raises(RuntimeError, match="move is still busy"):
        _ = command.result
    command.finish(5)
    assert command.result == 5


def test_result_of_an_error_tells_what_happened_and_what_to_do() -> None:
    command: Command[int] = Command("X.move")
    command.fail(ERROR)
    with pytest.raises(CommandError) as caught:
        _ = command.result
    assert caught.value.error is ERROR
    assert caught.value.command is command
    for part in ("X.move", ERRORS[ErrorId.VELOCITY].text, "velocity = 7", "0x4221", "see max_velocity"):
        assert part in str(caught.value)


def test_result_of_an_abort_names_who_did_it() -> None:
    command: Command[int] = Command("X.move")
    other: Command[int] = Command("X.stop")
    command.abort(other)
    assert command.by is other
    with pytest.raises(CommandAborted, match=r"X\.move was aborted by X\.stop") as caught:
        _ = command.result
    assert caught.value.command is command


@pytest.mark.parametrize("end", ENDS)
def test_listeners_hear_the_end_once_in_order_with_the_outputs_set(end: str) -> None:
    command: Command[int] = Command("move")
    heard: list[Any] = []
    command.on_end(lambda: heard.append(("first", true_outputs(command))))
    command.on_end(lambda: heard.append(("second", true_outputs(command))))
    ENDS[end](command)
    assert heard == [("first", [end]), ("second", [end])]


def test_a_listener_that_comes_late_is_called_at_once() -> None:
    command: Command[int] = Command("move")
    command.finish(0)
    heard: list[int] = []
    command.on_end(lambda: heard.append(1))
    assert heard == [1]


def test_every_error_has_text_and_advice() -> None:
    assert set(ERRORS) == set(ErrorId)
    assert all(entry.text and entry.advice for entry in ERRORS.values())


def test_numbers_count_from_one() -> None:
    ledger = Ledger()
    assert [ledger.number() for _ in range(3)] == [1, 2, 3]


@pytest.mark.parametrize("end", [None, *ENDS])
def test_repr_names_command_and_state(end: str | None) -> None:
    command: Command[int] = Command("X.move")
    if end is not None:
        ENDS[end](command)
    state = f"error 0x4221: {ERROR.text}" if end == "error" else end or "busy"
    assert repr(command) == f"<Command X.move {state}>"
    if end is None:
        command.activate()
        assert repr(command) == "<Command X.move active>"
