"""`Namespace`: command and state of something that a control program makes itself (motion-layer 5.1 to 5.4).

A declaration says what the built-in objects say: an enumeration of commands, a structure with a command field and one
with a state field, and a job table per command. The same controller carries it out, so that the rules are the same: a
change of the command field starts a job, the state answers in the same cycle, every change of the progress is a line in
the log.
"""

import enum
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final, Generic, TypeVar

from motionlayer.command import Ledger
from motionlayer.event import BLOCK, Device, Event, EventLog, Kind, Level, Subdevice, device_of
from motionlayer.iec import Enumeration, Struct
from motionlayer.layer._answer import ObjectState
from motionlayer.layer._controller import LARGEST
from motionlayer.layer._job import NOTHING, Job, JobTable
from motionlayer.layer.types._progress import Progress

C = TypeVar("C", bound=Struct)
S = TypeVar("S", bound=Struct)

NULL: Final = 0
"""The command that is none, in every namespace."""


@dataclass(frozen=True, slots=True)
class Namespace(Generic[C, S]):
    """The declaration.

    Attributes:
        name: begins the symbols: `GVL_TRANSPORT` makes `GVL_TRANSPORT.Ctrl` and `GVL_TRANSPORT.State`.
        ctrl: structure with a member `cmd`, of an enumeration; 0 of it is NULL, the others go from 1 to 999.
        state: structure with a member `state`, a number of 16 bits or more. With a member `error_id` it shows the
            number of the error.
        jobs: by command; one without a job is answered NOT_EXIST.
        source: who speaks in the log; the name where left out.
        device: in the log; a block where there are several objects, whose indices are the ids.
        subdevice: in the log.

    Raises:
        TypeError: a structure lacks its member, or `cmd` is of no enumeration.
        ValueError: the name is none, a command has no room in a state, or a job none among the commands.
    """

    name: str
    ctrl: type[C]
    state: type[S]
    jobs: Mapping[int, JobTable[Any]]
    source: str = ""
    device: Device = Device.General
    subdevice: Subdevice = Subdevice.General

    def __post_init__(self) -> None:
        if not (self.name.isidentifier() and self.name.isascii()):
            raise ValueError(f"namespace {self.name!r}: letters, digits and underscores, not beginning with a digit")
        commands = self.commands
        state = next((one for one in self.state.type.fields if one.attribute == "state"), None)
        if state is None or state.type.size < 2:
            raise TypeError(f"{self.name}: {self.state.__name__} needs a member `state` of 16 bits or more, as UINT")
        wrong = next((one for one in commands.members if not 0 <= one <= LARGEST), None)
        if wrong is not None:
            raise ValueError(
                f"{self.name}: {commands.iec_name(wrong)} = {int(wrong)}, allowed: 0 to {LARGEST}, so that a state "
                "tells command and progress"
            )
        if NULL not in set(commands.members):
            raise ValueError(f"{self.name}: {commands.name} needs a member 0 that is no command, as NULL = 0")
        lost = next((one for one in self.jobs if one == NULL or one not in set(commands.members)), None)
        if lost is not None:
            raise ValueError(f"{self.name}: there is a job for {int(lost)}, which is no command of {commands.name}")

    @property
    def commands(self) -> Enumeration[enum.IntEnum]:
        """The enumeration of the commands."""
        field = next((one for one in self.ctrl.type.fields if one.attribute == "cmd"), None)
        if field is None or not isinstance(field.type, Enumeration):
            raise TypeError(f"{self.name}: {self.ctrl.__name__} needs a member `cmd` of an Enumeration")
        return field.type

    @property
    def speaker(self) -> str:
        """Who speaks in the log."""
        return self.source or self.name


@dataclass(frozen=True, slots=True)
class Site(Generic[C, S]):
    """Where a job works: what the runtime tells it, handed through to `NamespaceJob`.

    Attributes:
        namespace: the declaration.
        index: of the object, from 1; 0 where there is one alone.
        ctrl: what clients write.
        state: what they read.
        ledger: the present tick.
        events: where messages go.
        cycle_ns: length of a tick, ns.
    """

    namespace: Namespace[C, S]
    index: int
    ctrl: C
    state: S
    ledger: Ledger
    events: EventLog
    cycle_ns: int


class NamespaceJob(Job, Generic[C, S]):
    """The memory of one object; programs derive from it, and keep there what their conditions and actions need.

    Args:
        site: as handed over.

    Attributes:
        ctrl: what clients write.
        state: what they read; the member `state` is written by the layer.
        index: of the object, from 1; 0 where there is one alone.
        error: number of the error with which the job ends, 0 without one; shown as `error_id` where the state has it.
    """

    def __init__(self, site: Site[C, S]) -> None:
        super().__init__(NOTHING, site.ledger)
        self.site = site
        self.ctrl = site.ctrl
        self.state = site.state
        self.index = site.index
        self.error = 0

    @property
    def elapsed_ns(self) -> int:
        """How long the present step has been the present one, ns."""
        return (self.ledger.tick - self.since) * self.site.cycle_ns

    def call(self, *, execute: bool) -> Progress:
        """Prepare the job, which forgets the error of the last one, or take it on."""
        if not execute:
            self.error = 0
        return super().call(execute=execute)

    def tell(self, level: Level, text: str, code: int) -> None:
        """Write a message of this object."""
        site, one = self.site, self.site.namespace
        device = device_of(one.device, self.index) if one.device >= BLOCK else int(one.device)
        site.events.add(Event(self.ledger.tick, level, Kind.MESSAGE, one.speaker, text, code, 0, device, one.subdevice))


def after(seconds: float) -> Callable[[NamespaceJob[Any, Any]], bool]:
    """Return the condition that the present step has lasted so long, in whole cycles; a TON on the step.

    Raises:
        ValueError: less than 0, NaN or infinite.
    """
    if not 0.0 <= seconds < float("inf"):
        raise ValueError(f"after({seconds}): must be a finite time from 0 on (s)")
    least = round(seconds * 1e9)

    def has_lasted(job: NamespaceJob[Any, Any]) -> bool:
        return job.elapsed_ns >= least

    has_lasted.__name__ = f"after {seconds:g} s"  # what a diagram shows
    return has_lasted


@dataclass(frozen=True, slots=True)
class NamespaceObject(Generic[C, S]):
    """What a control program uses.

    Attributes:
        index: from 1; 0 where there is one alone.
        name: of the object.
        ctrl: command; drop it into `ctrl.cmd`.
        state: what has become of it; `state.view` is the structure.
    """

    index: int
    name: str
    ctrl: C
    state: ObjectState
