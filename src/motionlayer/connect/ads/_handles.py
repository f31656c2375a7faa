"""`Handles`: numbers that clients hold for values and methods (ads 4)."""

import struct
from typing import Final, TypeVar

from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._tree import MethodPlace, Place

_U32: Final = struct.Struct("<I")
_MOST: Final = 0xFFFF_FFFE


Held = TypeVar("Held", Place, MethodPlace)


class Handles:
    """Handles of all clients.

    Attributes:
        age: how many have been released: a number may stand for something else since.
    """

    def __init__(self) -> None:
        self._held: dict[int, Place | MethodPlace] = {}
        self.age = 0
        self._last = 0

    def __len__(self) -> int:
        return len(self._held)

    def take(self, client: Client, what: Place | MethodPlace) -> int:
        """Return a new handle.

        Raises:
            AdsError: there are too many (0x716).
        """
        if len(client.handles) >= client.limits.handles or len(self) >= client.limits.all_handles:
            raise AdsError(Code.NO_MORE_HANDLES, f"{client} holds {len(client.handles)} handles")
        self._last = self._last % _MOST + 1
        while self._last in self._held:
            self._last = self._last % _MOST + 1
        self._held[self._last] = what
        client.handles.add(self._last)
        return self._last

    def release(self, client: Client, data: bytes) -> None:
        """Release a handle.

        Args:
            client: who asks.
            data: the handle, 4 bytes.

        Raises:
            AdsError: these are not 4 bytes (0x705), or there is no such handle (0x710).
        """
        if len(data) != _U32.size:
            raise AdsError(Code.INVALID_SIZE, f"{len(data)} bytes, a handle has 4")
        (handle,) = _U32.unpack(data)
        if self._held.pop(handle, None) is None:
            raise AdsError(Code.SYMBOL_NOT_FOUND, f"no handle {handle}")
        client.handles.discard(handle)
        self.age += 1

    def forget(self, client: Client) -> None:
        """Release what a client holds."""
        for handle in client.handles:
            self._held.pop(handle, None)
        client.handles.clear()
        self.age += 1

    def find(self, handle: int) -> Place | MethodPlace | None:
        """Return what a handle stands for, None if there is none."""
        return self._held.get(handle)

    def value(self, handle: int) -> Place:
        """Return the value that a handle stands for.

        Raises:
            AdsError: there is none (0x710).
        """
        return self._known(handle, Place, "value")

    def method(self, handle: int) -> MethodPlace:
        """Return the method that a handle stands for.

        Raises:
            AdsError: there is none (0x710).
        """
        return self._known(handle, MethodPlace, "method")

    def _known(self, handle: int, kind: type[Held], name: str) -> Held:
        what = self._held.get(handle)
        if not isinstance(what, kind):
            raise AdsError(Code.SYMBOL_NOT_FOUND, f"no {name} has handle {handle}")
        return what
