"""What a homing is told and does, in the words of its table: phases, cues, and the port to its axis."""

import enum
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from motionlayer.command import ErrorId
from motionlayer.nc._config import AxisConfig
from motionlayer.nc._motion import AxisCommand

if TYPE_CHECKING:
    from motionlayer.nc._homing import Homing


class HomingPort(NamedTuple):
    """What a homing sees and does of its axis; nobody else needs it.

    Attributes:
        config: of the axis, with the homing that was asked for.
        place: returns the present setpoint, u.
        actual: returns the present actual position, u.
        switch: tells whether the reference switch is on.
        edge: returns the position of its last edge, u.
        latched: returns the position of what came since the latch was armed, u; None while it waits.
        arm: lets the drive latch the reference of the method.
        search: moves with a signed velocity, u/s.
        brake: comes to rest.
        show: shows the phase, `NcToPlc.HomingState`.
        guard: has `Homing.too_far` called when the setpoint passes a position, u.
        finish: redefines the position, u; the homing is over.
        fault: puts the axis in error; the homing is over.
    """

    config: AxisConfig
    place: Callable[[], float]
    actual: Callable[[], float]
    switch: Callable[[], bool]
    edge: Callable[[], float]
    latched: Callable[[], float | None]
    arm: Callable[[], None]
    search: Callable[[float, AxisCommand], None]
    brake: Callable[[AxisCommand], None]
    show: Callable[[int], None]
    guard: Callable[[float, "Homing"], None]
    finish: Callable[[float, AxisCommand], None]
    fault: Callable[[ErrorId, str], None]


class Step(enum.IntEnum):
    """Where the homing is, with the number of `HomingState`; the phases 1 and 3 take no time of their own."""

    READY = 0
    SEARCH = 2
    ON_CAM = 3
    LEAVE = 4
    SYNC = 5
    BRAKE = 6


class Cue(enum.Enum):
    """What takes it on."""

    DIRECT = "begin without a switch"
    SEARCH = "begin beside the switch or the cam"
    ON_SWITCH = "begin on the switch"
    ON_CAM = "begin on the cam"
    EDGE = "the edge that is the reference"
    ON = "the cam comes on"
    OFF = "the cam goes off, and what is latched is to come"
    LATCHED = "the drive has latched"
    REST = "at rest"
    RELEASED = "at rest, and the cam is off again"
    TOO_FAR = "the longest way of a search is over"
