"""A source: the cycle fetches from it, applies in the same tick, and tells it the outcomes at the end."""

import pytest

from motionlayer.command import Ledger
from motionlayer.event import EventLog, Input
from motionlayer.runtime import Mailbox, Receipt
from motionlayer.runtime._gate import Gate


class Clerk:
    """A source with a list of payloads for each tick."""

    def __init__(self, mailbox: Mailbox, payloads: list[list[bytes]]) -> None:
        self.mailbox = mailbox
        self.payloads = payloads
        self.receipts: list[Receipt] = []
        self.told: list[bytes | None] = []

    def fetch(self) -> None:
        come = self.payloads.pop(0) if self.payloads else []
        self.receipts = [self.mailbox.post("c", payload) for payload in come]

    def tell(self) -> None:
        assert all(one.settled for one in self.receipts)
        self.told += [one.result for one in self.receipts]
        self.receipts = []

    def sleep(self, seconds: float) -> None:
        raise AssertionError(seconds)

    def stir(self) -> None:
        raise AssertionError


def made(payloads: list[list[bytes]]) -> tuple[Mailbox, Ledger, Clerk, list[Input]]:
    ledger = Ledger()
    mailbox = Mailbox(ledger, EventLog())
    mailbox.register("c", lambda payload: payload.upper())
    inputs: list[Input] = []
    mailbox.listen(inputs.append)
    clerk = Clerk(mailbox, payloads)
    mailbox.attach(clerk)
    return mailbox, ledger, clerk, inputs


def test_what_is_fetched_is_applied_recorded_and_told_in_the_same_tick() -> None:
    mailbox, ledger, clerk, inputs = made([[b"a", b"b"], [], [b"c"]])
    mailbox.post("c", b"posted before")
    for tick in range(3):
        ledger.tick = tick
        mailbox.apply(tick)
        mailbox.acknowledge(tick)
    assert inputs == [
        Input(0, "c", b"posted before"),
        Input(0, "c", b"a"),
        Input(0, "c", b"b"),
        Input(2, "c", b"c"),
    ]
    assert clerk.told == [b"A", b"B", b"C"]


def test_what_a_run_has_not_done_at_its_end_is_told_as_an_error() -> None:
    mailbox, _, clerk, inputs = made([[b"late"]])
    receipts: list[Receipt] = []
    tell = clerk.tell
    clerk.tell = lambda: (receipts.extend(clerk.receipts), tell())[-1]  # type: ignore[method-assign,func-returns-value]
    mailbox.close()
    assert inputs == []
    (receipt,) = receipts
    with pytest.raises(RuntimeError, match="the run has ended"):
        receipt.wait(0.0)


def test_who_waits_at_a_gate_is_woken_when_it_opens() -> None:
    gate = Gate()
    gate.close()
    assert not gate.wait()
    gate.open(1)
    gate.sleeper.sleep(3600.0)  # returns at once, or the test is ended by its timeout
    assert gate.wait()
    assert gate.take(3) == 1
    assert gate.closed
