"""`Watcher`: a small ADS client that shows live values of a device.

It knows no more than that: resolve symbols, subscribe, receive. Anything else is the business of real clients.
"""

import struct
from collections.abc import Iterator, Sequence
from types import TracebackType
from typing import Final, NamedTuple, Self

from motionlayer.connect.ads._codes import Code
from motionlayer.connect.ads._hints import hint
from motionlayer.connect.ads._leaves import Leaf, SymbolEntry, TypeEntry, Value, leaves, symbol_of, symbols_of, type_of
from motionlayer.connect.ads._numbers import ADD_NOTIFICATION, ENTRY_BY_NAME, READ, READ_WRITE, TYPE_BY_NAME, UPLOAD
from motionlayer.connect.ads._remote import Remote
from motionlayer.connect.ads._watch_errors import RefusedError, WatchError, readable

ON_CHANGE: Final = 4
EPOCH: Final = 116_444_736_000_000_000
"""FILETIME of 1970-01-01."""

MOST: Final = 0xFFFF_FFFF
"""Bytes of an answer: all that there are."""

_NAMES_NOTHING: Final = (Code.SYMBOL_NOT_FOUND, Code.INVALID_ARRAY_INDEX, Code.SYNTAX)


class _Watched:
    """A symbol that is watched as a whole: what of it has changed is found here.

    Args:
        found: its elementary values.
    """

    def __init__(self, found: Sequence[Leaf]) -> None:
        self._leaves = found
        self._last: dict[str, bytes] = {}

    def changes(self, data: bytes) -> Iterator[tuple[Leaf, Value]]:
        """Yield the values that are not as they were; of the first sample all."""
        for leaf in self._leaves:
            raw = leaf.raw(data)
            if self._last.get(leaf.name) != raw:
                self._last[leaf.name] = raw
                yield leaf, leaf.value(raw)


class Sample(NamedTuple):
    """A value that has come.

    Attributes:
        time: of the tick, s since 1970.
        leaf: whose value it is.
        value: the value.
    """

    time: float
    leaf: Leaf
    value: Value


class Watcher:
    """A client of one device, to be used as a context.

    Args:
        host: address of the device.
        port: TCP port.
        target: NetId of the device.
        ads_port: AMS port of the device.

    Raises:
        Absent: nobody answers there.
    """

    def __init__(self, host: str, port: int, target: str = "127.0.0.1.1.1", ads_port: int = 851) -> None:
        self._device = Remote(host, port, target, ads_port)
        self._types: dict[str, TypeEntry] = {}
        self._symbols: dict[str, SymbolEntry] = {}
        self._watched: dict[int, _Watched] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._device.close()

    def values(self, name: str) -> Iterator[Leaf]:
        """Yield the elementary values of a symbol, in the order of their bytes.

        Args:
            name: any symbol, or a part of one.

        Raises:
            WatchError: there is none of this name; the text says what may have been meant.
        """
        return leaves(self._symbol(name), self._type)

    def watch(self, name: str, cycle: float) -> Sequence[Leaf]:
        """Receive the values of a symbol from now on, whenever they change.

        The device samples the symbol as a whole, so all values of a sample are of one tick.

        Args:
            name: any symbol, or a part of one.
            cycle: how often it is looked at, s.

        Returns:
            The elementary values.

        Raises:
            WatchError: the device refuses.
        """
        symbol, found = self._symbol(name), list(self.values(name))
        order = struct.pack("<6I16x", symbol.group, symbol.offset, symbol.size, ON_CHANGE, 0, round(cycle * 1e7))
        answer = self._device.ask(ADD_NOTIFICATION, order, name)
        with readable(name):
            (handle,) = struct.unpack_from("<I", answer)
        self._watched[handle] = _Watched(found)
        return found

    def samples(self, timeout: float | None) -> Iterator[Sample]:
        """Yield what has come; nothing if nothing comes in time.

        Args:
            timeout: seconds to wait for something; without end where left out.

        Raises:
            Lost: the device is gone.
            WatchError: what comes means nothing.
        """
        for data in self._device.notifications(timeout):
            with readable("a notification"):
                yield from self._stream(data)

    def _symbol(self, name: str) -> SymbolEntry:
        if name not in self._symbols:
            try:
                with readable(name):
                    self._symbols[name] = symbol_of(self._by_name(ENTRY_BY_NAME, name))
            except RefusedError as error:
                if error.code not in _NAMES_NOTHING:
                    raise
                found = hint(name, symbols_of(self._upload()), self._type)
                raise WatchError(f"{error}; {found}" if found else str(error)) from None
        return self._symbols[name]

    def _type(self, name: str) -> TypeEntry:
        if name not in self._types:
            with readable(name):
                self._types[name] = type_of(self._by_name(TYPE_BY_NAME, name))
        return self._types[name]

    def _by_name(self, group: int, name: str) -> bytes:
        text = name.encode("cp1252", errors="replace") + b"\0"
        answer = self._device.ask(READ_WRITE, struct.pack("<4I", group, 0, MOST, len(text)) + text, name)
        return answer[4:]

    def _upload(self) -> bytes:
        """Return the entries of all symbols."""
        return self._device.ask(READ, struct.pack("<3I", UPLOAD, 0, MOST), "the list of symbols")[4:]

    def _stream(self, data: bytes) -> Iterator[Sample]:
        _, stamps = struct.unpack_from("<II", data)
        at = 8
        for _ in range(stamps):
            time, samples = struct.unpack_from("<QI", data, at)
            at += 12
            for _ in range(samples):
                handle, size = struct.unpack_from("<II", data, at)
                if handle in self._watched:
                    changes = self._watched[handle].changes(data[at + 8 : at + 8 + size])
                    yield from (Sample((time - EPOCH) * 1e-7, leaf, value) for leaf, value in changes)
                at += 8 + size
