"""`Watcher`: a small ADS client that shows live values of a device.

It knows no more than that: resolve symbols, subscribe, receive. Anything else is the business of real clients.
"""

import itertools
import socket
import struct
from collections.abc import Iterator, Sequence
from types import TracebackType
from typing import Final, NamedTuple, Self

from motionlayer.connect.ads._codes import Code
from motionlayer.connect.ads._frame import (
    REQUEST,
    RESPONSE,
    Address,
    Carrier,
    FrameError,
    Packet,
    Splitter,
    framed,
    net_id,
)
from motionlayer.connect.ads._hints import hint
from motionlayer.connect.ads._leaves import Leaf, SymbolEntry, TypeEntry, Value, leaves, symbol_of, symbols_of, type_of
from motionlayer.connect.ads._numbers import (
    ADD_NOTIFICATION,
    ENTRY_BY_NAME,
    NOTIFICATION,
    READ,
    READ_WRITE,
    TYPE_BY_NAME,
    UPLOAD,
)
from motionlayer.connect.ads._watch_errors import Absent, Lost, RefusedError, WatchError

ON_CHANGE: Final = 4
EPOCH: Final = 116_444_736_000_000_000
"""FILETIME of 1970-01-01."""

MOST: Final = 0xFFFF_FFFF
"""Bytes of an answer: all that there are."""

_NAMES_NOTHING: Final = (Code.SYMBOL_NOT_FOUND, Code.INVALID_ARRAY_INDEX, Code.SYNTAX)
_NAMES: Final = {int(code): code.name.lower().replace("_", " ") for code in Code}

PATIENCE: Final = 5.0
"""Seconds to wait for a connection or an answer."""


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
        try:
            self._socket = socket.create_connection((host, port), PATIENCE)
        except OSError as error:
            raise Absent(f"{host}:{port}: {error.strerror or error}; is a run with --ads there?") from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._target = Address(net_id(target), ads_port)
        # Who watches twice from one computer is told apart by the port of the connection.
        self._source = Address(net_id("127.0.0.1.1.2"), self._socket.getsockname()[1])
        self._splitter = Splitter()
        self._packets: list[Packet] = []
        self._numbers = itertools.count(1)
        self._types: dict[str, TypeEntry] = {}
        self._symbols: dict[str, SymbolEntry] = {}
        self._watched: dict[int, _Watched] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._socket.close()

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
        answer = self._ask(ADD_NOTIFICATION, order, name)
        self._watched[struct.unpack_from("<I", answer)[0]] = _Watched(found)
        return found

    def samples(self, timeout: float | None) -> Iterator[Sample]:
        """Yield what has come; nothing if nothing comes in time.

        Args:
            timeout: seconds to wait for something; without end where left out.

        Raises:
            Lost: the device is gone.
            WatchError: what comes means nothing.
        """
        if not any(packet.command == NOTIFICATION for packet in self._packets):
            self._receive(timeout)
        packets, self._packets = self._packets, []
        for packet in packets:
            if packet.command == NOTIFICATION:
                yield from self._stream(packet.data)

    def _symbol(self, name: str) -> SymbolEntry:
        if name not in self._symbols:
            try:
                self._symbols[name] = symbol_of(self._by_name(ENTRY_BY_NAME, name))
            except RefusedError as error:
                if error.code not in _NAMES_NOTHING:
                    raise
                found = hint(name, symbols_of(self._upload()), self._type)
                raise WatchError(f"{error}; {found}" if found else str(error)) from None
        return self._symbols[name]

    def _type(self, name: str) -> TypeEntry:
        if name not in self._types:
            self._types[name] = type_of(self._by_name(TYPE_BY_NAME, name))
        return self._types[name]

    def _by_name(self, group: int, name: str) -> bytes:
        text = name.encode("cp1252", errors="replace") + b"\0"
        answer = self._ask(READ_WRITE, struct.pack("<4I", group, 0, MOST, len(text)) + text, name)
        return answer[4:]

    def _upload(self) -> bytes:
        """Return the entries of all symbols."""
        return self._ask(READ, struct.pack("<3I", UPLOAD, 0, MOST), "the list of symbols")[4:]

    def _ask(self, command: int, data: bytes, what: str) -> bytes:
        """Return what a request is answered with, behind the result."""
        self._socket.settimeout(PATIENCE)
        number = next(self._numbers)
        packet = Packet(self._target, self._source, command, REQUEST, 0, number, data)
        try:
            self._socket.sendall(framed(packet.pack()))
        except OSError as error:
            raise Lost(f"the connection is lost: {error.strerror or error}") from error
        while True:
            for at, answer in enumerate(self._packets):
                if answer.flags & RESPONSE and answer.invoke_id == number:
                    del self._packets[at]
                    return _accepted(answer, what)
            if not self._receive(PATIENCE):
                raise Lost(f"{what}: no answer within {PATIENCE:g} s")

    def _receive(self, timeout: float | None) -> bool:
        """Take what comes; tell whether something has."""
        self._socket.settimeout(timeout)
        try:
            data = self._socket.recv(65_536)
        except TimeoutError:
            return False
        except OSError as error:
            raise Lost(f"the connection is lost: {error.strerror or error}") from error
        if not data:
            raise Lost("the device has ended the connection")
        try:
            frames = [frame for frame in self._splitter.feed(data) if frame.command == Carrier.PACKET]
        except FrameError as error:
            raise WatchError(f"what answers there is no ADS device: {error}") from error
        self._packets += [packet for packet in (Packet.parse(frame.data) for frame in frames) if packet is not None]
        return True

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


def _accepted(answer: Packet, what: str) -> bytes:
    """Return the data behind the result of an answer.

    Raises:
        RefusedError: it says that something was refused.
    """
    code = answer.error or struct.unpack_from("<I", answer.data)[0]
    if code:
        raise RefusedError(f"{what}: {_NAMES.get(code, 'error')} (0x{code:X})", code)
    return answer.data[4:]
