"""What an axis does about an error: one table, and the axis that follows it.

Whatever the reaction, the setpoint brakes with the maximum dynamics of the axis: it never jumps. With `POWER_OFF` the
drive loses its power at the same time and brakes by itself, so that the two part; the setpoint is not moved after it,
since a position may be redefined at rest only. Enabling adopts the actual position (decision 0013).
"""

import enum
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

from motionlayer.command import ErrorId
from motionlayer.nc._states import AxisState
from motionlayer.store import Status

if TYPE_CHECKING:
    from motionlayer.nc._axis import Axis


class Reaction(enum.Enum):
    """How an axis in error is brought to rest."""

    QUICK_STOP = "quick stop"
    """With the maximum dynamics, under power."""

    POWER_OFF = "power off"
    """The drive is switched off and its brake takes over."""


REACTIONS: Final[Mapping[ErrorId, Reaction]] = {
    ErrorId.NOT_ENABLED: Reaction.POWER_OFF,
    ErrorId.ENCODER: Reaction.POWER_OFF,
    ErrorId.LAG: Reaction.POWER_OFF,
    ErrorId.VELOCITY_LAG: Reaction.POWER_OFF,
    ErrorId.NO_MOTION: Reaction.POWER_OFF,
    ErrorId.DRIVE_NOT_READY: Reaction.POWER_OFF,
    ErrorId.IO_DATA_INVALID: Reaction.POWER_OFF,
    ErrorId.TARGET_TIMEOUT: Reaction.QUICK_STOP,
    ErrorId.MINIMUM_PASSED: Reaction.QUICK_STOP,
    ErrorId.MAXIMUM_PASSED: Reaction.QUICK_STOP,
    ErrorId.INTERNAL: Reaction.QUICK_STOP,
}
"""Per error of an axis. An error that is not here stops it under power."""


STATUS_ERRORS: Final[tuple[tuple[int, ErrorId, str], ...]] = (
    (Status.LOST, ErrorId.IO_DATA_INVALID, "no communication with the drive"),
    (Status.ENCODER_ERROR, ErrorId.ENCODER, "the encoder leapt"),
    (Status.DRIVE_ERROR, ErrorId.DRIVE_NOT_READY, "the drive reports an error"),
)
"""Bits of the drive's status that are errors, the gravest first."""


def status_error(status: int) -> tuple[ErrorId, str] | None:
    """Return the gravest error that a status tells, None without."""
    return next(((error, text) for bit, error, text in STATUS_ERRORS if status & bit), None)


class GroupReaction(enum.Enum):
    """What the other axes of a group do when one of them is in error."""

    NONE = "none"
    HALT = "halt"
    STOP = "stop"


class ErrorGroup(NamedTuple):
    """Axes of which one in error concerns the others.

    Attributes:
        axes: columns.
        reaction: of those that move: nothing, halt with the dynamics of their motion, or stop with their maximum.
    """

    axes: frozenset[int]
    reaction: GroupReaction


_BRAKES: Final[Mapping[GroupReaction, Callable[["Axis"], object]]] = {
    GroupReaction.HALT: lambda axis: axis.abandon(),
    GroupReaction.STOP: lambda axis: axis.emergency_stop(),
}


def react(groups: Iterable[ErrorGroup], faulted: list[int], axes: "Sequence[Axis]") -> None:
    """Let the groups of axes that came into error react; they forget `faulted`."""
    for group in groups:
        brake = _BRAKES.get(group.reaction)
        if brake is None or group.axes.isdisjoint(faulted):
            continue
        for column in sorted(group.axes):
            axis = axes[column]
            if axis.command is not None and axis.state is not AxisState.ERRORSTOP:
                brake(axis)
    faulted.clear()
