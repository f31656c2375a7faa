"""Which function block a command of an axis is, for the messages about it."""

from typing import Final

from motionlayer.event import BLOCK, Device, Subdevice, device_of

SUBDEVICES: Final = {
    "enable": Subdevice.fbPower,
    "disable": Subdevice.fbPower,
    "reset": Subdevice.fbReset,
    "halt": Subdevice.fbHalt,
    "stop": Subdevice.fbStop,
    "emergency_stop": Subdevice.fbStop,
    "home": Subdevice.fbHome,
    "jog": Subdevice.fbJog,
    "move_absolute": Subdevice.fbMovePtP,
    "move_relative": Subdevice.fbMovePtP,
    "move_additive": Subdevice.fbMovePtP,
    "move_modulo": Subdevice.fbMovePtP,
    "move_continuous_absolute": Subdevice.fbMoveEndless,
    "move_continuous_relative": Subdevice.fbMoveEndless,
    "move_velocity": Subdevice.fbMoveVelo,
}
"""By the name of the method; every other command belongs to AxisControl."""


def axis_device(column: int) -> int:
    """Return the device of the axis in a column: id 1 for the first one; 0 where the block has no id left (D47)."""
    return device_of(Device.Axis, column + 1 if column + 1 < BLOCK else 0)
