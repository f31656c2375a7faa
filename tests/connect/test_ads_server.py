"""The server process with real sockets: who is disconnected, who is not, and what becomes of memory."""

import contextlib
import ipaddress
import pickle
import socket
import struct
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from motionlayer.bench.campaign._ads import conversation
from motionlayer.bench.campaign._ads_victim import Served
from motionlayer.command import Ledger
from motionlayer.connect import ServerFailed
from motionlayer.connect.ads import (
    Access,
    Bridge,
    Contents,
    Hooks,
    Inside,
    Limits,
    Plan,
    Watcher,
    WatchError,
    net_id,
    tree_of,
)
from motionlayer.connect.ads._channel import Channel
from motionlayer.connect.ads._frame import Address, Packet, framed
from motionlayer.connect.ads._memory import Memory
from motionlayer.connect.ads._serve import serve
from motionlayer.connect.ads._wire import Message
from motionlayer.event import EventLog
from motionlayer.runtime import Mailbox

PATIENCE = 10.0
TARGET, SOURCE = Address(net_id("127.0.0.1.1.1"), 851), Address(net_id("127.0.0.1.1.7"), 30_007)


@contextlib.contextmanager
def served(limits: Limits = Limits(), access: Access = Access(), *, own_process: bool = False) -> Iterator[Served]:  # noqa: B008
    made = Served(limits, access, own_process=own_process)
    try:
        yield made
    finally:
        made.close()


def connect(device: Served) -> socket.socket:
    return socket.create_connection(("127.0.0.1", device.bridge.port), PATIENCE)


def request(command: int, data: bytes = b"", number: int = 1) -> bytes:
    return framed(Packet(TARGET, SOURCE, command, 4, 0, number, data).pack())


def answer(stream: socket.socket) -> Packet:
    head = stream.recv(6, socket.MSG_WAITALL)
    packet = Packet.parse(stream.recv(struct.unpack("<HI", head)[1], socket.MSG_WAITALL))
    assert packet is not None
    return packet


def state(stream: socket.socket) -> Packet:
    stream.sendall(request(4))
    return answer(stream)


def ended(stream: socket.socket) -> bool:
    """Tell whether the server ends the connection; waits for that."""
    with contextlib.suppress(ConnectionResetError):
        while stream.recv(65_536):
            pass
    return True


@pytest.mark.parametrize("own_process", [False, True])
def test_a_server_answers_in_a_thread_and_in_a_process(own_process: bool) -> None:
    with served(own_process=own_process) as device, connect(device) as stream:
        assert state(stream).data == struct.pack("<IHH", 0, 5, 0)
        device.symbols.write("GVL.Count", 1, "test")
        stream.sendall(request(3, struct.pack("<3I", 0xF005, 99, 4) + bytes(4)))
        assert answer(stream).data == struct.pack("<I", 0x710)


def test_connections_are_bounded_and_room_comes_back() -> None:
    with served(Limits(connections=2)) as device:
        with connect(device) as one, connect(device) as two:
            assert state(one).error == state(two).error == 0
            with connect(device) as three:
                assert ended(three)
            assert state(one).error == 0
        while True:  # the server needs a moment to notice
            with connect(device) as again, contextlib.suppress(OSError, ValueError, struct.error):
                again.sendall(request(4))
                if answer(again).error == 0:
                    break
    assert any("too many connections" in text for text in device.told)


@pytest.mark.parametrize("said", [b"\0\0", request(4)[:20], b"\0\0\xff\xff\x3f\0" + bytes(50)])
def test_half_open_connections_are_ended(said: bytes) -> None:
    with served(Limits(silence=0.2)) as device, connect(device) as good, connect(device) as silent:
        assert state(good).error == 0
        with connect(device) as bad:
            bad.sendall(said)
            assert ended(bad)
        assert state(silent).error == state(good).error == 0  # both may be quiet


def test_a_frame_without_end_is_refused_at_once() -> None:
    with served() as device, connect(device) as stream:
        stream.sendall(struct.pack("<HI", 0, 0xFFFF_FFFF))
        assert ended(stream)


def test_a_client_that_takes_nothing_is_ended_and_others_are_served() -> None:
    with served(Limits(unsent=100_000)) as device, connect(device) as slow, connect(device) as good:
        slow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        upload = request(2, struct.pack("<3I", 0xF00E, 0, 0xFFFF_FFFF))
        with contextlib.suppress(OSError):
            for _ in range(3000):
                slow.sendall(upload)
        assert state(good).error == 0
        assert ended(slow)
    assert any("takes nothing" in text for text in device.told)


def test_watch_shows_values_as_they_change() -> None:
    with served() as device, Watcher("127.0.0.1", device.bridge.port) as watcher:
        (count,) = watcher.watch("GVL.Count", 0.001)
        colour, flag, *_ = [*watcher.watch("GVL.All.eColour", 0.001), *watcher.watch("GVL.Inners[2]", 0.001)]
        seen: dict[str, Any] = {}
        while len(seen) < 5:
            seen |= {sample.leaf.name: sample.value for sample in watcher.samples(PATIENCE)}
        assert seen == {
            count.name: 0,
            colour.name: "RED",
            flag.name: False,
            "GVL.Inners[2].bOther": False,
            "GVL.Inners[2].rValue": 0.0,
        }
        with connect(device) as stream:
            (place,) = [one for one in device.inside.places if one.symbol.name == "GVL.Count"]
            stream.sendall(request(3, struct.pack("<3Ii", 0x4040, place.start, 4, -9)))
            assert answer(stream).data == bytes(4)
        assert [sample.value for sample in watcher.samples(PATIENCE)] == [-9]
        with pytest.raises(WatchError, match=r"GVL.Nope: symbol not found \(0x710\)"):
            watcher.watch("GVL.Nope", 0.1)


def test_watch_says_where_nobody_is() -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
    with pytest.raises(WatchError, match=f"127.0.0.1:{port}: Connection refused"):
        Watcher("127.0.0.1", port)


def test_an_address_that_is_none_is_one_clear_error() -> None:
    mailbox = Mailbox(Ledger(), EventLog())
    plan = Plan("192.0.2.1", 0, net_id("127.0.0.1.1.1"), 1_000_000, Access((ipaddress.ip_network("192.0.2.0/24"),)))
    hooks = Hooks(lambda _who, _why: None, lambda _write, _reply: None)
    for own_process in (False, True):
        with pytest.raises(ServerFailed, match=r"192\.0\.2\.1:0: Cannot assign"):
            Bridge(plan, mailbox, hooks, own_process=own_process)


def test_a_run_that_ends_answers_what_waits() -> None:
    with served() as device, connect(device) as stream:
        assert state(stream).error == 0
        device.over.set()
        device.thread.join()
        (place,) = [one for one in device.inside.places if one.symbol.name == "GVL.Count"]
        stream.sendall(request(3, struct.pack("<3Ii", 0x4040, place.start, 4, 1)))
        stream.sendall(request(4, number=2))
        assert answer(stream).invoke_id == 2
        device.mailbox.close()
        assert answer(stream).data == struct.pack("<I", 0x707)


def test_requests_that_take_more_than_one_look_are_all_answered() -> None:
    with served() as device, connect(device) as stream:
        assert state(stream).error == 0
        (place,) = [one for one in device.inside.places if one.symbol.name == "GVL.Count"]
        parts, values = struct.pack("<3I", 0x4040, place.start, 4) * 10_000, bytes(40_000)
        data = struct.pack("<4I", 0xF081, 10_000, 40_000, 160_000) + parts + values
        for number in range(5):
            stream.sendall(request(9, data, number))
        for number in range(5):
            packet = answer(stream)
            assert (packet.invoke_id, packet.data) == (number, struct.pack("<II", 0, 40_000) + bytes(40_000))


def resident(pid: int) -> int:
    """Return the resident memory of a process in bytes."""
    return int(Path(f"/proc/{pid}/statm").read_text(encoding="ascii").split()[1]) * 4096


def attack(device: Served, cases: range) -> None:
    """Hold conversations that are damaged."""
    for case in cases:
        with connect(device) as stream, contextlib.suppress(OSError):
            stream.sendall(b"".join(conversation(1, case)))
            stream.shutdown(socket.SHUT_WR)
            ended(stream)


@pytest.mark.slow
def test_damaged_conversations_leave_memory_and_others_as_they_are() -> None:
    with served(Limits(silence=0.5), own_process=True) as device, connect(device) as good:
        pid = device.bridge.pid
        assert pid is not None
        assert state(good).error == 0
        attack(device, range(60))
        before = resident(pid)
        attack(device, range(60, 260))
        assert state(good).error == 0  # it is there still
        assert resident(pid) - before < 4_000_000


def test_a_server_that_is_told_to_end_before_it_has_begun_ends() -> None:
    here, there = socket.socketpair()
    here.settimeout(PATIENCE)
    inside, memory = Inside(list), Memory()
    memory.share(inside.size, 1_000_000)
    plan = Plan("127.0.0.1", 0, net_id("127.0.0.1.1.1"), 1_000_000)
    run = Channel(here)
    run.send(Message.PLAN, pickle.dumps(plan))
    run.send(Message.CONTENTS, pickle.dumps(Contents(tree_of([]), inside.size)))
    run.send(Message.STOP)
    server = threading.Thread(target=serve, args=(there, memory.file), daemon=True)
    server.start()
    assert run.wait(PATIENCE).message == Message.PORT
    server.join(PATIENCE)
    assert not server.is_alive()
    memory.close()
    run.close()
