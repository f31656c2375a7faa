"""The mailbox: what other threads post is applied in order, once, and acknowledged."""

import threading
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionlayer.command import Ledger
from motionlayer.event import Device, EventLog, Input, Level
from motionlayer.runtime import Mailbox, MailboxFull, Receipt, Stage, Step
from tests.runtime.bare import bare

PAYLOADS = st.lists(st.tuples(st.sampled_from(["a", "b"]), st.binary(max_size=8)), max_size=20)


def mailbox(capacity: int = 100) -> tuple[Mailbox, EventLog, Ledger]:
    """Return a mailbox with the channels a and b, which take anything."""
    ledger, events = Ledger(), EventLog()
    box = Mailbox(ledger, events, capacity)
    for name in "ab":
        box.register(name, lambda _payload: None)
    return box, events, ledger


def tick(box: Mailbox, ledger: Ledger) -> None:
    box.apply(ledger.tick)
    box.acknowledge(ledger.tick)
    ledger.tick += 1


def in_threads(*works: Callable[[], None]) -> list[threading.Thread]:
    threads = [threading.Thread(target=work, daemon=True) for work in works]
    for thread in threads:
        thread.start()
    return threads


def test_an_input_is_applied_before_the_other_stages_and_acknowledged_after_the_outputs() -> None:
    seen: list[str] = []
    receipts: list[Receipt] = []
    stages = [
        Stage(Step.INPUTS, "drives", lambda _: seen.append("drives")),
        Stage(Step.OUTPUTS, "outputs", lambda _: seen.append(f"outputs, settled {receipts[0].settled}")),
        Stage(Step.OBSERVE, "observer", lambda _: seen.append(f"observer, settled {receipts[0].settled}")),
    ]
    run = bare(stages=stages)
    run.mailbox.register("part", lambda payload: seen.append(payload.decode()))
    run.mailbox.listen(lambda one: seen.append(f"recorded at {one.tick}"))
    receipts.append(run.mailbox.post("part", b"applied"))
    assert not receipts[0].settled
    run.step()
    assert seen == ["recorded at 0", "applied", "drives", "outputs, settled False", "observer, settled True"]
    assert receipts[0].wait(0.0) == 0


def test_what_is_posted_while_inputs_are_applied_is_for_the_next_tick() -> None:
    run = bare()
    applied: list[int] = []

    def handler(payload: bytes) -> None:
        applied.append(run.tick)
        if payload:
            run.mailbox.post("part", payload[1:])

    run.mailbox.register("part", handler)
    run.mailbox.post("part", b"12")
    run.step(5)
    assert applied == [0, 1, 2]


@settings(deadline=None)
@given(PAYLOADS, st.lists(st.integers(0, 19), max_size=4))
def test_a_replay_of_what_was_recorded_is_the_same(posts: list[tuple[str, bytes]], ticks_before: list[int]) -> None:
    def record(feed: list[Input] | None) -> list[Input]:
        box, _, ledger = mailbox()
        seen: list[Input] = []
        box.listen(seen.append)
        box.feed(feed or [])
        for index, post in enumerate(posts if feed is None else []):
            for _ in range(ticks_before.count(index)):
                tick(box, ledger)
            box.post(*post)
        for _ in range(6):
            tick(box, ledger)
        return seen

    first = record(None)
    assert [(one.channel, one.payload) for one in first] == posts
    assert [one.tick for one in first] == [sum(at <= index for at in ticks_before) for index in range(len(posts))]
    assert record(first) == first


def test_fed_inputs_come_before_posted_ones_and_at_their_ticks_alone() -> None:
    box, _, ledger = mailbox()
    seen: list[Input] = []
    box.listen(seen.append)
    box.feed([Input(1, "a", b"1"), Input(1, "b", b"2")])
    box.feed([Input(3, "a", b"4")])
    tick(box, ledger)
    assert not seen
    box.post("a", b"3")
    for _ in range(4):
        tick(box, ledger)
    assert [(one.tick, one.payload) for one in seen] == [(1, b"1"), (1, b"2"), (1, b"3"), (3, b"4")]


@pytest.mark.parametrize(
    ("inputs", "error", "said"),
    [
        ([Input(7, "c", b"")], KeyError, "input at tick 7: no channel 'c'; this run has"),
        ([Input(7, "a", b""), Input(6, "a", b"")], ValueError, "must be at tick 7 or later"),
        ([Input(4, "a", b"")], ValueError, "must be at tick 5 or later"),
    ],
)
def test_a_recording_that_does_not_fit_is_refused_whole(inputs: list[Input], error: type[Exception], said: str) -> None:
    box, _, ledger = mailbox()
    ledger.tick = 5
    seen: list[Input] = []
    box.listen(seen.append)
    with pytest.raises(error, match=said):
        box.feed(inputs)
    for _ in range(5):
        tick(box, ledger)
    assert not seen


def test_many_threads_post_and_nothing_is_lost_torn_or_out_of_order() -> None:
    run = bare()
    seen: dict[int, list[int]] = {writer: [] for writer in range(4)}
    run.mailbox.register("part", lambda payload: seen[payload[0]].append(int.from_bytes(payload[1:], "little")))
    count = 2000

    def writer(number: int) -> Callable[[], None]:
        def work() -> None:
            for index in range(count):
                run.mailbox.post("part", bytes([number]) + index.to_bytes(4, "little"))

        return work

    threads = in_threads(*(writer(number) for number in range(4)))
    while any(thread.is_alive() for thread in threads):
        run.step()
    run.step()
    assert seen == {number: list(range(count)) for number in range(4)}


def test_a_thread_that_waits_reads_what_it_wrote() -> None:
    run = bare()
    area = run.areas.add("setpoint", 4, outside=True)
    wrong: list[object] = []
    done = threading.Event()

    def client() -> None:
        for index in range(200):
            applied = area.post(index.to_bytes(4, "little")).wait()
            published, data = area.read_with_tick()
            if published < applied or data != index.to_bytes(4, "little"):
                wrong.append((index, applied, published, data))
        done.set()

    in_threads(client)
    for _ in range(10_000_000):
        run.step()
        if done.is_set():
            break
    assert done.is_set()
    assert not wrong


def test_a_handler_that_raises_is_the_business_of_the_poster_and_a_warning() -> None:
    run = bare()
    applied: list[bytes] = []

    def handler(payload: bytes) -> None:
        if not payload:
            raise ValueError("nothing in it")
        applied.append(payload)

    run.mailbox.register("part", handler)
    bad, good = run.mailbox.post("part"), run.mailbox.post("part", b"x")
    run.step(3)
    with pytest.raises(ValueError, match="nothing in it"):
        bad.wait(0.0)
    assert good.wait(0.0) == 0
    assert applied == [b"x"]
    (event,) = run.events.last(Level.WARNING)
    assert (event.tick, event.level, event.source) == (0, Level.WARNING, "channel part")
    assert "ValueError: nothing in it" in event.text


def test_the_poster_is_told_what_is_wrong_and_the_cycle_is_not() -> None:
    box, events, ledger = mailbox()
    with pytest.raises(KeyError, match="no channel 'A'; this run has a, b"):
        box.post("A")
    with pytest.raises(TypeError, match="channel a: payload must be bytes, not int"):
        box.post("a", 5)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="channel 'a' is registered already"):
        box.register("a", print)
    tick(box, ledger)
    assert not events.last()


def test_a_payload_that_changes_later_was_copied() -> None:
    box, _, ledger = mailbox()
    seen: list[Input] = []
    box.listen(seen.append)
    payload = bytearray(b"before")
    box.post("a", payload)
    payload[:] = b"after!"
    tick(box, ledger)
    assert seen[0].payload == b"before"


def test_a_full_mailbox_refuses_counts_and_takes_again() -> None:
    box, _, ledger = mailbox(capacity=3)
    taken = [box.post("a") for _ in range(3)]
    for _ in range(2):
        with pytest.raises(MailboxFull, match="channel a: 3 inputs wait"):
            box.post("a")
    assert box.refused == 2
    tick(box, ledger)
    assert [receipt.wait(0.0) for receipt in taken] == [0, 0, 0]
    box.post("a")


def test_waiting_for_a_run_that_nobody_steps_ends() -> None:
    box, _, _ = mailbox()
    with pytest.raises(TimeoutError, match=r"channel a: not applied within 0\.01 s; is the run being stepped"):
        box.post("a").wait(0.01)


def test_the_end_of_a_run_releases_everyone_who_waits() -> None:
    box, _, ledger = mailbox()
    applied = box.post("a")
    box.apply(ledger.tick)  # the tick never comes to its outputs
    waiting = box.post("a")
    box.close()
    late = box.post("a")
    for receipt in (applied, waiting, late):
        assert receipt.settled
        with pytest.raises(RuntimeError, match="channel a: the run has ended"):
            receipt.wait(0.0)


def test_closing_beside_a_thread_that_posts_leaves_nobody_waiting() -> None:
    for _ in range(50):
        box, _, _ = mailbox(capacity=10**6)
        receipts: list[Receipt] = []
        started = threading.Event()

        def work(box: Mailbox = box, receipts: list[Receipt] = receipts, started: threading.Event = started) -> None:
            for index in range(300):
                receipts.append(box.post("a"))
                if index == 100:
                    started.set()

        (thread,) = in_threads(work)
        started.wait(60.0)
        box.close()
        thread.join(60.0)
        assert len(receipts) == 300
        assert all(receipt.settled for receipt in receipts)


def test_an_idle_tick_applies_and_acknowledges_too() -> None:
    run = bare()
    seen: list[bytes] = []
    run.mailbox.register("part", seen.append)
    run.step(3)
    receipt = run.mailbox.post("part", b"while paused")
    run.mailbox.apply(run.tick)
    run.mailbox.acknowledge(run.tick)
    assert (seen, receipt.wait(0.0), run.tick) == ([b"while paused"], 3, 3)


def test_waiting_in_a_tick_is_refused_at_once_and_allowed_when_settled() -> None:
    run = bare()
    run.mailbox.register("part", lambda _payload: None)
    said: list[str] = []
    receipts: list[Receipt] = []

    async def program() -> None:
        receipt = run.mailbox.post("part")
        try:
            receipt.wait()
        except RuntimeError as error:
            said.append(str(error))
        await run.until(lambda: receipt.settled)
        receipts.append(receipt)
        assert receipt.wait() == 1

    run.run(program(), time=1.0)
    assert len(receipts) == 1
    (text,) = said
    assert text.startswith(
        "channel part: wait() in a tick would hold up the run that it waits for; in a program `await"
    )


def test_another_thread_waits_while_a_program_runs() -> None:
    run = bare()
    run.mailbox.register("part", lambda _payload: None)
    ticks: list[int] = []
    begun = threading.Event()

    def client() -> None:
        receipt = run.mailbox.post("part")
        begun.set()
        ticks.append(receipt.wait())

    async def program() -> None:
        (thread,) = in_threads(client)
        assert begun.wait(60.0)  # it waits, or will: in this very tick
        await run.sleep(0.01)
        thread.join(60.0)

    run.run(program(), time=1.0)
    assert ticks == [1]


def test_what_is_said_about_inputs_is_of_the_main_program() -> None:
    run = bare()
    run.mailbox.register("part", lambda _payload: b"" * (1 // 0))
    run.mailbox.post("part")
    run.step()
    (event,) = run.events.last(Level.WARNING)
    assert event.device == Device.Device_Main
