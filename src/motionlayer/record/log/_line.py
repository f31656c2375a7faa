"""One message as one line (motion-layer 8.6), and the list it belongs to (8.2)."""

import enum
from typing import Final

from motionlayer.event import BLOCK, Device, Event, Kind, Level, Subdevice
from motionlayer.record.log._zone import LocalTime

WIDTH: Final = 255
"""Characters of a line, its end included."""

NUMBER: Final = (1 << 64) - 1
"""The number of a message is a ULINT."""

TYPES: Final = {level: f"eMessage{level.name.capitalize()}" for level in Level}
"""Names of `E_MessageType`."""


class List(enum.Enum):
    """Message lists that have a file; the value is the root of its name, behind the port."""

    MOTION = "_MSG_PLC_"
    METRICS = "_MSG_Metrics_"


_MOTION_BLOCKS: Final = (
    Device.XfcTriggerBox,
    Device.XfcTouchProbe,
    Device.Camming,
    Device.NciChannel,
    Device.NciChannelCtrl,
    Device.Axis,
    Device.XfcAxis,
    Device.FlyingSaw,  # D45
)
_MOTION_SINGLES: Final = (
    Device.Device_Null,  # D45, as the next one
    Device.Device_Main,
    Device.Device_MainAxis,
    Device.Device_Nci,
    Device.Device_Cam,
    Device.Device_Functions,
    Device.Device_FlyingSaw,
    Device.Device_ParameterSelector,
)


def list_of(device: int) -> List | None:
    """Return the list of a device; None for the lists that are not written here (8.2)."""
    block = device - device % BLOCK
    if block == Device.MetricsAxis:
        return List.METRICS
    return List.MOTION if block in _MOTION_BLOCKS or device in _MOTION_SINGLES else None


class Lists(dict[int, List | None]):
    """`list_of`, remembered."""

    def __missing__(self, device: int) -> List | None:
        self[device] = of = list_of(device)
        return of


def device_name(device: int) -> str:
    """Return a device as its column shows it, `Axis_ID_1`; the number where no member fits."""
    if device < BLOCK:
        known = device in Device._value2member_map_
        return f"{Device(device).name if known else device}_ID_{device}"
    base = max(member for member in Device if member <= device)
    return f"{base.name}_ID_{device - base}"


def tells_object(device: int) -> bool:
    """Tell whether the column says which object is meant: a block, and an id in it."""
    return device >= BLOCK and device % BLOCK != 0


def printable(text: str) -> str:
    """Return a text in which every character that cannot be printed is a space, tabs and line ends among them."""
    return text if text.isprintable() else "".join(one if one.isprintable() else " " for one in text)


def note(time: str, level: Level, number: int, text: str) -> str:
    """Return the line of a message of the log about itself."""
    device = device_name(Device.Device_Main)
    return f"{TYPES[level]}\t{time}\t{device}\t{Subdevice.General.name}\t{number}\t{text}"[: WIDTH - 1] + "\n"


def part_name(subdevice: int) -> str:
    """Return a subdevice as its column shows it; the number where there is no such member."""
    return Subdevice(subdevice).name if subdevice in Subdevice._value2member_map_ else str(int(subdevice))


_LEADS: Final = {kind: "" if kind is Kind.MESSAGE else f"{kind}: " for kind in Kind}
"""What leads the text, by the kind of a record."""


class _Columns(dict[tuple[int, int], tuple[str, bool]]):
    """The columns of device and subdevice, and whether they tell the object."""

    def __missing__(self, key: tuple[int, int]) -> tuple[str, bool]:
        device, part = key
        self[key] = columns = f"{device_name(device)}\t{part_name(part)}", tells_object(device)
        return columns


class Lines:
    """Writes messages as lines.

    The text of a message is written as it is. A step in the life of a command is led by its kind (`done: `), and what
    the device does not tell, by the source (`program pick: `).

    Args:
        local: the time of ticks.
    """

    def __init__(self, local: LocalTime) -> None:
        self._local = local
        self._columns = _Columns()

    def line(self, event: Event) -> str:
        """Return the line of a message, with its end."""
        tick, level, kind, source, text, code, _, device, part = event
        columns, told = self._columns[device, part]
        text = _LEADS[kind] + text if told or not source else f"{source}: {_LEADS[kind]}{text}"
        if not text.isprintable():
            text = printable(text)
        line = f"{TYPES[level]}\t{self._local.text(tick)}\t{columns}\t{code & NUMBER}\t{text}\n"
        return line if len(line) <= WIDTH else line[: WIDTH - 1] + "\n"
