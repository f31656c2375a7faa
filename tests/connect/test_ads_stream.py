"""Connections over time: who may be quiet, who is disconnected, and who makes room. The clock of the loop is ours."""

import asyncio
import contextlib
import socket
from collections.abc import AsyncIterator, Awaitable, Callable
from dataclasses import dataclass, field

import pytest

from motionlayer.bench.campaign._ads_device import Device
from motionlayer.connect.ads import Limits, net_id
from motionlayer.connect.ads._frame import Address, Packet, framed
from motionlayer.connect.ads._router import Access
from motionlayer.connect.ads._stream import Stream

SILENCE = 10.0
TARGET, SOURCE = Address(net_id("127.0.0.1.1.1"), 851), Address(net_id("127.0.0.1.1.7"), 30_007)
WHOLE = framed(Packet(TARGET, SOURCE, 4, 4, 0, 1, b"").pack())
HANDLE = framed(Packet(TARGET, SOURCE, 9, 4, 0, 1, b"\3\xf0\0\0" + bytes(4) + b"\4\0\0\0\x09\0\0\0GVL.Count").pack())


class Loop(asyncio.SelectorEventLoop):
    """An event loop whose time goes on when a test says so."""

    now = 0.0

    def time(self) -> float:
        return self.now


Client = tuple[asyncio.StreamReader, asyncio.StreamWriter]


@dataclass
class Server:
    """Streams around a device."""

    device: Device
    loop: Loop
    port: int = 0
    streams: set[Stream] = field(default_factory=set)
    clients: list[asyncio.StreamWriter] = field(default_factory=list)

    async def connect(self, said: bytes = b"") -> Client:
        """Return a client that has said something, and was answered or heard."""
        known = len(self.streams)
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port)
        self.clients.append(writer)
        if said:
            writer.write(said)
            await self.settle(lambda: all(one.silent_since > SILENCE * 1e6 for one in self.streams))
        elif known < self.device.router.limits.connections:
            await self.settle(lambda: len(self.streams) > known)
        return reader, writer

    async def settle(self, done: Callable[[], bool]) -> None:
        """Let the loop work until something is so."""
        while not done():  # noqa: ASYNC110 - the loop has to work for it
            await asyncio.sleep(0)

    async def wait(self, seconds: float) -> None:
        """Let a time pass."""
        self.loop.now += seconds
        for _ in range(5):
            await asyncio.sleep(0)


async def answered(client: Client) -> bool:
    """Tell whether the server answers a client."""
    reader, writer = client
    writer.write(WHOLE)
    return len(await reader.readexactly(6 + 32 + 8)) > 0


async def ended(client: Client) -> bool:
    """Return once the server has ended a connection."""
    with contextlib.suppress(ConnectionResetError):
        while await client[0].read(1024):
            pass
    return True


@contextlib.asynccontextmanager
async def serving(limits: Limits, access: Access) -> AsyncIterator[Server]:
    loop = asyncio.get_running_loop()
    assert isinstance(loop, Loop)
    made = Server(Device(limits, access), loop)
    server = await loop.create_server(lambda: Stream(made.device.router, made.streams), "127.0.0.1", 0)
    made.port = server.sockets[0].getsockname()[1]
    try:
        yield made
    finally:
        server.close()
        for writer in made.clients:
            writer.close()
            with contextlib.suppress(ConnectionError):
                await writer.wait_closed()
        await made.settle(lambda: not made.streams)


def on_server(
    test: Callable[[Server], Awaitable[None]],
    *,
    connections: int = 64,
    access: Access = Access(),  # noqa: B008
) -> Device:
    """Carry out a test in a loop of its own; return the device."""

    async def run() -> Device:
        async with serving(Limits(connections=connections, silence=SILENCE), access) as server:
            await test(server)
            return server.device

    with asyncio.Runner(loop_factory=Loop) as runner:
        return runner.run(run())


def test_whoever_is_quiet_stays_connected_before_its_first_request_and_after() -> None:
    async def test(server: Server) -> None:
        spoken, silent = await server.connect(WHOLE), await server.connect()
        await spoken[0].readexactly(46)
        for _ in range(10):
            await server.wait(1000 * SILENCE)
        assert await answered(silent)
        assert await answered(spoken)

    assert on_server(test).told == []


@pytest.mark.parametrize("before", [b"", WHOLE])
def test_who_leaves_a_frame_half_sent_is_disconnected(before: bytes) -> None:
    async def test(server: Server) -> None:
        client = await server.connect(before + WHOLE[:10])
        for _ in range(3):
            await server.wait(SILENCE)
        assert await ended(client)

    (told,) = on_server(test).told
    assert "sends no complete frame" in told


def test_a_frame_may_take_its_time_also_after_a_pause() -> None:
    async def test(server: Server) -> None:
        reader, writer = await server.connect(WHOLE)
        await reader.readexactly(46)
        (stream,) = server.streams
        for _ in range(3):
            await server.wait(SILENCE)  # time for more than one look
        writer.write(WHOLE[:10])
        connection = stream._connection
        assert connection is not None
        await server.settle(lambda: connection._splitter.pending)
        await server.wait(SILENCE)  # a look, in the middle of the frame
        writer.write(WHOLE[10:])
        assert len(await reader.readexactly(46)) == 46

    assert on_server(test).told == []


def test_who_has_said_nothing_for_longest_makes_room() -> None:
    async def test(server: Server) -> None:
        spoken = await server.connect(WHOLE)
        await spoken[0].readexactly(46)
        oldest = await server.connect()
        await server.wait(SILENCE / 2)
        young = await server.connect()
        assert await ended(await server.connect())  # all may be about to speak yet
        await server.wait(SILENCE / 2)
        assert await answered(await server.connect())
        assert await ended(oldest)
        assert await answered(young)
        assert await answered(spoken)

    told = on_server(test, connections=3).told
    assert [text.partition(": ")[2] for text in told] == [
        "too many connections",
        "has said nothing yet, and makes room for another client",
    ]


def test_nobody_who_has_spoken_makes_room() -> None:
    async def test(server: Server) -> None:
        one, two = await server.connect(WHOLE), await server.connect(WHOLE)
        await server.wait(100 * SILENCE)
        assert await ended(await server.connect())
        for client in (one, two):
            await client[0].readexactly(46)
            assert await answered(client)

    (told,) = on_server(test, connections=2).told
    assert "too many connections" in told


def test_who_dies_releases_what_it_held() -> None:
    async def test(server: Server) -> None:
        client = await server.connect(HANDLE)
        await client[0].readexactly(6 + 32 + 12)
        assert server.device.router.held() == 1
        client[1].transport.abort()  # nothing is left of it, as of a process that was killed
        await server.settle(lambda: not server.streams)
        assert server.device.router.held() == 0

    on_server(test)


def test_a_peer_that_vanishes_is_noticed_after_a_minute_whether_something_is_on_its_way_or_not() -> None:
    async def test(server: Server) -> None:
        await server.connect()
        (stream,) = server.streams
        assert stream._transport is not None
        options = stream._transport.get_extra_info("socket").getsockopt
        assert options(socket.SOL_SOCKET, socket.SO_KEEPALIVE)
        idle, interval, count = (
            options(socket.IPPROTO_TCP, one) for one in (socket.TCP_KEEPIDLE, socket.TCP_KEEPINTVL, socket.TCP_KEEPCNT)
        )
        assert idle + interval * count == 60
        assert options(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT) == 60_000

    on_server(test)
