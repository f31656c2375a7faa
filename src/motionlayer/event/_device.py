"""`e_Device`: which object a message speaks of (motion-layer 2.6)."""

import enum
from typing import Final

BLOCK: Final = 1000
"""Numbers of a block: its base, and the ids of its objects behind it."""


class Device(enum.IntEnum):
    """Values below 1000 are single programs; each of the others is the base of a block, `device = base + id`."""

    # 0..999
    Device_Null = 0
    Device_Main = 1
    Device_MainAxis = 2
    Device_Nci = 3
    Device_Cam = 4
    Device_Functions = 5
    Device_FlyingSaw = 6
    Device_MainApplication = 7
    Device_MoverSelector = 8
    Device_ParameterSelector = 9
    Device_Configuration = 10
    Device_XmlData = 11
    Device_Utilities = 12

    # blocks, base layer
    General = 1000
    CaGroup = 2000
    Xpu = 3000
    XpuCtrl = 4000
    Mover = 5000
    MoverCtrl = 6000
    XtsTransportUnit = 7000
    XfcTriggerBox = 8000
    XfcTouchProbe = 9000
    XtsStation = 10000
    Camming = 11000
    NciChannel = 12000
    NciChannelCtrl = 13000
    Axis = 14000
    XfcAxis = 15000

    # blocks, metrics and saw
    MetricsXts = 16000
    MetricsAxis = 17000
    FlyingSaw = 18000

    # blocks, application
    Process = 20000
    ProcessListCtrl = 21000
    TicketListCtrl = 22000
    Application = 30000
    DataProduct = 40000


def device_of(base: Device, number: int) -> int:
    """Return the device of an object: the base of its block and its id.

    Args:
        base: a block.
        number: the id, 1 to 999; 0 is the block as a whole.

    Raises:
        ValueError: `base` is a single program, or the id belongs to another block.
    """
    if base < BLOCK:
        raise ValueError(f"{base.name} is a single program and has no ids; give a block, from {BLOCK} on")
    if not 0 <= number < BLOCK:
        raise ValueError(f"{base.name}: id {number} is outside of its block; ids go from 0 to {BLOCK - 1}")
    return base + number
