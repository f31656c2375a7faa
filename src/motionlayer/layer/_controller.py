"""`Controller`: from a command field to a job, and from the job to a state field (motion-layer 5.1 to 5.3).

What happens in a call, in this order:

1. the command field differs from the command of before: the job is chosen and prepared, "new command" is logged;
2. the state is published: the number of the command, and the progress that *the previous call* has left; after a new
   command that is INIT, so that the answer comes in the cycle in which the command was seen;
3. the job is called, unless it has ended; a progress that differs from that of the call before is logged.

A controller whose job has ended, and whose end is published, has nothing to do until its command field is written: its
namespace does not call it. The state is computed where it is written, and stored nowhere else.
"""

from abc import ABC, abstractmethod
from typing import Any, Final, NamedTuple

from motionlayer.layer._job import Job, JobTable
from motionlayer.layer.types._progress import Progress

FINAL: Final = frozenset({Progress.INVALID, Progress.NOT_EXIST, Progress.ERROR, Progress.DONE})
"""Results after which the job is not called any more."""

LARGEST: Final = 999
"""Command numbers that a state has room for, from 1."""


class Choice(NamedTuple):
    """What a command means to an object.

    Attributes:
        job: the job to be prepared, or a result at once.
        number: what the state is based on; that of the command where left out.
    """

    job: JobTable[Any] | Progress
    number: int | None = None


class Controller(ABC):
    """One object with a command field and a state field; subclasses say where these are and what a command means.

    Args:
        job: the memory of the object.

    Attributes:
        command: as seen last; 0 at power-up.
        result: of the job.
    """

    __slots__ = ("_logged", "_number", "_shown", "command", "job", "result")  # see `Job`

    def __init__(self, job: Job) -> None:
        self.job = job
        self.command = 0
        self.result = Progress.INVALID
        self._number = 0
        self._shown: Progress | None = None
        self._logged = Progress.INVALID

    def call(self) -> bool:
        """Do the work of one cycle; tell whether there will be some in the next one."""
        command = self.asked()
        if command != self.command:
            self._begin(command)
        result = self.result
        if result is not self._shown:
            self._shown = result
            self.publish(self.state, result)
        if result in FINAL:
            return False
        self.result = result = self.job.call(execute=True)
        if result is not self._logged:
            self._log(result)
        return True

    @property
    def state(self) -> int:
        """What is published now."""
        if self.result is Progress.INVALID:
            return int(Progress.ERROR)
        return self._number + self.result

    def _begin(self, command: int) -> None:
        """Take a new command up."""
        self.command, self._shown = command, None
        choice = self.choose(command)
        self._number = command if choice.number is None else choice.number
        self.result = self.job.take(choice.job) if isinstance(choice.job, JobTable) else choice.job
        self.tell_command(command)
        if self.result in FINAL and self.result is not self._logged:
            self._log(self.result)

    def _log(self, result: Progress) -> None:
        self._logged = result
        self.changed(result)

    # -- what subclasses say -------------------------------------------------------------------------------------------

    @abstractmethod
    def asked(self) -> int:
        """Return what the command field holds."""

    @abstractmethod
    def choose(self, command: int) -> Choice:
        """Return what a new command means."""

    @abstractmethod
    def publish(self, state: int, result: Progress) -> None:
        """Write the state field."""

    @abstractmethod
    def tell_command(self, command: int) -> None:
        """Log that a command has come."""

    @abstractmethod
    def changed(self, result: Progress) -> None:
        """Log the progress, and take up what follows from it."""
