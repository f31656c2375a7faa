"""The server itself: an event loop in a process or thread that shares an image and a pipe with the run, no more."""

import asyncio
import contextlib
import mmap
import os
import pickle
import socket
import sys
import time
from multiprocessing.connection import Connection as Pipe
from typing import Final

from motionlayer.connect.ads._image import SharedImage
from motionlayer.connect.ads._notify import Notifications
from motionlayer.connect.ads._outbox import PipeOutbox, Teller
from motionlayer.connect.ads._plan import Contents, Plan
from motionlayer.connect.ads._ports import services
from motionlayer.connect.ads._router import Router
from motionlayer.connect.ads._stream import Stream
from motionlayer.connect.ads._wire import Message, head
from motionlayer.runtime import Published

LOOK: Final = 0.001
"""Seconds between two looks at the image while there are notifications, at least."""

REST: Final = 0.05
"""Seconds between two looks while there are none."""

BACKLOG: Final = 64
"""Connections that wait until all symbols are known."""


class Server:
    """A server in its own event loop.

    Args:
        plan: whom it serves.
        contents: what it serves.
        pipe: to the run.
        published: the image.
    """

    def __init__(self, plan: Plan, contents: Contents, pipe: Pipe, published: Published) -> None:
        self._pipe = pipe
        self._image = SharedImage(published)
        self._outbox = PipeOutbox(pipe)
        self._notifications = Notifications(plan.cycle_ns, plan.limits.all_notifications)
        self._period = max(LOOK, plan.cycle_ns * 1e-9)
        self._seen = -1
        self._router = Router(
            plan.net_id,
            services(contents, self._image),
            self._outbox,
            self._notifications,
            Teller(pipe, time.monotonic),
            plan.access,
            plan.limits,
        )
        self._streams: set[Stream] = set()
        self._mqtt = plan.mqtt

    async def run(self, listening: socket.socket) -> None:
        """Serve until the run says stop."""
        loop = asyncio.get_running_loop()
        stop = loop.create_future()
        server = await loop.create_server(lambda: Stream(self._router, self._streams), sock=listening)
        loop.add_reader(self._pipe.fileno(), self._heard, stop)
        self._look()
        async with server, self._network():
            await stop
        loop.remove_reader(self._pipe.fileno())
        for stream in tuple(self._streams):
            stream.close()

    def _network(self) -> contextlib.AbstractAsyncContextManager[None]:
        """Return what makes the server a member of its MQTT network, if it has one."""
        if self._mqtt is None:
            return contextlib.nullcontext()
        from motionlayer.connect.ads._mqtt import joined  # noqa: PLC0415 - a tenth of a second for whoever needs it

        return joined(self._mqtt, self._router)

    def _look(self) -> None:
        """Send what is due, and look again a little later."""
        notifications, image = self._notifications, self._image
        asyncio.get_running_loop().call_later(self._period if len(notifications) else REST, self._look)
        if not len(notifications):
            return
        count = image.count
        if (count != self._seen or notifications.beginning) and notifications.due(image.tick):
            self._seen = count
            notifications.look(*image.snapshot())

    def _heard(self, stop: "asyncio.Future[None]") -> None:
        """Take what the run says."""
        with contextlib.suppress(EOFError, OSError):  # the run is gone
            while self._pipe.poll():
                message = self._pipe.recv_bytes()
                if message[0] == Message.STOP:
                    break
                self._outbox.settle(message)
            else:
                return
        if not stop.done():
            stop.set_result(None)


def listen(host: str, port: int) -> socket.socket:
    """Return a socket that takes connections.

    Raises:
        OSError: there is no such address, or somebody else has it.
    """
    family, kind, protocol, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
    listening = socket.socket(family, kind, protocol)
    try:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.bind(address)
        listening.listen(BACKLOG)
    except OSError:
        listening.close()
        raise
    return listening


def serve(pipe: Pipe, memory: int) -> None:
    """Serve until the pipe says stop; the main function of a server process or thread.

    Args:
        pipe: to the run, which says what to serve.
        memory: file descriptor of the shared memory.
    """
    plan: Plan = pickle.loads(pipe.recv_bytes()[1:])  # noqa: S301 - it comes from the run that has started us
    try:
        listening = listen(plan.host, plan.port)
    except OSError as error:
        pipe.send_bytes(head(Message.PORT) + f"{plan.host}:{plan.port}: {error.strerror}".encode())
        return
    with listening, contextlib.suppress(EOFError, ConnectionError):  # the run has ended before it began
        pipe.send_bytes(head(Message.PORT) + str(listening.getsockname()[1]).encode())
        message = pipe.recv_bytes()
        if message[0] == Message.CONTENTS:
            contents: Contents = pickle.loads(message[1:])  # noqa: S301
            _serve(plan, contents, pipe, memory, listening)


def _serve(plan: Plan, contents: Contents, pipe: Pipe, memory: int, listening: socket.socket) -> None:
    with mmap.mmap(memory, contents.size) as block:
        published = Published(memoryview(block), new=False)
        try:
            asyncio.run(Server(plan, contents, pipe, published).run(listening))
        finally:
            published.release()


def main() -> None:
    """Serve in a process of its own; its arguments are the file descriptors of pipe and memory."""
    pipe, memory = (int(argument) for argument in sys.argv[1:3])
    with Pipe(pipe) as connected:
        serve(connected, memory)
    os.close(memory)
