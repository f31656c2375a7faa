"""The reader of the rows `ads`: takes notifications from bare sockets, in a process of its own, and counts them.

Reads its work as JSON from stdin: `port`, `clients`, `notifications` of each, `cycle` and `duration` in seconds, and
`every`, the ticks of the cycle. Prints the samples that came, those that are missing between them, and the
notifications that never came or came no more. What is missing is told by ticks, not by time stamps: a run that the
computer has held up goes on later, and no tick of it is lost. The first number that a client watches shows the tick. A
client of the usual kind would spend its time on callbacks, and be what is measured.
"""

import itertools
import json
import selectors
import socket
import struct
import sys
import time

NET_ID = bytes((127, 0, 0, 1, 1, 1))
AMS = struct.Struct("<6sH6sHHHIII")
LREAL = 8
CYCLIC = 3
ADD, NOTIFICATION, READ_WRITE = 6, 8, 9
UNIT = 1e-7
"""Seconds in a unit of ADS times."""

END = 0.5
"""Seconds before the last sample of all in which every notification must have been heard."""


class Client:
    """A client on a socket of its own.

    Attributes:
        stamps: of every notification the time stamps of its samples.
        ticks: of time stamps.
    """

    def __init__(self, port: int, number: int) -> None:
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.stamps: dict[int, list[int]] = {}
        self.ticks: dict[int, int] = {}
        self._clock = 0
        self._source = bytes((127, 0, 0, 1, 2, number)), 30_000 + number
        self._rest = b""

    def ask(self, command: int, data: bytes) -> bytes:
        """Send a request and return its answer; notifications that come before it are counted."""
        header = AMS.pack(NET_ID, 851, *self._source, command, 4, len(data), 0, 1)
        self.socket.sendall(struct.pack("<HI", 0, AMS.size + len(data)) + header + data)
        while True:
            for answer in self.take():
                code = struct.unpack_from("<I", answer)[0]
                if code:
                    raise RuntimeError(f"ADS error {code}")
                return answer

    def watch(self, name: str, cycle: float, *, clock: bool = False) -> None:
        """Begin a cyclic notification of a number, which may be that of the tick."""
        raw = name.encode()
        handle = self.ask(READ_WRITE, struct.pack("<4I", 0xF003, 0, 4, len(raw)) + raw)[8:12]
        place = struct.pack("<I4sI", 0xF005, handle, LREAL)
        added = self.ask(ADD, place + struct.pack("<3I16x", CYCLIC, 0, round(cycle / UNIT)))
        if clock:
            self._clock = struct.unpack_from("<I", added, 4)[0]

    def take(self) -> list[bytes]:
        """Take what has come; count the samples, and return the data of answers."""
        data = self._rest + self.socket.recv(1 << 18)
        at, answers = 0, []
        while len(data) - at >= 6:
            stop = at + 6 + struct.unpack_from("<I", data, at + 2)[0]
            if stop > len(data):
                break
            body = data[at + 6 + AMS.size : stop]
            if struct.unpack_from("<H", data, at + 22)[0] == NOTIFICATION:
                self._count(body)
            else:
                answers.append(body)
            at = stop
        self._rest = data[at:]
        return answers

    def _count(self, data: bytes) -> None:
        at = 8
        for _ in range(struct.unpack_from("<I", data, 4)[0]):
            stamp, samples = struct.unpack_from("<QI", data, at)
            at += 12
            for _ in range(samples):
                handle, size = struct.unpack_from("<II", data, at)
                if self._clock in (0, handle):  # its first sample comes before the answer that names it
                    self.ticks[stamp] = int(struct.unpack_from("<d", data, at + 8)[0])
                at += 8 + size
                self.stamps.setdefault(handle, []).append(stamp)


def missing(stamps: list[int], ticks: dict[int, int], every: int) -> int:
    """Return how many samples of a notification did not come between those that did.

    The first one is left out: it shows the tick in which the notification began, whichever that was.

    Args:
        stamps: of the samples.
        ticks: of all stamps of all clients.
        every: ticks between two samples.
    """
    seen = [ticks[stamp] for stamp in stamps[1:]]
    return sum(max(0, round((after - before) / every) - 1) for before, after in itertools.pairwise(seen))


def main() -> None:
    """Watch, count, and tell."""
    work = json.load(sys.stdin)
    clients = [Client(work["port"], number) for number in range(1, work["clients"] + 1)]
    selector = selectors.DefaultSelector()
    for client in clients:
        for index in range(1, work["notifications"] + 1):
            client.watch(f"GVL.Values[{index}]", work["cycle"], clock=index == 1)
        selector.register(client.socket, selectors.EVENT_READ, client)
    end = time.monotonic() + work["duration"]
    while time.monotonic() < end:
        for key, _ in selector.select(END):
            key.data.take()
    ticks = {stamp: tick for client in clients for stamp, tick in client.ticks.items()}
    heard = [stamps for client in clients for stamps in client.stamps.values()]
    last = max(ticks)
    silent = work["clients"] * work["notifications"] - sum((last - stamps[-1]) * UNIT <= END for stamps in heard)
    lost = sum(missing(stamps, ticks, work["every"]) for stamps in heard)
    json.dump({"samples": sum(map(len, heard)), "lost": lost, "silent": silent}, sys.stdout)


if __name__ == "__main__":
    main()
