"""`Bridge`: the side of the run. It starts the server, hands requests to the mailbox, and outcomes back.

It has no thread: the cycle fetches requests at the beginning of a tick, and tells all outcomes of a tick in one piece
at its end. So a request that is there when a tick begins is answered when that tick ends, whatever else the computer
does; and a tick without requests costs one look at a counter.
"""

import contextlib
import os
import pickle
import select
import socket
import time
from collections.abc import Callable
from typing import Final, NamedTuple

from motionlayer.connect import ADS, ServerFailed
from motionlayer.connect.ads._awake import Awake
from motionlayer.connect.ads._channel import Channel, Received
from motionlayer.connect.ads._codes import Code
from motionlayer.connect.ads._launch import Launched, ServerProcess, ServerThread
from motionlayer.connect.ads._memory import Memory, Shared
from motionlayer.connect.ads._plan import Contents, Plan
from motionlayer.connect.ads._service import Outcome, Write
from motionlayer.connect.ads._wire import Message, pack_outcomes, unpack_request
from motionlayer.runtime import Mailbox, MailboxFull, Receipt

START_TIME: Final = 30.0
"""Wall time in seconds that a server may take to begin, or to end."""

AWAKE: Final = 0.002
"""Seconds that a run which is held up stays awake after an answer: who has asked will ask again, and to fall asleep and
to wake up takes longer than to answer."""


class Hooks(NamedTuple):
    """What a server needs of the run beside the mailbox; called by the thread of the cycle.

    Attributes:
        tell: takes who was refused, and why.
        control: takes the state that a client asks for, and what it answers with once that is done.
    """

    tell: Callable[[str, str], None]
    control: Callable[[Write, Callable[[Outcome], None]], None]


class _Posted(NamedTuple):
    """What waits for the end of a tick."""

    number: int
    request: bytes
    receipt: Receipt


class Bridge:
    """A server for a run, and a `Source` of its mailbox.

    Args:
        plan: whom it serves.
        mailbox: of the run, with the channel `ADS`.
        hooks: what else it needs of the run.
        own_process: the server runs in a process of its own, else in a thread.

    Attributes:
        port: TCP port that it listens on.

    Raises:
        ServerFailed: it cannot begin.
    """

    def __init__(self, plan: Plan, mailbox: Mailbox, hooks: Hooks, *, own_process: bool) -> None:
        self._memory = Memory()
        self._mailbox = mailbox
        self._hooks = hooks
        self._posted: list[_Posted] = []
        self._shared: Shared | None = None
        self._rings = 0
        # A server in a thread of this process could not work while this one looks.
        self._awake = Awake(len(os.sched_getaffinity(0)) if own_process else 1)
        self._awake_until = 0.0
        here, there = socket.socketpair()
        self._channel = Channel(here)
        self._bell, self._rope = socket.socketpair()
        self._bell.setblocking(False)
        self._rope.setblocking(False)
        self._poll = select.poll()
        self._poll.register(self._channel, select.POLLIN)
        self._poll.register(self._bell, select.POLLIN)
        self._server: Launched = (ServerProcess if own_process else ServerThread)(there, self._memory.file)
        self._channel.send(Message.PLAN, pickle.dumps(plan))
        try:
            self.port = self._port(plan)
        except ServerFailed:
            self.close()
            raise

    @property
    def pid(self) -> int | None:
        """Number of the server's process; None where it runs in a thread."""
        return self._server.pid

    def share(self, size: int, cycle_ns: int) -> Shared:
        """Return room for an image of so many bytes, which the server will see; called once."""
        self._shared = self._memory.share(size, cycle_ns)
        return self._shared

    def begin(self, contents: Contents) -> None:
        """Let the server serve; the image has been published."""
        self._channel.send(Message.CONTENTS, pickle.dumps(contents))
        self._channel.drain(START_TIME)

    def fetch(self) -> None:
        """Post what clients have asked for since the last tick."""
        channel, shared = self._channel, self._shared
        if channel.unsent:
            channel.flush()
        if shared is None or shared.rings == self._rings:
            return
        self._rings = shared.rings  # asked before the look: what comes later rings again
        try:
            for message in channel.receive():
                self._heard(message)
            if channel.more:
                self._rings = -1
        except EOFError:  # the server is gone
            with contextlib.suppress(KeyError, ValueError):
                self._poll.unregister(channel)

    def tell(self) -> None:
        """Tell the outcomes of this tick."""
        posted, self._posted = self._posted, []
        if posted:
            self._channel.send_all(Message.OUTCOMES, [(one.number, _outcomes(one)) for one in posted])
            self._awake_until = time.perf_counter() + AWAKE

    def sleep(self, seconds: float) -> None:
        """Return after a time, or as soon as a client asks for something or somebody stirs."""
        if self._stirred_awake() or self._poll.poll(seconds * 1e3):
            self._rings = -1  # it may ring a moment later only
            with contextlib.suppress(BlockingIOError):
                self._bell.recv(64)

    def _stirred_awake(self) -> bool:
        """Look for a short time after an answer, without sleeping; tell whether something has come."""
        shared = self._shared
        if shared is None or time.perf_counter() >= self._awake_until:
            return False
        shared.awake = True
        try:
            return self._awake.until(lambda: self._poll.poll(0.0), self._awake_until)
        finally:
            shared.awake = False

    def stir(self) -> None:
        """Let the run look at once; for any thread."""
        with contextlib.suppress(OSError):  # it rings already, or there is nobody any more
            self._rope.send(b"\0")

    def close(self) -> None:
        """Stop the server; its clients are disconnected."""
        self._channel.send(Message.STOP)
        self._channel.drain(START_TIME)
        self._server.wait(START_TIME)
        for end in (self._channel, self._bell, self._rope):
            end.close()
        self._memory.close()

    def _port(self, plan: Plan) -> int:
        answer = b""
        with contextlib.suppress(EOFError, TimeoutError):
            answer = self._channel.wait(START_TIME).data
        if not answer.isdigit():
            why = answer.decode() or f"{plan.host}:{plan.port}: the server does not begin"
            raise ServerFailed(
                f"ADS server at {why}; end the other program or run that has this address, or give another: "
                '[ads] port or --ads :PORT, 0 for any, and host = "127.0.0.1" for this computer alone'
            )
        return int(answer)

    def _heard(self, message: Received) -> None:
        """Take a message of the server."""
        _, number, data = message
        if message.message == Message.TOLD:
            who, _, why = data.decode(errors="replace").partition("\0")
            self._hooks.tell(who, why)
            return
        if message.message == Message.CONTROL:
            (write,) = unpack_request(data)[1]
            self._hooks.control(write, lambda outcome: self._answer(number, [outcome]))
            return
        try:
            self._posted.append(_Posted(number, data, self._mailbox.post(ADS, data)))
        except MailboxFull:
            self._answer(number, _refused(data, Code.MAILBOX_FULL))

    def _answer(self, number: int, outcomes: list[Outcome]) -> None:
        self._channel.send(Message.OUTCOMES, pack_outcomes(outcomes), number)


def _outcomes(posted: _Posted) -> bytes:
    """Return what has become of a request whose tick has ended."""
    receipt = posted.receipt
    try:
        receipt.wait(0.0)
    except Exception as error:  # noqa: BLE001 - whatever the handler has raised, the client gets an answer
        code = Code.NOT_READY if isinstance(error, RuntimeError) else Code.DEVICE_ERROR
        return pack_outcomes(_refused(posted.request, code))
    return receipt.result


def _refused(request: bytes, code: Code) -> list[Outcome]:
    """Return the outcomes of a request none of whose writes is done."""
    return [Outcome(code)] * len(unpack_request(request)[1])
