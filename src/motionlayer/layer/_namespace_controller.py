"""`NamespaceController`: the command field of an object that a control program has declared."""

from typing import Any, Final

from motionlayer.command import ErrorId
from motionlayer.event import Level
from motionlayer.layer._controller import LARGEST, Choice, Controller
from motionlayer.layer._namespace import NULL, NamespaceJob
from motionlayer.layer.types._progress import Progress
from motionlayer.runtime import Guest, describe

FAILED: Final = frozenset({Progress.ERROR, Progress.NOT_EXIST})
"""Results that have the number of an error."""


class NamespaceController(Controller):
    """One object; it is ready from the beginning, and shows so: without a command its state is 10000.

    Args:
        job: its memory.
        place: of the object among those of its namespace, from 0.
        guest: names its conditions and actions while they run.

    Attributes:
        place: as given.
    """

    def __init__(self, job: NamespaceJob[Any, Any], place: int, guest: Guest) -> None:
        super().__init__(job)
        self.memory = job
        self.place = place
        self._guest = guest
        self.result = self._logged = Progress.DONE
        self._ctrl: Any = job.ctrl
        self._state: Any = job.state
        self._namespace = job.site.namespace
        self._commands = self._namespace.commands
        self._shows_error = hasattr(job.state, "error_id")

    def call(self) -> bool:
        """Do the work of one cycle; an exception that leaves a condition or an action ends the job with an error."""
        try:
            with self._guest:
                return super().call()
        except Exception as failure:  # noqa: BLE001 - a fault in a program never stops the cycle
            self._guest.note(failure)
            self.memory.error = ErrorId.PROGRAM_FAILED
            self.memory.tell(Level.ERROR, f"{self._name}: {describe(failure)}", ErrorId.PROGRAM_FAILED)
            self.result = Progress.ERROR
            self._log(Progress.ERROR)
            if self._shown is None:  # it could not be prepared: the answer still comes in this cycle
                self._shown = Progress.ERROR
                self.publish(self.state, Progress.ERROR)
            return True

    def asked(self) -> int:
        """Return what the command field holds."""
        return int(self._ctrl.cmd)

    def choose(self, command: int) -> Choice:
        """Return the job of a command; what does not exist is answered at once (D65)."""
        self.memory.error = 0
        if command == NULL:
            return Choice(Progress.DONE)
        job = self._namespace.jobs.get(command)
        if job is not None:
            return Choice(job)
        self.memory.error = ErrorId.FUNCTION_UNSUPPORTED
        if command in self._commands.members._value2member_map_:
            return Choice(Progress.NOT_EXIST)
        self.memory.tell(Level.ERROR, f"{self._name}: PROGRESS_INVALID", command)
        return Choice(Progress.ERROR, command if command <= LARGEST else 0)

    def publish(self, state: int, result: Progress) -> None:
        """Write the state, and the number of the error where there is a place for it."""
        self._state.state = state
        if self._shows_error:
            self._state.error_id = self.memory.error if result in FAILED else 0

    def tell_command(self, command: int) -> None:
        """Log that a job begins; a command without one is told with its result."""
        if command in self._namespace.jobs:
            self._logged = Progress.INIT
            self._tell(Progress.INIT, command)

    def changed(self, result: Progress) -> None:
        """Log the progress."""
        self._tell(result, self.command)

    @property
    def _name(self) -> str:
        return self._commands.iec_name(self.command)

    def _tell(self, result: Progress, number: int) -> None:
        level = Level.ERROR if result is Progress.ERROR else Level.INFO
        code = self.memory.error if level is Level.ERROR else 0
        self.memory.tell(level, f"{self._name}: PROGRESS_{result.name}", code or number)
