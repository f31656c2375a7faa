"""What an axis is told when it is built, and the enumerations of its commands."""

import enum
import math
from typing import NamedTuple

from motionlayer.nc._monitors import MonitorConfig
from motionlayer.profile import Limits


class Direction(enum.IntEnum):
    """`MC_Direction`. Which of them a command takes is said there."""

    POSITIVE = 1
    SHORTEST_WAY = 2
    NEGATIVE = 3
    CURRENT = 4
    UNDEFINED = 128


class BufferMode(enum.IntEnum):
    """`MC_BufferMode`: when a command begins that is given while another one runs, and how fast it is handed over."""

    ABORTING = 0
    """At once; the running command and a buffered one end aborted."""
    BUFFERED = 1
    """When the running one has come to rest."""
    BLENDING_LOW = 2
    """At the target of the running one, with the lower velocity of both."""
    BLENDING_PREVIOUS = 3
    """There, with the velocity of the running one."""
    BLENDING_NEXT = 4
    """There, with the velocity of the new one."""
    BLENDING_HIGH = 5
    """There, with the higher velocity of both."""


class JogMode(enum.IntEnum):
    """`E_JogMode`."""

    STANDARD_SLOW = 0
    """While the key is held, with the slow manual velocity of the axis."""
    STANDARD_FAST = 1
    """While the key is held, with the fast one."""
    CONTINUOUS = 2
    """While the key is held, with the velocity and the dynamics of the command."""
    INCHING = 3
    """One step."""
    INCHING_MODULO = 4
    """To the next integer multiple of the step."""


class HomingMode(enum.Enum):
    """How an axis finds its reference."""

    DIRECT = "direct"
    """The present position is the reference position."""
    SWITCH = "switch"
    """The first edge of a reference or limit switch."""
    CAM = "cam"
    """The edge at which the axis leaves the cam again."""
    INDEX = "index"
    """The zero pulse of the encoder behind that edge."""
    SOFTWARE_SYNC = "software_sync"
    """The overflow of the encoder's count behind it."""
    LATCH_POSITIVE = "latch_positive"
    """The rising edge of the latch input behind it."""
    LATCH_NEGATIVE = "latch_negative"
    """The falling one."""
    SOFT_LATCH_POSITIVE = "soft_latch_positive"
    """The rising one, as the program of the drive sees it: up to a cycle later."""
    SOFT_LATCH_NEGATIVE = "soft_latch_negative"
    """The falling one, in the same way."""


class Calibration(enum.IntEnum):
    """`MC_HomingMode`."""

    DEFAULT = 0
    """As the machine description says."""
    DIRECT = 1
    """The present position is the reference position."""
    FORCE = 2
    """The axis counts as homed, and nothing else changes."""
    RESET = 3
    """It does not any more, and nothing else changes."""


class HomeConfig(NamedTuple):
    """Homing of an axis.

    Attributes:
        mode: see `HomingMode`.
        position: of the reference, u.
        velocity: of the search, u/s.
        direction: of the search, +1 or -1.
        sync_velocity: off the cam, u/s.
        sync_direction: off the cam, +1 or -1.
        travel: longest way of each search, u; infinite without a bound.
        pulse_distance: least distance of what is latched from the edge of the cam, u.
        latches: the modes for which the drive has something to latch.
    """

    mode: HomingMode
    position: float
    velocity: float
    direction: float
    sync_velocity: float
    sync_direction: float
    travel: float = math.inf
    pulse_distance: float = 0.0
    latches: tuple[HomingMode, ...] = ()


class ManualConfig(NamedTuple):
    """Jogging.

    Attributes:
        slow: manual velocity, u/s.
        fast: manual velocity, u/s.
        forward: step of inching in positive direction, u.
        backward: step of inching in negative direction, u.
    """

    slow: float
    fast: float
    forward: float
    backward: float


class ModuloConfig(NamedTuple):
    """The modulo view of the position.

    Attributes:
        period: u.
        tolerance: half width of the window in which a modulo move takes the nearest way, u.
        described: the machine description has it: a modulo axis, and not only a view that every axis has.
    """

    period: float = 360.0
    tolerance: float = 0.0
    described: bool = False


class AxisConfig(NamedTuple):
    """What the machine description says of an axis; software limits are infinite where there are none.

    `simulated` axes have no drive of their own: what is commanded is what is reported.
    """

    name: str
    unit: str
    maximum: Limits
    default: Limits
    limit_min: float
    limit_max: float
    home: HomeConfig
    manual: ManualConfig
    monitor: MonitorConfig = MonitorConfig()
    modulo: ModuloConfig = ModuloConfig()
    simulated: bool = False
