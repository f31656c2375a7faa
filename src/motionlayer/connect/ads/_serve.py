"""The server itself: an event loop in a process or thread that shares an image and a socket with the run, no more."""

import asyncio
import contextlib
import mmap
import os
import pickle
import socket
import sys
import time
from typing import Final

import uvloop

from motionlayer.connect.ads._awake import Awake
from motionlayer.connect.ads._channel import Channel, Received
from motionlayer.connect.ads._image import SharedImage
from motionlayer.connect.ads._memory import Shared
from motionlayer.connect.ads._notify import Notifications
from motionlayer.connect.ads._outbox import ChannelOutbox, Teller
from motionlayer.connect.ads._plan import Contents, Plan
from motionlayer.connect.ads._ports import services
from motionlayer.connect.ads._router import Router
from motionlayer.connect.ads._stream import Stream
from motionlayer.connect.ads._watches import Lookout, Watches
from motionlayer.connect.ads._wire import Message

LOOK: Final = 0.001
"""Seconds between two looks at the image while there are notifications, at least."""

REST: Final = 0.05
"""Seconds between two looks while there are none."""

BACKLOG: Final = 64
"""Connections that wait until all symbols are known."""

PROMPT: Final = 0.0005
"""Seconds that the server waits for the answer of a run that is awake; more than it takes."""

PATIENCE: Final = 3600.0
"""Seconds between two looks whether the run is there still, while it has not begun."""


class Server:
    """A server in its own event loop.

    Args:
        plan: whom it serves.
        contents: what it serves.
        channel: to the run.
        shared: the image.
    """

    def __init__(self, plan: Plan, contents: Contents, channel: Channel, shared: Shared) -> None:
        self._channel = channel
        channel.on_send = shared.ring
        self._awake = Awake(len(os.sched_getaffinity(0)))
        self._image = SharedImage(shared.published)
        self._outbox = ChannelOutbox(channel, lambda: shared.awake, self._posted)
        watches = Watches(shared.history, self._image.size)
        self._notifications = Notifications(plan.cycle_ns, plan.limits.all_notifications, watches)
        self._period = max(LOOK, plan.cycle_ns * 1e-9)
        tell = Teller(channel, time.monotonic)
        self._lookout = Lookout(self._image, shared.history, self._notifications, tell)
        self._router = Router(
            plan.net_id,
            services(contents, self._image),
            self._image,
            self._outbox,
            self._notifications,
            tell,
            plan.access,
            plan.limits,
        )
        self._streams: set[Stream] = set()
        self._mqtt = plan.mqtt

    async def run(self, listening: socket.socket) -> None:
        """Serve until the run says stop."""
        loop = asyncio.get_running_loop()
        self._stop = loop.create_future()
        self._loop = loop
        server = await loop.create_server(lambda: Stream(self._router, self._streams), sock=listening)
        loop.add_reader(self._channel.fileno(), self._heard)
        self._heard()  # it may have come with what told this server to begin
        self._look()
        async with server, self._network():
            await self._stop
        loop.remove_reader(self._channel.fileno())
        loop.remove_writer(self._channel.fileno())
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
        self._loop.call_later(self._period if len(self._notifications) else REST, self._look)
        self._lookout.look()

    def _posted(self, awake: bool) -> None:
        """Take the answer of a run that is awake; care for what the run has not taken yet."""
        if awake:
            self._awake.until(self._answered, time.perf_counter() + PROMPT)
        if self._channel.unsent:
            self._loop.add_writer(self._channel.fileno(), self._flush)

    def _answered(self) -> bool:
        self._heard()
        return not self._outbox

    def _flush(self) -> None:
        self._channel.flush()
        if not self._channel.unsent:
            self._loop.remove_writer(self._channel.fileno())

    def _heard(self) -> None:
        """Take what the run says."""
        try:
            for message, number, data in self._channel.receive():
                if message == Message.OUTCOMES:
                    self._outbox.settle(number, data)
                elif message == Message.STOP:
                    self._end()
        except EOFError:  # the run is gone
            self._end()

    def _end(self) -> None:
        if not self._stop.done():
            self._stop.set_result(None)


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


def serve(end: socket.socket, memory: int) -> None:
    """Serve until the run says stop; the main function of a server process or thread.

    Args:
        end: of the channel to the run, which says what to serve.
        memory: file descriptor of the shared memory.
    """
    channel = Channel(end)
    with contextlib.closing(channel), contextlib.suppress(EOFError):  # the run may end before it has begun
        plan: Plan = pickle.loads(_told(channel).data)  # noqa: S301 - it comes from the run that has started us
        try:
            listening = listen(plan.host, plan.port)
        except OSError as error:
            channel.send(Message.PORT, f"{plan.host}:{plan.port}: {error.strerror}".encode())
            return
        with listening:
            channel.send(Message.PORT, str(listening.getsockname()[1]).encode())
            message = _told(channel)
            if message.message == Message.CONTENTS:
                contents: Contents = pickle.loads(message.data)  # noqa: S301
                _serve(plan, contents, channel, memory, listening)


def _told(channel: Channel) -> Received:
    """Return the next message of the run, which may take any time."""
    while True:
        with contextlib.suppress(TimeoutError):
            return channel.wait(PATIENCE)


def _serve(plan: Plan, contents: Contents, channel: Channel, memory: int, listening: socket.socket) -> None:
    with mmap.mmap(memory, Shared.size_of(contents.size, plan.cycle_ns)) as block:
        shared = Shared(memoryview(block), contents.size, plan.cycle_ns, new=False)
        try:
            with asyncio.Runner(loop_factory=uvloop.new_event_loop) as runner:
                runner.run(Server(plan, contents, channel, shared).run(listening))
        finally:
            shared.release()


def main() -> None:
    """Serve in a process of its own; its arguments are the file descriptors of channel and memory."""
    channel, memory = (int(argument) for argument in sys.argv[1:3])
    serve(socket.socket(fileno=channel), memory)
    os.close(memory)
