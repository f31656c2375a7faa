"""What is sampled together for one client: `Group`, and what a client asks for: `Order` (ads 2.1, 2.2)."""

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, NamedTuple

from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._frame import AMS, REQUEST, Address
from motionlayer.connect.ads._numbers import NOTIFICATION
from motionlayer.connect.ads._service import Bytes, Watched

ADD: Final = struct.Struct("<6I16s")
"""Group, offset, length, mode, max delay, cycle time, reserved."""

CYCLIC: Final = (3, 5)
ON_CHANGE: Final = (4, 6)
UNIT_NS: Final = 100
"""Times of a request, in nanoseconds."""

FIRST: Final = 3
"""Looks, each at least a millisecond after the other, until the first sample."""

HELD: Final = 256 * 1024
"""Bytes of samples that are held back for one frame, at most."""

_HEAD: Final = struct.Struct("<II")
_STAMP: Final = struct.Struct("<QI")
SAMPLE: Final = struct.Struct("<II")

Send = Callable[[bytes], None]
"""Takes an AMS packet to a connection."""


class Order(NamedTuple):
    """What a client asks for.

    Attributes:
        group: index group.
        offset: index offset.
        length: bytes.
        mode: transmission mode.
        max_delay: how long samples may be held, in 100 ns.
        cycle: time between samples, in 100 ns.
    """

    group: int
    offset: int
    length: int
    mode: int
    max_delay: int
    cycle: int

    @classmethod
    def parse(cls, data: bytes) -> "Order":
        """Return the order in 40 bytes.

        Raises:
            AdsError: not 40 bytes (0x705).
        """
        if len(data) != ADD.size:
            raise AdsError(Code.INVALID_SIZE, f"{len(data)} bytes, a notification takes {ADD.size}")
        return cls(*ADD.unpack(data)[:6])


@dataclass(eq=False, slots=True)
class Notification:
    """A value that is sampled.

    Attributes:
        watched: where it is.
        on_change: it is sent when it has changed; else always.
        head: what stands before it in a packet.
        since: version of the history from which on it is there.
        last: what was sampled last; None before the first time.
    """

    watched: Watched
    on_change: bool
    head: bytes
    since: int
    last: bytes | None = None


class Group:
    """Notifications of one client on one address that are sampled together.

    Args:
        client: who is told.
        served: address that was asked; the packets come from there.
        send: takes them.
        cycle: ticks from one sample to the next.
        hold: ticks for which samples may wait.

    Attributes:
        cycle: ticks from one sample to the next.
        next: tick of the next sample, -1 before the first.
        notifications: by handle.
        fresh: looks that are left until the first sample, by handle.
    """

    def __init__(self, client: Client, served: Address, send: Send, cycle: int, hold: int) -> None:
        self.cycle = cycle
        self.next = -1
        self.notifications: dict[int, Notification] = {}
        self.fresh: dict[int, int] = {}
        self._send_packet = send
        self._hold = hold
        self._header = served, client.address
        self._held: list[bytes] = []
        self._held_bytes = 0
        self._held_until = 0

    @property
    def due(self) -> int:
        """The tick in which there is something to do."""
        if self.fresh:
            return -1
        return min(self.next, self._held_until) if self._held else self.next

    def look(self, tick: int, stamp: int, image: Bytes, version: int, *, standing: bool) -> None:
        """Sample what is due at this tick, and send what need not wait.

        Args:
            tick: of the image.
            stamp: its time, FILETIME.
            image: what was published.
            version: of the history; what is watched since a later one is not in the image.
            standing: it is a tick that was looked at before.
        """
        begun = self._begun(version) if self.fresh else []
        if tick >= self.next:
            # On the grid of the first one: a look that comes late does not delay those after it.
            start = tick if self.next < 0 else self.next
            self.next = start + ((tick - start) // self.cycle + 1) * self.cycle
            chosen = [one for handle, one in self.notifications.items() if handle not in self.fresh]
        else:
            chosen = begun
            if standing:
                chosen += [one for one in self.notifications.values() if one.on_change and one.last is not None]
        samples = _samples(chosen, image)
        if samples:
            self._hold_back(tick, _STAMP.pack(stamp, len(samples)) + b"".join(samples))
        if self._held and (tick >= self._held_until or standing):
            self._send()

    def wait(self) -> None:
        """Take up that the server looks once more; a first sample is a look nearer."""
        for handle, looks in self.fresh.items():
            self.fresh[handle] = max(0, looks - 1)

    def _begun(self, version: int) -> list[Notification]:
        """Return those whose first sample is due with this look."""
        begun = []
        for handle, looks in list(self.fresh.items()):
            one = self.notifications[handle]
            if not looks and one.since <= version:
                del self.fresh[handle]
                begun.append(one)
        return begun

    def begin_anew(self) -> None:
        """Take up that the ticks have gone back."""
        self.next = -1
        if self._held:
            self._send()

    def _hold_back(self, tick: int, stamped: bytes) -> None:
        if self._held and self._held_bytes + len(stamped) > HELD:
            self._send()
        if not self._held:
            self._held_until = tick + self._hold
        self._held.append(stamped)
        self._held_bytes += len(stamped)

    def _send(self) -> None:
        stamps = b"".join(self._held)
        data = _HEAD.pack(len(stamps) + 4, len(self._held)) + stamps
        self._held.clear()
        self._held_bytes = 0
        served, target = self._header
        self._send_packet(AMS.pack(*target, *served, NOTIFICATION, REQUEST, len(data), 0, 0) + data)


def _samples(notifications: list[Notification], image: Bytes) -> list[bytes]:
    samples = []
    for one in notifications:
        value = one.watched.sample(image)
        if not one.on_change or value != one.last:
            samples.append(one.head + value)
        one.last = value
    return samples
