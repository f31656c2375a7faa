"""The scheduler: which programs are due, and what becomes of those that fail."""

from collections.abc import Callable, Coroutine, Sequence
from typing import Any, Final

from motionlayer.command import Command, CommandError, ErrorId, Ledger, MotionError
from motionlayer.event import Device, Event, EventLog, Kind, Level, Subdevice
from motionlayer.runtime._cyclic import CyclicProgram, takes_memory
from motionlayer.runtime._failure import describe
from motionlayer.runtime._program import Cancelled, CoroutineProgram, Issuer, Program
from motionlayer.runtime._tasks import Tasks
from motionlayer.runtime._waits import Waits


class Scheduler:
    """Run the programs of a run, one step of each tick.

    Args:
        ledger: its tick and issuer are kept here.
        events: where the end of programs is told.
        tasks: what calls the cyclic ones.
        on_failure: called with a program that failed and that nobody awaits.
        on_last: called at the end of the programs step in which the last program has ended.
    """

    def __init__(
        self,
        ledger: Ledger,
        events: EventLog,
        tasks: Tasks,
        on_failure: Callable[[Program], None],
        on_last: Callable[[], None],
    ) -> None:
        self.programs: list[Program] = []
        """Programs that have not ended, in order of start."""
        self.failures: list[Issuer] = []
        """Programs that failed and that nobody awaited, and guests that failed."""
        self.waits = Waits(ledger)
        """Sleeps and predicates that somebody waits for."""
        self._ledger = ledger
        self._events = events
        self._tasks = tasks
        self._coroutines: list[CoroutineProgram] = []
        self._on_failure = on_failure
        self._on_last = on_last
        self._ended_waits: dict[int, int] = {}

    def start(self, coroutine: Coroutine[Any, Any, Any], name: str) -> CoroutineProgram:
        """Add a coroutine; it first runs in the next programs step that begins.

        Raises:
            TypeError: it is not a coroutine.
        """
        if not isinstance(coroutine, Coroutine):
            raise TypeError(f"{name}: {coroutine!r} is not a coroutine; call the async function: start(program())")
        program = CoroutineProgram(coroutine, name, number=self._ledger.number(), owner=self._ledger.issuer)
        self._coroutines.append(program)
        self._begin(program)
        return program

    def cyclic(self, function: Callable[..., None], run: object, name: str, task: str) -> CyclicProgram:
        """Add a cyclic program; it is first called by its task in the next programs step that begins.

        Raises:
            KeyError: there is no such task.
            TypeError: it is not `def function(run)` or `def function(run, memory)`.
        """
        calling, with_memory = self._tasks[task], takes_memory(function)
        number, owner = self._ledger.number(), self._ledger.issuer
        since = self._ledger.tick + (0 if owner is None else 1)
        program = CyclicProgram(function, run, name, with_memory=with_memory, number=number, owner=owner, since=since)
        self._tasks.add(calling, program)
        self._begin(program)
        return program

    def run(self, tick: int) -> None:
        """Give everyone a turn who is due in this tick: coroutines, then the tasks."""
        some = bool(self.programs)
        self.waits.end(tick)
        coroutines = self._coroutines
        due = [(program, throw) for program in coroutines for is_due, throw in [self._due(program, tick)] if is_due]
        for program, throw in due:
            if program.busy:
                self._resume(program, throw)
        self._tasks.run(tick, self._turn)
        if some and not self.programs:
            self._on_last()

    def _begin(self, program: Program) -> None:
        program.activate()
        self.programs.append(program)
        self._tell(program, Level.INFO, Kind.ACCEPTED, "started")

    def _turn(self, program: CyclicProgram) -> None:
        self._resume(program, Cancelled() if program.cancelling else None)

    def cancel_all(self) -> None:
        """Cancel what still runs, in reverse order; a program that waits again is closed."""
        for program in reversed(self.programs.copy()):
            if program.busy:
                self._resume(program, Cancelled())
        for program in self.programs.copy():  # those that wait again, and those that a failure has just started
            self._close(program)

    def keep_only(self, kept: Sequence[Program]) -> None:
        """Close all other programs, the last one first: the run goes back to a tick at which there were only these."""
        while others := [program for program in self.programs if program not in kept]:
            self._close(others[-1])

    def _close(self, program: Program) -> None:
        """Close a program that waits again although the run is over."""
        failure: BaseException = Cancelled()
        try:
            program.close()
        except Exception as error:  # noqa: BLE001 - the program's own fault
            failure = error
        self._finish(program, failure)

    def _due(self, program: Program, tick: int) -> tuple[bool, BaseException | None]:
        if program.cancelling:
            return True, Cancelled()
        wait = program.waits_for
        if wait is None:
            return True, None
        if self._ended_waits[program.number] < tick:
            return True, None
        late = next((deadline for deadline in program.deadlines if tick >= deadline.tick), None)
        if late is None:
            return False, None
        return True, TimeoutError(f"{program.name}: {late.seconds:g} s passed while waiting for {wait.name}")

    def _resume(self, program: Program, throw: BaseException | None) -> None:
        self._ledger.issuer = program
        if isinstance(throw, Cancelled):  # one that came after who is due was decided is for the next tick
            program.cancelling = False
        self._ended_waits.pop(program.number, None)
        try:
            if program.resume(throw):
                if program.waits_for is not None:
                    self._watch(program, program.waits_for)
                return
            failure: BaseException | None = None
        except Cancelled as cancelled:
            failure = cancelled
        except Exception as error:  # noqa: BLE001 - a fault in a program never stops the cycle
            failure = error
        except BaseException as interrupt:  # Ctrl-C or the watchdog: the run ends
            self._finish(program, interrupt)
            raise
        finally:
            self._ledger.issuer = None
            self.tell_forgotten(program)
        self._finish(program, failure)

    def tell_forgotten(self, program: Issuer) -> None:
        """Warn of waits that the program made in this turn and did not await, once for each line."""
        for name, place in self.waits.forgotten():
            if place not in program.warned:
                program.warned.append(place)
                text = f"{name} at {place} is not awaited, so it does nothing: {program.advice}"
                self._tell(program, Level.WARNING, Kind.MESSAGE, text)

    def _watch(self, program: Program, wait: Command[Any]) -> None:
        """Note when the command that a program waits for ends: it is due from the tick after."""
        number = program.number
        self._ended_waits[number] = _NEVER

        def ended() -> None:
            if program.waits_for is wait:
                self._ended_waits[number] = self._ledger.tick - (1 if self.waits.asking else 0)

        wait.on_end(ended, lambda: program.waits_for is wait)

    def _finish(self, program: Program, failure: BaseException | None) -> None:
        self.programs.remove(program)
        if isinstance(program, CyclicProgram):
            self._tasks.remove(program)
        elif isinstance(program, CoroutineProgram):
            self._coroutines.remove(program)
        if failure is None:
            self._tell(program, Level.INFO, Kind.DONE, "ended")
            program.finish(program.value)
        elif isinstance(failure, Cancelled):
            self._tell(program, Level.INFO, Kind.ABORTED, "cancelled")
            program.abort()
        else:
            self._fail(program, failure)

    def _fail(self, program: Program, failure: BaseException) -> None:
        program.failure = failure
        text = describe(failure)
        known = failure.error.id if isinstance(failure, CommandError) else ErrorId.PROGRAM_FAILED
        awaited = program.awaited
        self._tell(program, Level.ERROR, Kind.ERROR, text, known)
        program.fail(MotionError(known, program.name, text))
        if not awaited:
            self.failures.append(program)
            self._on_failure(program)

    def _tell(self, program: Issuer, level: Level, kind: Kind, text: str, code: int = 0) -> None:
        source = f"program {program.name}"
        main, part = Device.Device_Main, Subdevice.General
        self._events.add(Event(self._ledger.tick, level, kind, source, text, code, program.number, main, part))


_NEVER: Final = 2**62
