"""The reader of the rows `ads`: takes notifications from bare sockets, in a process of its own, and counts them.

Reads its work as JSON from stdin: `port`, `clients`, `notifications` of each, `cycle` and `duration` in seconds. Prints
the samples that came, those that the time stamps say are missing between them, and the notifications that never
came or came no more. A client of the usual kind would spend its time
on callbacks, and be what is measured.
"""

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
        counts: of every notification the last time stamp, the samples that came, and those that did not between them.
    """

    def __init__(self, port: int, number: int, cycle: float) -> None:
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.counts: dict[int, list[int]] = {}
        self._cycle = round(cycle / UNIT)
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

    def watch(self, name: str) -> None:
        """Begin a cyclic notification of a number."""
        raw = name.encode()
        handle = self.ask(READ_WRITE, struct.pack("<4I", 0xF003, 0, 4, len(raw)) + raw)[8:12]
        place = struct.pack("<I4sI", 0xF005, handle, LREAL)
        self.ask(ADD, place + struct.pack("<3I16x", CYCLIC, 0, self._cycle))

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
                at += 8 + size
                count = self.counts.setdefault(handle, [stamp, 0, 0])
                count[2] += max(0, round((stamp - count[0]) / self._cycle) - 1)
                count[:2] = stamp, count[1] + 1


def main() -> None:
    """Watch, count, and tell."""
    work = json.load(sys.stdin)
    clients = [Client(work["port"], number, work["cycle"]) for number in range(1, work["clients"] + 1)]
    selector = selectors.DefaultSelector()
    for client in clients:
        for index in range(1, work["notifications"] + 1):
            client.watch(f"GVL.Values[{index}]")
        selector.register(client.socket, selectors.EVENT_READ, client)
    end = time.monotonic() + work["duration"]
    while time.monotonic() < end:
        for key, _ in selector.select(END):
            key.data.take()
    counts = [count for client in clients for count in client.counts.values()]
    last = max(count[0] for count in counts)
    heard = sum((last - count[0]) * UNIT <= END for count in counts)
    told = {"samples": sum(count[1] for count in counts), "lost": sum(count[2] for count in counts)}
    json.dump({**told, "silent": work["clients"] * work["notifications"] - heard}, sys.stdout)


if __name__ == "__main__":
    main()
