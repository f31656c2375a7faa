"""Notifications: what is sampled for whom, and when it is sent (ads 2.1, 2.2).

Time is the tick of the published image. A notification is sampled every `cycle` ticks; what is due for one connection
goes into one frame. Two things do not wait for their tick:

- The first sample goes out after `FIRST` looks, whatever the cycle: never with the answer to the request, since there
  are clients that would not know the handle yet.
- While a run is held up no tick comes, but writes are applied. What is reported on change is sampled at every
  publication then; what is reported in a cycle waits for the time to go on.

A run that is taken back shows an earlier tick than before; all cycles begin anew then.
"""

from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._frame import Address
from motionlayer.connect.ads._group import CYCLIC, FIRST, ON_CHANGE, SAMPLE, UNIT_NS, Group, Notification, Order, Send
from motionlayer.connect.ads._service import Bytes, Watched
from motionlayer.connect.ads._watches import Watches

_Key = tuple[Client, Address, int, int]
"""Who is told from where, and the ticks of cycle and delay: what belongs together."""


class Notifications:
    """All notifications of a server.

    Args:
        cycle_ns: of the run.
        limit: of all clients together.
        watches: what the run keeps for them.
    """

    def __init__(self, cycle_ns: int, limit: int, watches: Watches) -> None:
        self._watches = watches
        self._cycle_ns = cycle_ns
        self._limit = limit
        self._groups: dict[_Key, Group] = {}
        self._of: dict[int, tuple[_Key, Watched]] = {}
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
            group = self._groups[key] = Group(client, served, send, cycle, hold)
        self._last = self._last % 0xFFFF_FFFE + 1
        handle = self._last
        head, since = SAMPLE.pack(handle, watched.length), self._watches.add(watched)
        group.notifications[handle] = Notification(watched, order.mode in ON_CHANGE, head, since)
        group.fresh[handle] = FIRST
        self._of[handle] = key, watched
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
        key, watched = self._of.pop(handle)
        client.watched -= watched.length
        self._watches.remove(watched)
        group = self._groups[key]
        del group.notifications[handle]
        group.fresh.pop(handle, None)
        if not group.notifications:
            del self._groups[key]

    def forget(self, client: Client) -> None:
        """End what a client had."""
        for handle in tuple(client.notifications):
            self.delete(client, handle)

    def wait(self) -> None:
        """Take up that the server looks once more, whatever there is to see; first samples wait for `FIRST` looks."""
        if self._due < 0:
            for group in self._groups.values():
                group.wait()

    def look(self, tick: int, stamp: int, image: Bytes, version: int) -> None:
        """Send what is due; called with every publication for which `due` says so.

        Args:
            tick: of the publication.
            stamp: its time, FILETIME.
            image: what was published.
            version: of the history.
        """
        groups = tuple(self._groups.values())
        if tick < self._tick:
            for group in groups:
                group.begin_anew()
        standing = tick == self._tick
        self._tick = tick
        for group in groups:
            if standing or tick >= group.due:
                group.look(tick, stamp, image, version, standing=standing)
        self._due = min((group.due for group in self._groups.values()), default=-1)
