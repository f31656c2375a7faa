"""What tests of the ADS server have in common: packets by hand, and a run that real clients reach."""

import struct
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Any, Self

import pyads

from motionlayer import Machine, Simulation
from motionlayer.bench.campaign._ads_device import Device, Peer
from motionlayer.connect.ads import net_id
from motionlayer.connect.ads._frame import Address, Packet, framed
from tests.machines import LINEAR

SERVER = Address(net_id("127.0.0.1.1.1"), 851)
READ, WRITE, STATE, CONTROL, ADD, DELETE, READ_WRITE = 2, 3, 4, 5, 6, 7, 9
CYCLIC, ON_CHANGE = 3, 4


class Talk:
    """A client of a `Device` that says what a test tells it."""

    def __init__(self, device: Device, number: int = 2, host: str = "127.0.0.1") -> None:
        self.device = device
        self.peer: Peer = device.connect(host)
        self.source = Address(net_id(f"127.0.0.1.1.{number}"), 30_000 + number)
        self._invoke = 0

    def frame(self, command: int, data: bytes = b"", target: Address = SERVER, flags: int = 4) -> bytes:
        self._invoke += 1
        return framed(Packet(target, self.source, command, flags, 0, self._invoke, data).pack())

    def ask(self, command: int, data: bytes = b"", target: Address = SERVER) -> Packet:
        """Send a request, let a tick pass if it waits for one, and return the answer."""
        self.peer.connection.receive(self.frame(command, data, target))
        found = self.answers()
        if not found:
            self.device.tick()
            found = self.answers()
        (answer,) = found
        assert answer.invoke_id == self._invoke
        return answer

    def answers(self) -> list[Packet]:
        return [packet for packet in self.peer.packets() if packet.command != 8]

    def result(self, command: int, data: bytes = b"", target: Address = SERVER) -> int:
        """Return the result of a request."""
        answer = self.ask(command, data, target)
        return int(answer.error or struct.unpack_from("<I", answer.data)[0])

    def read(self, group: int, offset: int, length: int) -> bytes:
        answer = self.ask(READ, struct.pack("<3I", group, offset, length))
        code, size = struct.unpack_from("<II", answer.data)
        assert (code, size) == (0, len(answer.data) - 8)
        return answer.data[8:]

    def write(self, group: int, offset: int, data: bytes) -> int:
        return self.result(WRITE, struct.pack("<3I", group, offset, len(data)) + data)

    def read_write(self, group: int, offset: int, length: int, data: bytes) -> tuple[int, bytes]:
        answer = self.ask(READ_WRITE, struct.pack("<4I", group, offset, length, len(data)) + data)
        return struct.unpack_from("<I", answer.data)[0], answer.data[8:]

    def handle(self, name: str) -> int:
        code, data = self.read_write(0xF003, 0, 4, name.encode())
        assert code == 0
        return int.from_bytes(data, "little")

    def order(self, name: str, length: int, mode: int = ON_CHANGE, *, cycle: float = 0.0, delay: float = 0.0) -> bytes:
        """Return the data of a notification of a symbol; times in s."""
        return struct.pack("<6I16x", 0xF005, self.handle(name), length, mode, round(delay * 1e7), round(cycle * 1e7))

    def watch(self, name: str, length: int, mode: int = ON_CHANGE, *, cycle: float = 0.0, delay: float = 0.0) -> int:
        answer = self.ask(ADD, self.order(name, length, mode, cycle=cycle, delay=delay))
        code, handle = struct.unpack("<II", answer.data)
        assert code == 0
        return int(handle)

    def samples(self) -> list[tuple[int, int, bytes]]:
        """Return stamp, handle and value of all samples that have come."""
        return [sample for packet in self.peer.packets() if packet.command == 8 for sample in samples(packet.data)]


def samples(data: bytes) -> Iterator[tuple[int, int, bytes]]:
    length, stamps = struct.unpack_from("<II", data)
    assert length == len(data) - 4
    at = 8
    for _ in range(stamps):
        stamp, count = struct.unpack_from("<QI", data, at)
        at += 12
        for _ in range(count):
            handle, size = struct.unpack_from("<II", data, at)
            yield stamp, handle, data[at + 8 : at + 8 + size]
            at += 8 + size
    assert at == len(data)


def machine(**changes: Any) -> Machine:
    """Return a machine with a motion layer and an ADS server on a free port."""
    description = {"format": 1, "name": "m", "axis": dict.fromkeys("XYZ", LINEAR), "layer": {}, "ads": {"port": 0}}
    return Machine.from_dict({**description, **changes})


class Paced:
    """A run that goes on, a tick a millisecond or so, while a test talks to it."""

    def __init__(self, run: Simulation) -> None:
        self.run = run
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._cycle)
        self.error: BaseException | None = None

    def _cycle(self) -> None:
        try:
            while not self._over.wait(0.0005):
                self.run.advance(0.001)
        except BaseException as error:  # noqa: BLE001 - shown where the test ends
            self.error = error

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        self.run.resume()
        self._thread.join()
        if self.error is not None:
            raise self.error


@contextmanager
def connected(port: int, ads_port: int = 851) -> Iterator[pyads.Connection]:
    """Connect pyads; it is patient, since what is asked for may be compiled first."""
    connection = pyads.Connection("127.0.0.1.1.1", ads_port, f"127.0.0.1:{port}")
    connection.open()
    connection.set_timeout(60_000)
    try:
        yield connection
    finally:
        connection.close()
