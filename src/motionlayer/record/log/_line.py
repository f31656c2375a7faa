"""One message as one line (motion-layer 8.6)."""

from typing import Final

from motionlayer.event import BLOCK, Device, Event, Level, Subdevice, text_of
from motionlayer.record.log._zone import LocalTime

WIDTH: Final = 255
"""Characters of a line, its end included."""

NUMBER: Final = (1 << 64) - 1
"""The number of a message is a ULINT."""

TYPES: Final = {level: f"eMessage{level.name.capitalize()}" for level in Level}
"""Names of `E_MessageType`."""


def device_name(device: int) -> str:
    """Return a device as its column shows it, `Axis_ID_1`; the number where no member fits."""
    if device < BLOCK:
        known = device in Device._value2member_map_
        return f"{Device(device).name if known else device}_ID_{device}"
    base = max(member for member in Device if member <= device)
    return f"{base.name}_ID_{device - base}"


def note(time: str, level: Level, number: int, text: str) -> str:
    """Return the line of a message of the log about itself."""
    device = device_name(Device.Device_Main)
    return f"{TYPES[level]}\t{time}\t{device}\t{Subdevice.General.name}\t{number}\t{text}"[: WIDTH - 1] + "\n"


def part_name(subdevice: int) -> str:
    """Return a subdevice as its column shows it; the number where there is no such member."""
    return Subdevice(subdevice).name if subdevice in Subdevice._value2member_map_ else str(int(subdevice))


class _Columns(dict[tuple[int, int], str]):
    """The columns of device and subdevice."""

    def __missing__(self, key: tuple[int, int]) -> str:
        device, part = key
        self[key] = columns = f"{device_name(device)}\t{part_name(part)}"
        return columns


class Lines:
    """Writes messages as lines.

    Args:
        local: the time of ticks.
    """

    def __init__(self, local: LocalTime) -> None:
        self._local = local
        self._columns = _Columns()

    def line(self, event: Event) -> str:
        """Return the line of a message, with its end."""
        tick, level, _, _, _, code, _, device, part = event
        columns, text = self._columns[device, part], text_of(event)
        line = f"{TYPES[level]}\t{self._local.text(tick)}\t{columns}\t{code & NUMBER}\t{text}\n"
        return line if len(line) <= WIDTH else line[: WIDTH - 1] + "\n"
