"""Where a message goes, and what it says: what lines of files and slots of lists have in common (motion-layer 8)."""

import enum
from typing import Final

from motionlayer.event._device import BLOCK, Device
from motionlayer.event._event import Event, Kind


class MessageList(enum.Enum):
    """Lists whose messages are written to a file; the value follows the ADS port in the name of the file."""

    MOTION = "_MSG_PLC_"
    METRICS = "_MSG_Metrics_"


_MOTION_BLOCKS: Final = (
    Device.General,  # D45, as those marked below: nobody wrote their list
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
    Device.Device_Null,  # D45
    Device.Device_Main,  # D45
    Device.Device_MainAxis,
    Device.Device_Nci,
    Device.Device_Cam,
    Device.Device_Functions,
    Device.Device_FlyingSaw,
    Device.Device_ParameterSelector,
)


def list_of(device: int) -> MessageList | None:
    """Return the list of a device; None for the lists that are not written here (8.2)."""
    block = device - device % BLOCK
    if block == Device.MetricsAxis:
        return MessageList.METRICS
    return MessageList.MOTION if block in _MOTION_BLOCKS or device in _MOTION_SINGLES else None


class Lists(dict[int, MessageList | None]):
    """`list_of`, remembered."""

    def __missing__(self, device: int) -> MessageList | None:
        self[device] = of = list_of(device)
        return of


_LEADS: Final = {kind: "" if kind is Kind.MESSAGE else f"{kind}: " for kind in Kind}
"""What leads the text, by the kind of a record."""


def tells_object(device: int) -> bool:
    """Tell whether the device says which object is meant: a block, and an id in it."""
    return device >= BLOCK and device % BLOCK != 0


def text_of(event: Event) -> str:
    """Return what a message says: its text on one line.

    A step in the life of a command is led by its kind (`done: `), and what the device does not tell, by the source
    (`program pick: `), unless the text begins with it anyway. A character that cannot be printed is a space, tabs and
    line ends among them.
    """
    text = _LEADS[event.kind] + event.text
    if event.source and not tells_object(event.device) and not event.text.startswith(event.source):
        text = f"{event.source}: {text}"
    return text if text.isprintable() else "".join(one if one.isprintable() else " " for one in text)
