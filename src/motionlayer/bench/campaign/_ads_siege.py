"""The campaign `siege`: bad clients of a real server process, through real sockets, several at a time.

A case is `CLIENTS` connections, each of one of these kinds:

========= ===============================================================================
damaged   holds a conversation of the campaign `ads`, and leaves in good order
reset     does so, and resets the connection before the answers have come
half      stops inside of a frame, and stays
silent    connects, says nothing, and stays
huge      says that a frame has up to 4 GiB, sends some bytes of it, and stays
deaf      asks for all types and symbols again and again, and reads nothing
========= ===============================================================================

Who stays is gone when `STAYING` others have come to stay. After each case another client writes, reads back and must be
answered in time, the process must live, and must not have said a word on its error output. The cases of a batch share a
process; after a batch, its memory must not have grown by more than `GROWTH` a case.
"""

import contextlib
import socket
import struct
from collections import deque
from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from motionlayer.bench.campaign._ads import FRAMES, SERVER, conversation
from motionlayer.bench.campaign._ads_victim import COMMAND, Victim, victim
from motionlayer.bench.campaign._campaign import Campaign, Failure, stream
from motionlayer.connect.ads import net_id
from motionlayer.connect.ads._frame import Address, Packet, framed

CLIENTS: Final = 4
STAYING: Final = 24
BATCH: Final = 50
STREAM: Final = 8

WARMING: Final = 15
"""Cases before the memory is looked at for the first time: pools and caches fill."""

GROWTH: Final = 20_000
"""Bytes of memory that a case may cost; beyond `SLACK`, which the allocator needs."""

SLACK: Final = 1_500_000

PATIENCE: Final = 5.0
"""Wall time in seconds: a server that takes longer to answer a read hangs."""

DYING: Final = 1.0
"""Wall time in seconds for a process that disconnects everybody to end."""

UPLOADS: Final = 200
"""Requests of a client that reads nothing."""

Cry = Callable[[np.random.Generator, list[bytes]], bytes]
"""Makes what is sent, of the frames of a conversation."""

_RESET: Final = struct.pack("ii", 1, 0)
_SOURCE: Final = Address(net_id("127.0.0.1.1.9"), 31_000)


def _whole(_rng: np.random.Generator, frames: list[bytes]) -> bytes:
    return b"".join(frames)


def _half(rng: np.random.Generator, frames: list[bytes]) -> bytes:
    raw = request(2, struct.pack("<3I", 0xF008, 0, 1))
    return frames[0] + raw[: int(rng.integers(1, len(raw)))]


def _silent(_rng: np.random.Generator, _frames: list[bytes]) -> bytes:
    return b""


def _huge(rng: np.random.Generator, frames: list[bytes]) -> bytes:
    length = int(rng.choice([4 * 1024 * 1024, 4 * 1024 * 1024 + 1, 0x7FFF_FFFF, 0xFFFF_FFFF]))
    return struct.pack("<HI", 0, length) + b"".join(frames)


def _deaf(_rng: np.random.Generator, _frames: list[bytes]) -> bytes:
    groups = (0xF00E, 0xF00B)
    return b"".join(request(2, struct.pack("<3I", groups[n % 2], 0, 0xFFFF_FFFF)) for n in range(UPLOADS))


KINDS: Final[dict[str, Cry]] = {
    "damaged": _whole, "reset": _whole, "half": _half, "silent": _silent, "huge": _huge, "deaf": _deaf,
}  # fmt: skip
LEAVING: Final = ("damaged", "reset")


def request(command: int, data: bytes, number: int = 1, source: Address = _SOURCE) -> bytes:
    """Return a frame for the PLC port."""
    return framed(Packet(Address(SERVER, 851), source, command, 4, 0, number, data).pack())


def cries(seed: int, case: int) -> list[tuple[str, bytes]]:
    """Return what the clients of a case are, and what they send."""
    rng = stream(seed, case, STREAM)
    made = []
    for client in range(CLIENTS):
        kind = str(rng.choice(list(KINDS)))
        made.append((kind, KINDS[kind](rng, conversation(seed, case * CLIENTS + client))))
    return made


class _Bystander:
    """A client that does what clients do."""

    def __init__(self, port: int) -> None:
        self._stream = socket.create_connection(("127.0.0.1", port), PATIENCE)
        self._count = 0
        handle = self._ask(9, struct.pack("<4I", 0xF003, 0, 4, 9) + b"GVL.Count")
        self._place = 0xF005, int.from_bytes(handle[8:12], "little"), 4

    def close(self) -> None:
        self._stream.close()

    def problem(self) -> str:
        """Write, and read back; return what is wrong, "" if nothing is."""
        value = struct.pack("<i", self._count)
        try:
            answers = (
                self._ask(3, struct.pack("<3I", *self._place) + value),
                self._ask(2, struct.pack("<3I", *self._place)),
            )
        except TimeoutError:
            return f"the other client is not answered within {PATIENCE:g} s"
        except (OSError, struct.error) as error:
            return f"the other client is disconnected: {error}"
        good = answers == (bytes(4), struct.pack("<II", 0, 4) + value)
        return "" if good else f"the other client was answered {answers}, not with what it wrote: {value!r}"

    def _ask(self, command: int, data: bytes) -> bytes:
        self._count += 1
        self._stream.sendall(request(command, data, self._count))
        head = self._stream.recv(6, socket.MSG_WAITALL)
        (length,) = struct.unpack("<2xI", head)
        return self._stream.recv(length, socket.MSG_WAITALL)[32:]


def _attack(port: int, kind: str, data: bytes) -> socket.socket | None:
    """Let one client come and say what it has to say; return its connection if it stays."""
    try:
        client = socket.create_connection(("127.0.0.1", port), PATIENCE)
    except OSError:
        return None  # full: that is what limits are for
    client.settimeout(0.2)  # who is not read goes on without
    with contextlib.suppress(OSError):
        client.sendall(data)
    if kind not in LEAVING:
        return client
    if kind == "reset":
        client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _RESET)
    else:
        with contextlib.suppress(OSError):
            client.shutdown(socket.SHUT_WR)
            while client.recv(65_536):
                pass
    client.close()
    return None


class Siege:
    """What happens to one server process.

    Args:
        target: the process.
    """

    def __init__(self, target: Victim) -> None:
        self._target = target
        self._other = _Bystander(target.port)
        self._staying: deque[socket.socket] = deque()

    def fault(self, said: list[tuple[str, bytes]]) -> str:
        """Let the clients of a case come; return what is wrong then, "" if nothing is."""
        for kind, data in said:
            client = _attack(self._target.port, kind, data)
            if client is not None:
                self._staying.append(client)
        while len(self._staying) > STAYING:
            self._staying.popleft().close()
        problem = self._other.problem()
        return "\n".join([problem, *self._target.problems(DYING if problem else 0.0)]).strip()

    def close(self) -> None:
        """Let all clients go."""
        self._other.close()
        for client in self._staying:
            client.close()


def besiege(seed: int, cases: range, command: Sequence[str] = COMMAND) -> list[Failure]:
    """Judge the cases of a batch against one server process, up to the first that fails.

    Args:
        seed: of all cases.
        cases: their numbers.
        command: that runs the server.
    """
    with victim(command) as target, contextlib.closing(Siege(target)) as siege:
        for case in range(WARMING):
            fault = siege.fault(cries(seed + 1, case))
            if fault:
                return [Failure(cases.start, f"before the first case: {fault}")]
        before = target.resident()
        for case in cases:
            fault = siege.fault(cries(seed, case))
            if fault:
                return [Failure(case, fault)]
        grown = target.resident() - before
    if grown > SLACK + GROWTH * len(cases):
        return [Failure(cases[-1], f"the memory has grown by {grown} bytes over {len(cases)} cases")]
    return []


def describe(seed: int, case: int) -> str:
    """Return kinds and bytes of the clients of a case."""
    return "\n".join(f"{kind}: {data.hex()}" for kind, data in cries(seed, case))


SIEGE: Final = Campaign("siege", "frames", FRAMES * CLIENTS, BATCH, 1_000_000, besiege, describe)
