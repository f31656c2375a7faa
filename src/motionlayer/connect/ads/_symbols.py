"""`SymbolService`: the PLC port, with symbols, handles and types (ads 4 to 6)."""

import bisect
import functools
import struct
from typing import TYPE_CHECKING, Final

from motionlayer.connect.ads._catalogue import Catalogue
from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._entries import (
    CODE_PAGE,
    address,
    encoded,
    symbol_entry,
    texts,
)
from motionlayer.connect.ads._handles import Handles
from motionlayer.connect.ads._image import BEGINNINGS, STATES
from motionlayer.connect.ads._numbers import (
    DATA_AREA,
    DATA_BITS,
    DATA_SIZE,
    DEVICE_DATA,
    ENTRY_BY_NAME,
    HANDLE_BY_NAME,
    INFO_BY_NAME,
    RELEASE_HANDLE,
    TYPE_BY_NAME,
    TYPE_UPLOAD,
    UPLOAD,
    UPLOAD_INFO,
    UPLOAD_INFO_LONG,
    VALUE_BY_HANDLE,
    VALUE_BY_NAME,
    VERSION,
)
from motionlayer.connect.ads._rpc import call
from motionlayer.connect.ads._service import Image, Kind, Service, Watched, Write
from motionlayer.connect.ads._system import controlled
from motionlayer.connect.ads._tree import METHOD, MethodPlace, Place, Tree

if TYPE_CHECKING:
    from collections.abc import Callable

NAMES: Final = 4096
LONGEST: Final = 255
"""Names that are found at once when they are asked for again, and bytes of one, at most."""

_METHOD: Final = METHOD.encode()
_U32: Final = struct.Struct("<I")
_INFO: Final = struct.Struct("<3I")
_LONG: Final = struct.Struct("<3IH")


class SymbolService(Service):
    """Symbols, as a PLC runtime serves them.

    Args:
        tree: all symbols and types.
        image: their published bytes.
    """

    def __init__(self, tree: Tree, image: Image) -> None:
        self._tree = tree
        self._image = image
        self._size = size = image.size
        self._starts = [root.offset for root in tree.roots]
        self._handles = Handles()
        self._find = functools.lru_cache(NAMES)(lambda raw: tree.find(_name(raw)))
        self._catalogue = catalogue = Catalogue(tree)
        self._readers: dict[int, Callable[[Client, int, int], bytes]] = {
            DATA_AREA: self._read_bytes,
            DATA_BITS: self._read_bit,
            DATA_SIZE: lambda _client, _offset, _length: _U32.pack(size),
            VALUE_BY_HANDLE: self._read_handle,
            VERSION: lambda _client, _offset, _length: bytes((image.status().beginnings & 0xFF,)),
            UPLOAD: lambda _client, _offset, _length: catalogue.symbols,
            UPLOAD_INFO: lambda _client, _offset, _length: catalogue.info(2),
            TYPE_UPLOAD: lambda _client, _offset, _length: catalogue.types,
            UPLOAD_INFO_LONG: lambda _client, _offset, length: catalogue.info(16 if length >= 64 else 6),
            DEVICE_DATA: self._device_data,
        }
        self._askers: dict[int, Callable[[Client, Place, int], bytes]] = {
            HANDLE_BY_NAME: self._handle_by_name,
            VALUE_BY_NAME: lambda _client, place, _length: self._value(place),
            INFO_BY_NAME: lambda _client, place, _length: _INFO.pack(*address(place), place.type.size),
            ENTRY_BY_NAME: lambda _client, place, _length: symbol_entry(place),
        }

    def __len__(self) -> int:
        """Return how many handles all clients hold."""
        return len(self._handles)

    def read(self, client: Client, group: int, offset: int, length: int) -> bytes:
        """Return what a group has at an offset; the arguments are those of `Service.read`."""
        reader = self._readers.get(group)
        if reader is None:
            return super().read(client, group, offset, length)
        return reader(client, offset, length)[:length]

    def write(self, client: Client, group: int, offset: int, data: bytes) -> Write | None:
        """Write bytes or release a handle; the arguments are those of `Service.write`."""
        if group == RELEASE_HANDLE:
            self._handles.release(client, data)
            return None
        client.require_writing()
        if group == VALUE_BY_HANDLE:
            return self._write_place(self._handles.value(offset), data)
        if group == DATA_AREA:
            self._require_writable(offset, len(data))
            return Write(Kind.BYTES, offset, data)
        if group == DATA_BITS:
            self._require_writable(offset // 8, 1)
            return Write(Kind.BIT, offset, data)
        return super().write(client, group, offset, data)

    def read_write(self, client: Client, group: int, offset: int, length: int, data: bytes) -> bytes | Write:
        """Answer by name; the arguments are those of `Service.read_write`."""
        if group == TYPE_BY_NAME:
            return self._catalogue.type_named(_name(data))[:length]
        if group == VALUE_BY_HANDLE:
            return self._call(client, offset, length, data)
        asker = self._askers.get(group)
        if asker is None:
            return super().read_write(client, group, offset, length, data)
        if group == HANDLE_BY_NAME and _METHOD in data:
            return self._handle_by_name(client, self._tree.find_method(_name(data)), length)[:length]
        return asker(client, self._place_of(data), length)[:length]

    def watch(self, client: Client, group: int, offset: int, length: int) -> Watched:
        """Return what a notification samples; the arguments are those of `Service.watch`."""
        if group == VALUE_BY_HANDLE:
            place = self._handles.value(offset)
            _require_size(length, place)
            return Watched(place.offset, length, place.bit)
        if group == DATA_AREA:
            self._check(offset, length)
            return Watched(offset, length)
        if group == DATA_BITS:
            self._check(offset // 8, 1)
            return Watched(offset // 8, 1, offset % 8)
        if group == VERSION:
            return Watched(self._size + BEGINNINGS, min(length, 1))
        if group == DEVICE_DATA:
            self.read(client, group, offset, length)
            return Watched(self._size + STATES + offset, min(length, 4 - offset))
        return super().watch(client, group, offset, length)

    def forget(self, client: Client) -> None:
        """Release what a client held."""
        self._handles.forget(client)

    @property
    def age(self) -> int:  # type: ignore[override]
        """Grows when handles are released."""
        return self._handles.age

    def locate(self, group: int, offset: int, length: int) -> tuple[int, int] | None:
        """Return where in the image a value lies; the arguments are those of `Service.locate`."""
        if group == DATA_AREA and offset + length < self._size:
            return offset, length
        place = self._handles.find(offset) if group == VALUE_BY_HANDLE else None
        if not isinstance(place, Place) or place.bit is not None or length > place.type.size:
            return None
        return place.offset, length

    def _place_of(self, raw: bytes) -> Place:
        """Return what has a name; those that clients ask for are found at once when they come again."""
        return self._find(raw) if len(raw) <= LONGEST else self._tree.find(_name(raw))

    def _call(self, client: Client, handle: int, length: int, data: bytes) -> Write:
        """Return what the run is asked for to call a method."""
        method = self._handles.method(handle)
        client.require_writing()
        if len(data) != method.sent or length < method.returned:
            sizes = f"{len(data)} bytes for {method.sent} of inputs, {length} for {method.returned} of results"
            raise AdsError(Code.INVALID_SIZE, f"{method.place.name}: {sizes}")
        return call(method, data)

    def _handle_by_name(self, client: Client, what: Place | MethodPlace, length: int) -> bytes:
        handle = self._handles.take(client, what)
        if length <= _U32.size:
            return _U32.pack(handle)
        if isinstance(what, MethodPlace):
            size, adst, kind = what.returned, 0, b""
        else:
            size, adst, kind = what.type.size, what.type.adst, encoded(what.type.name)
        long = _LONG.pack(handle, size, adst, len(kind)) + texts(kind)
        return long if length >= len(long) else _U32.pack(handle)

    def _read_handle(self, _client: Client, handle: int, length: int) -> bytes:
        place = self._handles.value(handle)
        if place.bit is not None:
            return self._value(place)
        return self._image.read(place.offset, min(length, place.type.size))

    def _value(self, place: Place) -> bytes:
        raw = self._image.read(place.offset, 1 if place.bit is not None else place.type.size)
        return raw if place.bit is None else bytes((raw[0] >> place.bit & 1,))

    def _write_place(self, place: Place, data: bytes) -> Write:
        if not place.root.writable:
            raise AdsError(Code.NOT_PERMITTED, f"{place.name} can only be read")
        _require_size(len(data), place)
        if place.bit is not None:
            return Write(Kind.BIT, place.offset * 8 + place.bit, data)
        return Write(Kind.BYTES, place.offset, data)

    def _check(self, offset: int, length: int) -> None:
        if offset + length > self._size:
            raise AdsError(Code.INVALID_OFFSET, f"{offset} + {length} bytes, the image has {self._size}")

    def _require_writable(self, offset: int, length: int) -> None:
        """Refuse bytes that are not part of one symbol which clients write."""
        self._check(offset, max(length, 1))
        root = self._tree.roots[bisect.bisect_right(self._starts, offset) - 1]
        if not root.writable:
            raise AdsError(Code.NOT_PERMITTED, f"{root.name} can only be read")
        if offset + length > root.offset + self._tree.type_named(root.type).size:
            raise AdsError(Code.INVALID_SIZE, f"{length} bytes from {offset} on do not lie in {root.name} alone")

    def _read_bytes(self, _client: Client, offset: int, length: int) -> bytes:
        if offset + length >= self._size:  # up to the end of the image, or beyond it
            self._check(offset, 1)
            length = min(length, self._size - offset)
        return self._image.read(offset, length)

    def _read_bit(self, _client: Client, offset: int, _length: int) -> bytes:
        self._check(offset // 8, 1)
        return bytes((self._image.read(offset // 8, 1)[0] >> offset % 8 & 1,))

    def _device_data(self, _client: Client, offset: int, _length: int) -> bytes:
        if offset not in (0, 2):
            raise AdsError(Code.INVALID_OFFSET, f"0xF100:{offset}")
        return struct.pack("<HH", *self.state())[offset:]

    def state(self) -> tuple[int, int]:
        """Return whether the run goes on or is held up."""
        status = self._image.status()
        return status.plc, status.plc_device

    def control(self, state: int, _device_state: int, _data: bytes) -> Write:
        """Let the run go on, hold it up, or let it begin anew; see `controlled`."""
        return controlled(state)


def _name(data: bytes) -> str:
    return data.split(b"\0", 1)[0].decode(CODE_PAGE, errors="replace")


def _require_size(length: int, place: Place) -> None:
    size = 1 if place.bit is not None else place.type.size
    if length != size:
        raise AdsError(Code.INVALID_SIZE, f"{place.name}: {length} bytes, it has {size}")
