"""`Bridge`: the side of the run. It starts the server, hands requests to the mailbox, and outcomes back.

Two threads, which sleep unless a client writes: one takes requests out of the pipe and posts them, one waits for the
receipts in order and sends the outcomes. The cycle itself copies the image and applies what was posted; it never waits
for a server.
"""

import contextlib
import mmap
import os
import pickle
import queue
import socket
import subprocess
import sys
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection as Pipe
from typing import Final, NamedTuple

from motionlayer.connect.ads._codes import Code
from motionlayer.connect.ads._plan import Contents, Plan
from motionlayer.connect.ads._serve import serve
from motionlayer.connect.ads._service import Outcome, Write
from motionlayer.connect.ads._wire import NUMBER, Message, head, pack_outcomes, unpack_request
from motionlayer.runtime import Mailbox, MailboxFull, Published, Receipt

CHANNEL: Final = "ads"
"""The channel of requests."""

START_TIME: Final = 30.0
"""Wall time in seconds that a server may take to begin, or to end."""


class ServerFailed(RuntimeError):  # noqa: N818 - the state, as a user would say it
    """The server could not begin: its address is taken, or does not exist."""


class Memory:
    """The image of a run, in memory that a server shares; it has no name, and is gone with the last who uses it."""

    def __init__(self) -> None:
        self.file = os.memfd_create("motionlayer ads")
        """File descriptor, which the server is given."""
        self._block: mmap.mmap | None = None
        self._published: Published | None = None

    def publish(self, size: int) -> Published:
        """Return a double buffer of so many bytes; called once."""
        whole = Published.size_of(size)
        os.ftruncate(self.file, whole)
        self._block = mmap.mmap(self.file, whole)
        self._published = Published(memoryview(self._block))
        return self._published

    @property
    def size(self) -> int:
        """Bytes of all of it."""
        return len(self._block) if self._block is not None else 0

    def close(self) -> None:
        """Give the memory back."""
        if self._published is not None:
            self._published.release()
        if self._block is not None:
            self._block.close()
        os.close(self.file)


class Hooks(NamedTuple):
    """What a server needs of the run beside the mailbox; called in threads of the bridge.

    Attributes:
        tell: takes who was refused, and why.
        control: takes the state that a client asks for, and what it answers with once that is done.
    """

    tell: Callable[[str, str], None]
    control: Callable[[Write, Callable[[Outcome], None]], None]


class _Posted(NamedTuple):
    """What waits for the run."""

    number: int
    writes: int
    receipt: Receipt


class _Answer(NamedTuple):
    """What is known already."""

    number: int
    outcomes: list[Outcome]


class Bridge:
    """A server for a run.

    Args:
        plan: whom it serves.
        mailbox: of the run, with the channel "ads".
        hooks: what else it needs of the run.
        own_process: the server runs in a process of its own, else in a thread.

    Attributes:
        port: TCP port that it listens on.

    Raises:
        ServerFailed: it cannot begin.
    """

    def __init__(self, plan: Plan, mailbox: Mailbox, hooks: Hooks, *, own_process: bool) -> None:
        self.memory = Memory()
        self._mailbox = mailbox
        self._hooks = hooks
        self._answers: queue.SimpleQueue[_Posted | _Answer | None] = queue.SimpleQueue()
        self._sending = threading.Lock()
        here, there = socket.socketpair()
        self._pipe = Pipe(here.detach())
        self._threads: list[threading.Thread] = []
        self._process = _process(there, self.memory.file) if own_process else None
        if self._process is None:
            self._start("server", lambda: _in_thread(there, self.memory.file))
        self._pipe.send_bytes(head(Message.PLAN) + pickle.dumps(plan))
        try:
            self.port = self._port(plan)
        except ServerFailed:
            self.close()
            raise

    @property
    def pid(self) -> int | None:
        """Number of the server's process; None where it runs in a thread."""
        return None if self._process is None else self._process.pid

    def begin(self, contents: Contents) -> None:
        """Let the server serve; the image has been published."""
        self._send(head(Message.CONTENTS) + pickle.dumps(contents))
        self._start("requests", self._take)
        self._start("outcomes", self._give)

    def close(self) -> None:
        """Stop the server; its clients are disconnected."""
        self._send(head(Message.STOP))
        if self._process is not None:
            try:
                self._process.wait(START_TIME)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        for thread in self._threads:
            thread.join(START_TIME)
        self._pipe.close()
        self.memory.close()

    def _start(self, name: str, work: Callable[[], None]) -> None:
        thread = threading.Thread(target=work, name=f"ads {name}", daemon=True)
        self._threads.append(thread)
        thread.start()

    def _port(self, plan: Plan) -> int:
        answer = b""
        with contextlib.suppress(EOFError, ConnectionError):
            if self._pipe.poll(START_TIME):
                answer = self._pipe.recv_bytes()[1:]
        if not answer.isdigit():
            why = answer.decode() or f"{plan.host}:{plan.port}: the server does not begin"
            raise ServerFailed(
                f"ADS server at {why}; end the other program or run that has this address, or give another: "
                '[ads] port or --ads :PORT, 0 for any, and host = "127.0.0.1" for this computer alone'
            )
        return int(answer)

    def _take(self) -> None:
        """Hand on what the server says, until it is gone."""
        with contextlib.suppress(EOFError, OSError):
            while True:
                self._heard(self._pipe.recv_bytes())
        self._answers.put(None)

    def _heard(self, message: bytes) -> None:
        """Hand a message on. This thread sends nothing: the server may wait for it before it reads again."""
        if message[0] == Message.TOLD:
            who, _, why = message[1:].decode(errors="replace").partition("\0")
            self._hooks.tell(who, why)
            return
        _, number = NUMBER.unpack_from(message)
        payload = message[NUMBER.size :]
        writes = unpack_request(payload)[1]
        if message[0] == Message.CONTROL:
            self._hooks.control(writes[0], lambda outcome: self._answers.put(_Answer(number, [outcome])))
            return
        try:
            self._answers.put(_Posted(number, len(writes), self._mailbox.post(CHANNEL, payload)))
        except MailboxFull:
            self._answers.put(_Answer(number, [Outcome(Code.MAILBOX_FULL)] * len(writes)))

    def _give(self) -> None:
        """Send what has become of the requests, in their order."""
        while (answer := self._answers.get()) is not None:
            outcomes = pack_outcomes(answer.outcomes) if isinstance(answer, _Answer) else _awaited(answer)
            self._send(NUMBER.pack(Message.OUTCOMES, answer.number) + outcomes)

    def _send(self, message: bytes) -> None:
        with self._sending, contextlib.suppress(OSError):  # the server is gone, and nobody waits for the answer
            self._pipe.send_bytes(message)


def _awaited(posted: _Posted) -> bytes:
    """Wait for the tick that does what was posted; return the outcomes."""
    try:
        posted.receipt.wait(threading.TIMEOUT_MAX)
    except Exception as error:  # noqa: BLE001 - whatever the handler has raised, the client gets an answer
        code = Code.NOT_READY if isinstance(error, RuntimeError) else Code.DEVICE_ERROR
        return pack_outcomes([Outcome(code)] * posted.writes)
    return posted.receipt.result


def _process(there: socket.socket, memory: int) -> subprocess.Popen[bytes]:
    """Start a server process.

    It is no child of `multiprocessing`, which would run the script of the user once more to find it; and in a session
    of its own, so that Ctrl-C ends the run, and the run its server.
    """
    code = "from motionlayer.connect.ads._serve import main; main()"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    with there:
        files = there.fileno(), memory
        return subprocess.Popen(  # noqa: S603 - this interpreter, constant arguments
            [sys.executable, "-c", code, *map(str, files)],
            pass_fds=files,
            stdin=subprocess.DEVNULL,
            env=environment,
            start_new_session=True,
        )


def _in_thread(there: socket.socket, memory: int) -> None:
    with Pipe(there.detach()) as pipe:
        serve(pipe, memory)
