"""`NcService`: the ports of the NC, where axes are reached by index group (ads 8).

A group is a base and the number of an axis, from 1: 0x4000 parameters, 0x4100 state, 0x4200 functions, 0x4300 cyclic
data. What can be read is a table of pure data: an offset leads to pieces of the row that the axis has in the published
image. What is written goes to the run, which knows what it means; here only its size is.

Of an offset in the groups of an axis, the digit 0x000n0000 chooses a part of it, which has groups of its own:

    ====== ============ ==================
    n      part         parameters, state
    ====== ============ ==================
    0      axis         0x4000, 0x4100
    1      encoder      0x5000, 0x5100
    2      controller   0x6000, 0x6100
    3      drive        0x7000, 0x7100
    ====== ============ ==================
"""

import struct
from collections.abc import Mapping
from typing import Final, NamedTuple, TypeVar

from motionlayer.connect.ads._client import Client
from motionlayer.connect.ads._codes import AdsError, Code
from motionlayer.connect.ads._service import Image, Kind, Service, Watched, Write, gathered

T = TypeVar("T")

PARAMETERS: Final = 0x4000
STATE: Final = 0x4100
FUNCTIONS: Final = 0x4200
CYCLIC: Final = 0x4300

MOST_AXES: Final = 0xFF
"""Axes that have groups: behind 0x40FF the next base begins."""

_BASE, _AXIS = 0xFF00, 0x00FF
_PART, _OWN_OFFSET = 0x000F_0000, 0xFFFF
_PART_STEP: Final = 0x1000
"""From the groups of a part to those of the next one."""

_OFFSET: Final = struct.Struct("<I")


class Item(NamedTuple):
    """What is read at an offset.

    Attributes:
        size: bytes.
        pieces: place in the answer, first byte in the row of the axis, length; what they leave out is 0.
    """

    size: int
    pieces: tuple[tuple[int, int, int], ...]


class Area(NamedTuple):
    """The groups of one base.

    Attributes:
        reads: by offset.
        writes: bytes of what can be written, by offset.
        missing: answer to any other offset.
    """

    reads: Mapping[int, Item]
    writes: Mapping[int, int]
    missing: Code = Code.INVALID_OFFSET


class NcContents(NamedTuple):
    """What the ports of the NC have.

    Attributes:
        start: first byte of the first row in the published image.
        stride: bytes of a row.
        axes: how many rows there are.
        areas: by base.
    """

    start: int
    stride: int
    axes: int
    areas: Mapping[int, Area]


def with_parts(areas: Mapping[int, Area]) -> dict[int, Area]:
    """Return the areas of axes, and those of the parts of axes, with the offsets that parts have there."""
    made = dict(areas)
    for base in (PARAMETERS, STATE):
        for part in (1, 2, 3):
            whole = areas[base]
            made[base + part * _PART_STEP] = Area(_of_part(whole.reads, part), _of_part(whole.writes, part))
    return made


def _of_part(table: Mapping[int, T], part: int) -> dict[int, T]:
    return {offset & _OWN_OFFSET: one for offset, one in table.items() if (offset & _PART) >> 16 == part}


def axis_address(group: int, offset: int) -> tuple[int, int, int]:
    """Return base, number of the axis and offset there of what is addressed in whichever way, by axis or by part."""
    base, axis = group & _BASE, group & _AXIS
    part = (base - PARAMETERS) // _PART_STEP
    return base - part * _PART_STEP, axis, offset | part << 16


class NcService(Service):
    """Axes by index group.

    Args:
        contents: what there is.
        image: the published bytes.
    """

    def __init__(self, contents: NcContents, image: Image) -> None:
        self._contents = contents
        self._image = image

    def read(self, client: Client, group: int, offset: int, length: int) -> bytes:
        """Return a value; the arguments are those of `Service.read`."""
        area = self._contents.areas.get(group & _BASE)
        if area is None:
            return super().read(client, group, offset, length)
        row, item = self._row(group), _item(area, group, offset)
        data = self._image.read(row, self._contents.stride)
        return gathered(item.size, item.pieces, data)[:length]

    def watch(self, client: Client, group: int, offset: int, length: int) -> Watched:
        """Return what a notification samples; the arguments are those of `Service.watch`."""
        area = self._contents.areas.get(group & _BASE)
        if area is None:
            return super().watch(client, group, offset, length)
        row, item = self._row(group), _item(area, group, offset)
        if length > item.size:
            raise AdsError(Code.INVALID_SIZE, f"0x{group:X}:0x{offset:X} has {item.size} bytes, not {length}")
        return Watched(row, length, pieces=tuple((at, row + start, size) for at, start, size in item.pieces))

    def write(self, client: Client, group: int, offset: int, data: bytes) -> Write | None:
        """Return what the run is asked for; the arguments are those of `Service.write`."""
        client.require_writing()
        area = self._contents.areas.get(group & _BASE)
        if area is None:
            return super().write(client, group, offset, data)
        self._row(group)
        size = area.writes.get(offset)
        if size is None:
            code = Code.NOT_PERMITTED if offset in area.reads else area.missing
            raise AdsError(code, f"0x{group:X}:0x{offset:X} cannot be written")
        if len(data) != size:
            raise AdsError(Code.INVALID_SIZE, f"0x{group:X}:0x{offset:X}: {len(data)} bytes, it has {size}")
        return Write(Kind.FUNCTION, group, _OFFSET.pack(offset) + data)

    def _row(self, group: int) -> int:
        """Return the place of an axis in the image.

        Raises:
            AdsError: there is no such axis (0x70C).
        """
        contents, axis = self._contents, group & _AXIS
        if not 1 <= axis <= contents.axes:
            raise AdsError(Code.NOT_FOUND, f"0x{group:X}: no axis {axis}, there are 1 to {contents.axes}")
        return contents.start + (axis - 1) * contents.stride


def _item(area: Area, group: int, offset: int) -> Item:
    item = area.reads.get(offset)
    if item is None:
        code = Code.NOT_PERMITTED if offset in area.writes else area.missing
        raise AdsError(code, f"0x{group:X}:0x{offset:X} cannot be read")
    return item


def function(write: Write) -> tuple[int, int, bytes]:
    """Return group, offset and data of a `Write` of the kind FUNCTION."""
    (offset,) = _OFFSET.unpack_from(write.data)
    return write.place, offset, write.data[_OFFSET.size :]
