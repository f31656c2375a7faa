"""`AxisJob`: what a job of an axis sees, remembers and says; its conditions and actions that many jobs share.

Every caller has a memory of its own (D15): the command field of the axis, the parameter selector, and each method of
each interface. What they have in common is the axis, and there the motion runtime keeps order.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from motionlayer.command import Command, ErrorId
from motionlayer.event import Event, Kind, Level, Subdevice
from motionlayer.layer._job import NOTHING, Job
from motionlayer.layer.types._progress import Progress

if TYPE_CHECKING:
    from collections.abc import Callable

    from motionlayer.event import EventLog
    from motionlayer.fb import AXIS_REF
    from motionlayer.layer._objects import AxisObject
    from motionlayer.nc import Axis

FAILED: Final = " : PROGRESS_ERROR"
DONE: Final = " : PROGRESS_DONE"
"""Texts that many messages share (motion-layer 8.7)."""


@dataclass(frozen=True, slots=True)
class AxisPort:
    """An axis, as its jobs reach it.

    Attributes:
        ref: the axis with its parameters.
        index: its index, from 1.
        source: of messages: the command field, which tells them from those of the axis itself.
        device: `e_Device` and id, for messages.
        events: where messages go.
        patience: ticks that switching and resetting may take.
        max_retry: how often AXIS_IDLE begins again.
    """

    ref: "AXIS_REF"
    index: int
    source: str
    device: int
    events: "EventLog"
    patience: int
    max_retry: int


class AxisJob(Job):
    """The memory of one caller.

    Args:
        port: to the axis.
        inputs: what the caller asks with, and where answers go.

    Attributes:
        port, inputs: as given.
        axis: that carries it out.
        name: of the command, `AXIS_ENABLE`, for messages.
        command: the command of the motion runtime that is waited for.
        error: number of the error with which the job has ended, 0 without one.
        timed_out: it has ended because something took too long.
        attempts: of AXIS_IDLE.
        start: actual position at the start, u.
        latched: set values with which the running motion was commanded.
        told: buffered motion whose arrival was told last.
        no_target: the position in the data stands for one that was not finite.
        parameter: number and value that were asked for with the command.
        cam: calibration signal as told last.
        switches_written: a client writes the limit switches.
    """

    __slots__ = (
        "attempts", "axis", "cam", "command", "error", "inputs", "latched", "name", "no_target", "parameter", "port",
        "start", "switches_written", "timed_out", "told",
    )  # fmt: skip

    def __init__(self, port: AxisPort, inputs: "AxisObject") -> None:
        super().__init__(NOTHING, port.ref.axis.ledger)
        self.port = port
        self.inputs = inputs
        self.axis: Axis = port.ref.axis
        self.name = ""
        self.command: Command[Any] | None = None
        self.error = 0
        self.timed_out = False
        self.attempts = 0
        self.start = 0.0
        self.latched: tuple[float, ...] = ()
        self.told: Command[Any] | None = None
        self.no_target = False
        self.parameter = 0, 0.0
        self.cam = False
        self.switches_written = False

    def call(self, *, execute: bool) -> Progress:
        """Prepare the job, which forgets how the last one has ended, or take it on."""
        if not execute:
            self.error, self.timed_out = 0, False
        return super().call(execute=execute)

    def tell(self, level: Level, part: Subdevice, text: str, code: int = 0) -> None:
        """Write a message of this axis."""
        port = self.port
        port.events.add(Event(self.ledger.tick, level, Kind.MESSAGE, port.source, text, code, 0, port.device, part))

    @property
    def shown(self) -> str:
        """Name of the present progress as messages show it."""
        return f"PROGRESS_{self.table.shown[self.step].name}"


def succeeded(job: AxisJob) -> bool:
    """Condition: the command is done; as with a function block, a call after it was given at the earliest."""
    command = job.command
    return command is not None and command.done and job.ledger.tick > job.since


def failed(job: AxisJob) -> bool:
    """Condition: the command has ended in error, or was refused; again a call later."""
    command = job.command
    return command is not None and command.error is not None and job.ledger.tick > job.since


def aborted(job: AxisJob) -> bool:
    """Condition: another command has taken the axis over."""
    command = job.command
    return command is not None and command.aborted and job.ledger.tick > job.since


def lost(job: AxisJob) -> bool:
    """Condition: the command has ended in error or aborted."""
    return failed(job) or aborted(job)


def late(job: AxisJob) -> bool:
    """Condition: the step takes longer than the layer's time-out allows (D6)."""
    return job.ledger.tick - job.since >= job.port.patience


def in_error(job: AxisJob) -> bool:
    """Condition: the axis is in error."""
    return job.axis.error is not None


def standing(job: AxisJob) -> bool:
    """Condition: the axis does not move, and is not about to."""
    return not job.axis.under_way and job.axis.set_velocity == 0.0


def reset(job: AxisJob) -> None:
    """Action: clear the errors of axis and drive."""
    job.command = job.axis.reset()


def fail(part: Subdevice, text: str = FAILED) -> "Callable[[AxisJob], None]":
    """Return the action that takes over the error of the command, and tells it."""

    def take_over(job: AxisJob) -> None:
        """Action: take the error over."""
        error = job.command.error if job.command is not None else None
        job.error = error.id if error is not None else 0
        job.tell(Level.ERROR, part, text, job.error)

    return take_over


def time_out(part: Subdevice, text: str = FAILED) -> "Callable[[AxisJob], None]":
    """Return the action of a step that took too long: the drive is not ready, and `bTimeout` tells so."""

    def give_up(job: AxisJob) -> None:
        """Action: give up, bTimeout."""
        job.error, job.timed_out = ErrorId.DRIVE_NOT_READY, True
        job.tell(Level.ERROR, part, text, job.error)

    return give_up


def tell_held(job: AxisJob) -> None:
    """Warn once that a motion was taken which does not begin, since the override is 0."""
    if job.axis.override == 0.0 and job.command is not None and job.command.error is None:
        job.tell(Level.WARNING, Subdevice.AxisControl, "held by rOverride = 0 %; it begins when rOverride is raised")


def say(level: Level, part: Subdevice, text: str) -> "Callable[[AxisJob], None]":
    """Return the action that only writes a message."""

    def tell(job: AxisJob) -> None:
        """Action: tell."""
        job.tell(level, part, text)

    return tell
