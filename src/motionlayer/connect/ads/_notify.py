"""Notifications: what is sampled for whom, and when it is sent (ads 2.1, 2.2).

Time is the tick of the published image. A notification is sampled every `cycle` ticks; what is due for one connection
goes into one frame. Two things do not wait for their tick:

- The first sample goes out after `FIRST` looks, whatever the cycle: never with the answer to the request, since there
  are clients that would not know the handle yet.
- While a run is held up no tick comes, but writes are applied. What is reported on change is sampled at every
  publication then; what is reported in a cycle waits for the time to go on.

A run that is taken back shows an earlier tick than before; all cycles begin anew then.
"""

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, NamedTuple

from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._frame import AMS, REQUEST, Address
from motionlayer.connect.ads._service import Watched

ADD: Final = struct.Struct("<6I16s")
"""Group, offset, length, mode, max delay, cycle time, reserved."""

NOTIFICATION: Final = 8
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
_SAMPLE: Final = struct.Struct("<II")

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
class _Notification:
    watched: Watched
    on_change: bool
    head: bytes
    last: bytes | None = None


class _Group:
    """Notifications of one client on one address that are sampled together."""

    def __init__(self, client: Client, served: Address, send: Send, cycle: int, hold: int) -> None:
        self.cycle = cycle
        self.next = -1
        self.notifications: dict[int, _Notification] = {}
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

    def look(self, tick: int, stamp: int, image: bytes, *, standing: bool) -> None:
        """Sample what is due at this tick, and send what need not wait."""
        begun = [handle for handle, looks in self.fresh.items() if looks <= 1]
        chosen: list[_Notification] = []
        if tick >= self.next:
            # On the grid of the first one: a look that comes late does not delay those after it.
            start = tick if self.next < 0 else self.next
            self.next = start + ((tick - start) // self.cycle + 1) * self.cycle
            chosen = [one for handle, one in self.notifications.items() if self.fresh.get(handle, 0) <= 1]
        else:
            chosen = [self.notifications[handle] for handle in begun]
            if standing:
                chosen += [one for one in self.notifications.values() if one.on_change and one.last is not None]
        if self.fresh:
            self.fresh = {handle: looks - 1 for handle, looks in self.fresh.items() if looks > 1}
        samples = _samples(chosen, image)
        if samples:
            self._hold_back(tick, _STAMP.pack(stamp, len(samples)) + b"".join(samples))
        if self._held and (tick >= self._held_until or standing):
            self._send()

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


def _samples(notifications: list[_Notification], image: bytes) -> list[bytes]:
    samples = []
    for one in notifications:
        value = one.watched.sample(image)
        if not one.on_change or value != one.last:
            samples.append(one.head + value)
        one.last = value
    return samples


class Notifications:
    """All notifications of a server.

    Args:
        cycle_ns: of the run.
        limit: of all clients together.
    """

    def __init__(self, cycle_ns: int, limit: int) -> None:
        self._cycle_ns = cycle_ns
        self._limit = limit
        self._groups: dict[tuple[Client, Address, int, int], _Group] = {}
        self._of: dict[int, tuple[_Group, int]] = {}
        self._last = 0
        self._tick = -1
        self._due = -1

    def __len__(self) -> int:
        return len(self._of)

    @property
    def beginning(self) -> bool:
        """A first sample is to be sent, also if nothing is published."""
        return bool(self._of) and self._due < 0

    def due(self, tick: int) -> bool:
        """Tell whether a publication of this tick has to be looked at."""
        return bool(self._of) and (tick >= self._due or tick <= self._tick)

    def add(self, client: Client, served: Address, order: Order, watched: Watched, send: Send) -> int:
        """Begin a notification and return its handle.

        Args:
            client: who asks.
            served: address that was asked; the notifications come from there.
            order: what is asked for.
            watched: what it samples.
            send: takes the packets.

        Raises:
            AdsError: unknown mode (0x713), too many bytes (0x717), or too many notifications (0x716).
        """
        self._require_room(client, order, watched.length)
        cycle, hold = self._ticks(order.cycle), order.max_delay * UNIT_NS // self._cycle_ns
        key = client, served, cycle, hold
        group = self._groups.get(key)
        if group is None:
            group = self._groups[key] = _Group(client, served, send, cycle, hold)
        self._last = self._last % 0xFFFF_FFFE + 1
        handle = self._last
        head = _SAMPLE.pack(handle, watched.length)
        group.notifications[handle] = _Notification(watched, order.mode in ON_CHANGE, head)
        group.fresh[handle] = FIRST
        self._of[handle] = group, watched.length
        self._due = -1
        client.notifications.add(handle)
        client.watched += watched.length
        return handle

    def _require_room(self, client: Client, order: Order, length: int) -> None:
        if order.mode not in CYCLIC and order.mode not in ON_CHANGE:
            raise AdsError(Code.MODE_NOT_SUPPORTED, f"transmission mode {order.mode}")
        if client.watched + length > client.limits.watched:
            raise AdsError(Code.WATCH_SIZE, f"{client} watches {client.watched} bytes, at most {client.limits.watched}")
        if len(client.notifications) >= client.limits.notifications or len(self._of) >= self._limit:
            raise AdsError(Code.NO_MORE_HANDLES, f"{client} has {len(client.notifications)} notifications")

    def _ticks(self, cycle: int) -> int:
        """Return a time in whole ticks, one at least: some clients ask for far less than they mean."""
        return max(1, -(-cycle * UNIT_NS // self._cycle_ns))

    def delete(self, client: Client, handle: int) -> None:
        """End a notification.

        Raises:
            AdsError: the client has none of this handle (0x714).
        """
        if handle not in client.notifications:
            raise AdsError(Code.NOTIFICATION_HANDLE_INVALID, f"no notification {handle}")
        client.notifications.discard(handle)
        group, length = self._of.pop(handle)
        client.watched -= length
        del group.notifications[handle]
        group.fresh.pop(handle, None)
        if not group.notifications:
            self._groups = {key: one for key, one in self._groups.items() if one is not group}

    def forget(self, client: Client) -> None:
        """End what a client had."""
        for handle in tuple(client.notifications):
            self.delete(client, handle)

    def look(self, tick: int, stamp: int, image: bytes) -> None:
        """Send what is due; called with every publication for which `due` says so.

        Args:
            tick: the last finished one.
            stamp: its time, FILETIME.
            image: a snapshot of it.
        """
        groups = tuple(self._groups.values())
        if tick < self._tick:
            for group in groups:
                group.begin_anew()
        standing = tick == self._tick
        self._tick = tick
        for group in groups:
            if standing or tick >= group.due:
                group.look(tick, stamp, image, standing=standing)
        self._due = min((group.due for group in self._groups.values()), default=-1)
