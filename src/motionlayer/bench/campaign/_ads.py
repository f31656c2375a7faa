"""The campaign `ads`: damaged requests of a client neither stop the device nor disturb another client.

A case is a conversation of `FRAMES` frames. Each is a request as clients send it, to which one of these has happened:

========= ===================================================================
whole     nothing
flip      some bytes are others
cut       it ends too early
stretch   bytes are added, with or without the length that says so
length    a length inside is huge, or none
group     another index group and offset
splice    the head of one and the tail of another
noise     it never was one
========= ===================================================================

Then the stream is cut anywhere. A second client reads, writes and gets notifications beside it all the time; at the end
the damaged one is gone, and the device holds nothing of it.
"""

import struct
from collections.abc import Callable
from typing import Final

import numpy as np

from motionlayer.bench.campaign._ads_device import Device, Peer
from motionlayer.bench.campaign._campaign import Campaign, Failure, judged, stream
from motionlayer.connect.ads import net_id
from motionlayer.connect.ads._frame import Address, FrameError, Packet, framed

FRAMES: Final = 50
STREAM: Final = 7
BATCH: Final = 1

SERVER: Final = net_id("127.0.0.1.1.1")
PORTS: Final = (851, 851, 851, 851, 10_000, 300, 500, 12)
GROUPS: Final = (
    0x4040, 0x4041, 0x4045, 0xF003, 0xF004, 0xF005, 0xF006, 0xF007, 0xF008, 0xF009, 0xF00B, 0xF00C, 0xF00E, 0xF00F,
    0xF011, 0xF080, 0xF081, 0xF082, 0xF083, 0xF084, 0xF085, 0xF086, 0xF100, 0xF0, 0x4101, 0x4201, 0xDEAD,
)  # fmt: skip
NAMES: Final = (
    b"GVL.All", b"gvl.count\0", b"GVL.Inners[2].bOther", b"GVL.All.aGrid[1,2]", b"GVL.Shown[9]", b"GVL.", b"", b"\xff",
    b"ST_EVERYTHING", b"GVL.All.nInt#Call", b"GVL.Inners[", b"GVL.Inners[1][1]", b"A" * 300,
)  # fmt: skip
LENGTHS: Final = (0, 1, 4, 8, 24, 64, 4096, 0x7FFF_FFFF, 0xFFFF_FFFF)

Bytes = Callable[[np.random.Generator, bytes], bytes]


def request(rng: np.random.Generator) -> bytes:
    """Return a frame as a client sends it."""
    if rng.random() < 0.05:
        return framed(_noise(rng, 8), int(rng.choice([1, 0x1000, 0x1001, 0x1002])))
    command = int(rng.integers(0, 11))
    source = Address(net_id(f"127.0.0.1.1.{rng.integers(2, 5)}"), int(rng.integers(30_000, 30_003)))
    target = Address(SERVER if rng.random() < 0.95 else bytes(6), int(rng.choice(PORTS)))
    flags = 4 if rng.random() < 0.95 else int(rng.integers(0, 0x10000))
    return framed(Packet(target, source, command, flags, 0, int(rng.integers(2**32)), _data(rng, command)).pack())


def _data(rng: np.random.Generator, command: int) -> bytes:
    """Return what a command takes."""
    group, offset, length = int(rng.choice(GROUPS)), int(rng.integers(0, 40)), int(rng.choice(LENGTHS))
    if command in (1, 2, 4):
        return struct.pack("<3I", group, offset, length) if command == 2 else b""
    if command == 3:
        data = _noise(rng, 16)
        return struct.pack("<3I", group, offset, len(data)) + data
    if command == 5:
        return struct.pack("<HHI", rng.integers(0, 20), 0, 0)
    if command == 6:
        mode, delay, cycle = rng.integers(0, 8), rng.choice(LENGTHS), rng.choice(LENGTHS)
        return struct.pack("<6I16x", group, offset, length, mode, delay, cycle)
    if command == 7:
        return struct.pack("<I", rng.integers(0, 20))
    return _asked(rng, group, offset, length)


def _asked(rng: np.random.Generator, group: int, offset: int, length: int) -> bytes:
    """Return what a request by name, or a sum, takes."""
    data = _sum(rng, offset % 5) if 0xF080 <= group <= 0xF086 else NAMES[int(rng.integers(len(NAMES)))]
    return struct.pack("<4I", group, offset % 5 if 0xF080 <= group <= 0xF086 else 0, length, len(data)) + data


def _sum(rng: np.random.Generator, count: int) -> bytes:
    heads = (struct.pack("<3I", rng.choice(GROUPS), rng.integers(0, 9), rng.choice(LENGTHS)) for _ in range(count))
    return b"".join(heads) + _noise(rng, 12)


def _noise(rng: np.random.Generator, most: int) -> bytes:
    return rng.bytes(int(rng.integers(0, most + 1)))


def _whole(_rng: np.random.Generator, raw: bytes) -> bytes:
    return raw


def _flip(rng: np.random.Generator, raw: bytes) -> bytes:
    changed = bytearray(raw)
    for _ in range(int(rng.integers(1, 5))):
        changed[int(rng.integers(len(raw)))] = int(rng.integers(256))
    return bytes(changed)


def _cut(rng: np.random.Generator, raw: bytes) -> bytes:
    kept = raw[6 : int(rng.integers(6, len(raw) + 1))]
    return framed(kept) if rng.random() < 0.8 else raw[: int(rng.integers(len(raw)))]


def _stretch(rng: np.random.Generator, raw: bytes) -> bytes:
    more = _noise(rng, 40)
    return framed(raw[6:] + more) if rng.random() < 0.8 else raw + more


def _length(rng: np.random.Generator, raw: bytes) -> bytes:
    at = int(rng.choice([26, 46, 50, 42])) if rng.random() < 0.9 else 2
    if at + 4 > len(raw):
        return raw
    return raw[:at] + struct.pack("<I", rng.choice(LENGTHS)) + raw[at + 4 :]


def _group(rng: np.random.Generator, raw: bytes) -> bytes:
    return raw[:38] + struct.pack("<II", rng.integers(2**32), rng.integers(2**32)) + raw[46:] if len(raw) > 46 else raw


def _splice(rng: np.random.Generator, raw: bytes) -> bytes:
    other = request(rng)
    return framed(raw[6 : int(rng.integers(6, len(raw) + 1))] + other[int(rng.integers(6, len(other) + 1)) :])


def _noisy(rng: np.random.Generator, _raw: bytes) -> bytes:
    return framed(_noise(rng, 80), int(rng.integers(0, 4)))


DAMAGES: Final[tuple[Bytes, ...]] = (_whole, _flip, _cut, _stretch, _length, _group, _splice, _noisy)


def conversation(seed: int, case: int) -> list[bytes]:
    """Return the frames of a case."""
    rng = stream(seed, case, STREAM)
    return [DAMAGES[int(rng.integers(len(DAMAGES)))](rng, request(rng)) for _ in range(FRAMES)]


class _Bystander:
    """A client that does what clients do."""

    def __init__(self, device: Device) -> None:
        self._peer = device.connect()
        self._source = Address(net_id("127.0.0.1.1.9"), 31_000)
        self._count = 0
        self.problems: list[str] = []
        (place,) = (one for one in device.inside.places if one.symbol.name == "GVL.Count")
        self._offset = place.start
        order = struct.pack("<6I16x", 0x4040, self._offset, 4, 4, 0, 0)
        self._ask(6, order)

    def _ask(self, command: int, data: bytes) -> None:
        self._count += 1
        packet = Packet(Address(SERVER, 851), self._source, command, 4, 0, self._count, data)
        self._peer.connection.receive(framed(packet.pack()))

    def turn(self, device: Device) -> None:
        """Read, write and read again; note what is wrong."""
        self._peer.packets()
        value = struct.pack("<i", self._count)
        self._ask(3, struct.pack("<3I", 0x4040, self._offset, 4) + value)
        device.tick()
        self._ask(2, struct.pack("<3I", 0x4040, self._offset, 4))
        answers = [packet.data for packet in self._peer.packets() if packet.command in (2, 3)]
        if answers != [bytes(4), struct.pack("<II", 0, 4) + value]:
            self.problems.append(f"the other client was answered {answers}, not with what it wrote: {value!r}")


def problems(seed: int, case: int) -> list[str]:
    """Hold a conversation; return what went wrong."""
    device = Device()
    other = _Bystander(device)
    rng = stream(seed, case, STREAM + 1)
    peer = device.connect()
    for number, frame in enumerate(conversation(seed, case)):
        peer = _said(device, peer, frame, int(rng.integers(1, len(frame) + 2)))
        if number % 10 == 9:
            other.turn(device)
    peer.connection.closed()
    return other.problems + _left(device)


def _said(device: Device, peer: Peer, frame: bytes, cut: int) -> Peer:
    """Send a frame in two pieces; return the stream, a new one if that has ended."""
    try:
        for piece in (frame[:cut], frame[cut:]):
            peer.connection.receive(piece)
    except FrameError:
        peer.connection.closing = True
    peer.packets()
    if not peer.connection.closing:
        return peer
    peer.connection.closed()
    return device.connect()


def _left(device: Device) -> list[str]:
    """Return what the device still holds of clients that are gone."""
    left = []
    if len(device.notifications) != 1:
        left.append(f"{len(device.notifications)} notifications are left, one is the other client's")
    held = device.router.held()
    if held:
        left.append(f"{held} handles or ports are left")
    return left


def run(seed: int, cases: range) -> list[Failure]:
    """Judge cases."""
    return judged(problems, seed, cases)


def describe(seed: int, case: int) -> str:
    """Return the frames of a case."""
    return "\n".join(frame.hex() for frame in conversation(seed, case))


ADS: Final = Campaign("ads", "frames", FRAMES, BATCH, 1_000_000, run, describe)
