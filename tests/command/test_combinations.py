"""`all_of` and `any_of`."""

import itertools

import pytest

from motionlayer.command import Command, ErrorId, MotionError, all_of, any_of

ERROR = MotionError(ErrorId.VELOCITY, "X")


def three() -> list[Command[int]]:
    return [Command(name) for name in "abc"]


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_all_of_is_done_with_the_last_and_gives_the_results_in_the_order_of_the_call(
    order: tuple[int, ...],
) -> None:
    commands = three()
    whole = all_of(*commands)
    for count, index in enumerate(order):
        assert whole.busy, f"done after {count} of 3"
        commands[index].finish(10 * index)
    assert whole.result == (0, 10, 20)


def test_all_of_ends_with_the_first_error_while_the_others_go_on() -> None:
    first, second, third = three()
    whole = all_of(first, second, third)
    second.fail(ERROR)
    assert whole.error is ERROR
    assert first.busy
    assert third.busy
    first.finish(1)
    third.abort()
    assert whole.error is ERROR


def test_all_of_ends_aborted_by_whoever_aborted_the_part() -> None:
    first, second, _ = three()
    other: Command[int] = Command("stop")
    whole = all_of(first, second)
    second.abort(other)
    assert whole.aborted
    assert whole.by is other


def test_all_of_nothing_is_done() -> None:
    assert all_of().result == ()


def test_all_of_the_ended_has_ended() -> None:
    first, second, third = three()
    first.finish(1)
    second.finish(2)
    assert all_of(first, second).result == (1, 2)
    third.fail(ERROR)
    assert all_of(first, third, second).error is ERROR


def test_all_of_may_name_a_command_twice() -> None:
    first = three()[0]
    whole = all_of(first, first)
    first.finish(4)
    assert whole.result == (4, 4)


@pytest.mark.parametrize("end", ["done", "error", "aborted"])
def test_any_of_is_done_however_the_first_ends(end: str) -> None:
    first, second, third = three()
    whole = any_of(first, second, third)
    if end == "done":
        second.finish(1)
    elif end == "error":
        second.fail(ERROR)
    else:
        second.abort()
    assert whole.result is second
    third.finish(3)
    first.fail(ERROR)
    assert whole.result is second


def test_any_of_the_ended_gives_the_first_in_the_order_of_the_call() -> None:
    first, second, third = three()
    third.finish(3)
    second.finish(2)
    assert any_of(first, second, third).result is second


def test_any_of_nothing_is_refused() -> None:
    with pytest.raises(ValueError, match="at least one command"):
        any_of()


def test_combinations_nest() -> None:
    first, second, third = three()
    whole = any_of(all_of(first, second), third)
    first.finish(1)
    assert whole.busy
    second.finish(2)
    assert whole.result.result == (1, 2)


def somebody_waits(command: Command[int]) -> bool:
    return command.awaited


def test_nobody_awaits_what_only_an_unawaited_combination_listens_to() -> None:
    first, second, _ = three()
    whole = any_of(first, second)
    assert not somebody_waits(first)
    whole.on_end(lambda: None)
    assert somebody_waits(first)
    second.finish(2)
    assert not somebody_waits(first)
