"""What an axis is told when it is built."""

import enum
from typing import NamedTuple

from motionlayer.nc._monitors import MonitorConfig
from motionlayer.profile import Limits


class Direction(enum.IntEnum):
    """`MC_Direction`, as far as endless motion knows it."""

    POSITIVE = 1
    NEGATIVE = 3
    CURRENT = 4


class HomingMode(enum.Enum):
    """How an axis finds its reference."""

    DIRECT = "direct"
    SWITCH = "switch"


class HomeConfig(NamedTuple):
    """Homing of an axis: reference position in u, search velocity in u/s, direction of the search (+1, -1)."""

    mode: HomingMode
    position: float
    velocity: float
    direction: float


class AxisConfig(NamedTuple):
    """What the machine description says of an axis; software limits are infinite where there are none."""

    name: str
    unit: str
    maximum: Limits
    default: Limits
    limit_min: float
    limit_max: float
    home: HomeConfig
    monitor: MonitorConfig = MonitorConfig()
