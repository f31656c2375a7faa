"""`MessageWriter`: frees a list from time to time (motion-layer 8.4).

In the original the writer copies the list, makes lines of it and appends them to the file. Here the lines are on their
way as soon as the messages are said, and none is lost while a list is full; the writer keeps the list from being so,
and clients see the commands and states that they know.
"""

from typing import TYPE_CHECKING, Final

from motionlayer.layer._controller import FINAL, Choice, Controller
from motionlayer.layer._job import Job, JobTable, Transition, a_call_later, nothing
from motionlayer.layer.types._message_kinds import MessageCommand
from motionlayer.layer.types._progress import Progress

if TYPE_CHECKING:
    from motionlayer.command import Ledger
    from motionlayer.layer._message_globals import MessageList
    from motionlayer.layer._messages_slots import Slots

_P = Progress

PERIOD: Final = 5.0
"""Seconds after which a list is written at the latest."""

SHARE: Final = 100
"""A list is written at once when more than one of so many slots are used (D38)."""


class WriterJob(Job):
    """The memory of a writer.

    Args:
        ledger: the present tick.
        slots: of its list.
    """

    def __init__(self, ledger: "Ledger", slots: "Slots") -> None:
        super().__init__(WRITE, ledger)
        self.slots = slots


def is_empty(job: WriterJob) -> bool:
    """Condition: there is nothing to write."""
    return job.slots.used == 0


def free_slots(job: WriterJob) -> None:
    """Action: free the slots; what stood there is on its way into the file."""
    job.slots.free()


INIT: Final = JobTable[WriterJob](
    "MSG_CTRL_INIT",
    [
        Transition(_P.INIT, a_call_later, nothing, _P.BUSY),
        Transition(_P.BUSY, a_call_later, nothing, _P.PREPARE),
        Transition(_P.PREPARE, a_call_later, nothing, _P.DONE),
    ],
)
"""The folders are made before the run begins; the steps are those that clients know."""

WRITE: Final = JobTable[WriterJob](
    "MSG_CTRL_WRITE",
    [
        Transition(_P.INIT, is_empty, nothing, _P.DONE),
        Transition(_P.INIT, a_call_later, free_slots, _P.BUSY),
        Transition(_P.BUSY, a_call_later, nothing, _P.WORKING),
        Transition(_P.WORKING, a_call_later, nothing, _P.DONE),
    ],
)

JOBS: Final = {MessageCommand.INIT: INIT, MessageCommand.WRITE: WRITE}


class MessageWriter(Controller):
    """The writer of one list, and who commands it.

    Args:
        variables: of the list.
        slots: of the list.
        ledger: the present tick.
        period: see `PERIOD`, in ticks.
    """

    def __init__(self, variables: "MessageList", slots: "Slots", ledger: "Ledger", period: int) -> None:
        super().__init__(WriterJob(ledger, slots))
        self._ctrl = variables.ctrl.value
        self._state = variables.state.value
        self._slots = slots
        self._ledger = ledger
        self._period = period
        self._most = max(1, slots.size // SHARE)
        self._due = 0
        self._initialised = False

    @property
    def state(self) -> int:
        """Plain 0 without a command, else as of every object."""
        return 0 if self.command == MessageCommand.NULL else super().state

    @property
    def due(self) -> int:
        """The tick in which there is something to do again, unless a message comes before."""
        return 0 if self.command else self._due

    def cycle(self) -> None:
        """Do the work of one cycle: give the writer its commands, and carry them out."""
        if not self.command:
            slots = self._slots
            if self._ledger.tick < self._due and slots.used <= self._most and not slots.errors:
                return
            self._command(MessageCommand.WRITE if self._initialised else MessageCommand.INIT)
        elif self.result in FINAL and self._state.state == self.state:
            self._initialised = True
            self._due = self._ledger.tick + self._period
            self._command(MessageCommand.NULL)
        self.call()

    def _command(self, command: MessageCommand) -> None:
        self._ctrl.cmd = command

    def asked(self) -> int:
        """Return what the command field holds."""
        return int(self._ctrl.cmd)

    def choose(self, command: int) -> Choice:
        """Return the job of a command."""
        return Choice(Progress.DONE if command == MessageCommand.NULL else JOBS[MessageCommand(command)])

    def publish(self, state: int, _result: Progress) -> None:
        """Write the state field."""
        self._state.state = state

    def tell_command(self, _command: int) -> None:
        """Say nothing: what the log does is not put into the log."""

    def changed(self, _result: Progress) -> None:
        """Say nothing, for the same reason."""
