"""Job tables: how a call goes through the rows, and what is no job."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionlayer.command import Ledger
from motionlayer.layer import AXIS_JOBS, START_UP, Job, JobTable, Progress, Transition, a_call_later, always, nothing

P = Progress


def table(*rows: Transition[Any], **keywords: Any) -> JobTable[Any]:
    return JobTable("test", rows, **keywords)


class Switched(Job):
    """A job whose conditions are switches."""

    def __init__(self, of: JobTable[Any]) -> None:
        super().__init__(of, Ledger())
        self.on: list[str] = []
        self.done: list[str] = []


def when(name: str) -> Any:
    return lambda job: name in job.on


def do(name: str) -> Any:
    return lambda job: job.done.append(name)


FORWARD = table(
    Transition(P.INIT, always, do("begin"), P.OCCUPIED),
    Transition(P.OCCUPIED, when("failed"), do("fail"), P.ERROR),
    Transition(P.OCCUPIED, when("over"), do("release"), P.WORKING),
    Transition(P.OCCUPIED, when("again"), do("again"), P.INIT),
    Transition(P.WORKING, always, do("end"), P.DONE),
)


def test_execute_false_prepares_and_forgets_where_it_stood() -> None:
    job = Switched(FORWARD)
    assert job.call(execute=False) is P.INIT
    assert job.call(execute=True) is P.OCCUPIED
    assert job.call(execute=False) is P.INIT
    assert job.done == ["begin"]


def test_later_steps_run_through_in_one_call() -> None:
    job = Switched(FORWARD)
    job.on = ["over"]
    assert job.call(execute=True) is P.DONE
    assert job.done == ["begin", "release", "end"]


def test_an_earlier_step_waits_for_the_next_call() -> None:
    job = Switched(FORWARD)
    job.on = ["again"]
    assert job.call(execute=True) is P.INIT
    assert job.call(execute=True) is P.INIT
    assert job.done == ["begin", "again"] * 2


def test_the_order_of_steps_is_that_of_the_rows_and_not_of_the_numbers() -> None:
    down = table(
        Transition(P.INIT, always, nothing, P.STARTUP),
        Transition(P.STARTUP, always, nothing, P.PREPARE),
        Transition(P.PREPARE, always, nothing, P.DONE),
    )
    assert down.steps == (P.INIT, P.STARTUP, P.PREPARE)
    assert Switched(down).call(execute=True) is P.DONE


def test_without_a_row_that_holds_it_stays() -> None:
    job = Switched(FORWARD)
    assert [job.call(execute=True) for _ in range(3)] == [P.OCCUPIED] * 3
    assert job.done == ["begin"]


def test_the_first_row_that_holds_is_taken() -> None:
    job = Switched(FORWARD)
    job.on = ["over", "failed"]
    assert job.call(execute=True) is P.ERROR


def test_an_end_is_left_by_nothing_but_a_preparation() -> None:
    job = Switched(FORWARD)
    job.on = ["failed"]
    job.call(execute=True)
    job.on = ["over", "again"]
    assert job.call(execute=True) is P.ERROR
    assert job.take(FORWARD) is P.INIT


def test_a_step_can_be_shown_as_another_one() -> None:
    job = Switched(table(*FORWARD.rows, shows={P.OCCUPIED: P.BUSY}))
    assert job.call(execute=True) is P.BUSY
    assert job.step is P.OCCUPIED


def test_a_table_can_take_one_row_per_call() -> None:
    job = Switched(table(*FORWARD.rows, run_through=False))
    job.on = ["over"]
    assert [job.call(execute=True) for _ in range(3)] == [P.OCCUPIED, P.WORKING, P.DONE]


def test_a_step_can_wait_for_the_next_tick() -> None:
    job = Switched(
        table(Transition(P.INIT, always, nothing, P.BUSY), Transition(P.BUSY, a_call_later, nothing, P.DONE))
    )
    assert job.call(execute=True) is P.BUSY
    assert job.call(execute=True) is P.BUSY
    job.ledger.tick += 1
    assert job.call(execute=True) is P.DONE


@pytest.mark.parametrize(
    ("rows", "text"),
    [
        ([], "at least one row"),
        ([Transition(P.INIT, always, nothing, P.BUSY)], "no row leads on from BUSY"),
        (
            [Transition(P.INIT, always, nothing, P.DONE), Transition(P.BUSY, always, nothing, P.DONE)],
            "no row leads to the step BUSY",
        ),
        (
            [Transition(P.INIT, always, nothing, P.DONE), Transition(P.DONE, always, nothing, P.INIT)],
            "DONE is an end, and has rows",
        ),
    ],
)
def test_what_is_no_job_is_refused(rows: list[Transition[Any]], text: str) -> None:
    with pytest.raises(ValueError, match=f"test: .*{text}"):
        table(*rows)


@pytest.mark.parametrize("job", [*AXIS_JOBS.values(), START_UP], ids=lambda job: job.name)
def test_every_job_of_the_layer_can_come_to_an_end_from_each_of_its_steps(job: JobTable[Any]) -> None:
    reached = set(job.ends)
    for _ in job.steps:
        reached |= {row.step for row in job.rows if row.next in reached}
    assert reached >= set(job.steps)


@given(st.lists(st.sampled_from(["failed", "over", "again"]), max_size=3), st.integers(1, 8))
def test_a_call_always_returns_and_leaves_a_step_of_the_table(on: list[str], calls: int) -> None:
    job = Switched(FORWARD)
    job.on = on
    for _ in range(calls):
        assert job.call(execute=True) in (*FORWARD.steps, *FORWARD.ends)
